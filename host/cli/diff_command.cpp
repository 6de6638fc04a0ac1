#include "host/cli/commands.h"
#include "host/cli/diff_options.h"
#include "host/cli/options.h"
#include "host/cli/statistical.h"

#include <memory>

namespace hyalite::core {

void addDiffCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command = app.add_subcommand("diff", "compare two image files, with gates on the difference");
    const auto options = std::make_shared<DiffOptions>();
    command->footer(
        "Values are compared as the files have them: PNG in [0, 1], EXR, HDR and PFM linear; PSNR "
        "and SSIM take a range of 1. Images with alpha are compared over black, and so is alpha: one without "
        "it "
        "is opaque. "
        "The exit code is 0 if all gates are passed, or, without a gate (--min-..., --max-...), "
        "if the images "
        "are identical to the bit; and 1 if not.");
    command->add_option("A", options->reference, "the reference: PNG, EXR, HDR or PFM")->required();
    command->add_option("B", options->test, "the image to judge: PNG, EXR, HDR or PFM")->required();
    CLI::Option *statistical = command->add_flag(
        "--statistical", options->isStatistical,
        "ask whether two EXR renders can be estimates of one picture, by their variances: Welch's t "
        "of each pixel and channel, and of the image, with Sidak's correction; 1 if not");
    addSignificanceOption(*command, options->welch)->needs(statistical);
    addFile(*command, "--mask", options->mask, "FILE", "compare only where this image is white");
    addOutput(*command, "--diff", options->heatMap, "FILE.png",
              "write the FLIP error of each pixel as a heat map");
    addOutput(*command, "--report", options->report, "FILE.json", "write all numbers as JSON");
    addOutput(*command, "--html", options->html, "FILE.html",
              "write a page to look at both images and their difference, in any browser");
    addOutput(*command, "--junit", options->junit, "FILE.xml", "write the verdict as JUnit XML, for CI");

    constexpr Interval distance{0.0, 1e38};
    addNumber(*command, "--threshold", options->outlierThreshold, distance,
              "a pixel is an outlier if a channel differs by more than this")
        ->default_str("0");
    addNumber(*command, "--min-psnr", options->minPsnr, Interval{-1e6, 1e6}, "gate: minimum PSNR in dB");
    addNumber(*command, "--min-ssim", options->minSsim, Interval{-1.0, 1.0}, "gate: minimum mean SSIM");
    addNumber(*command, "--max-flip", options->maxFlip, limits::fraction, "gate: maximum mean FLIP error");
    addNumber(*command, "--max-diff", options->maxDifference, distance,
              "gate: maximum difference of a channel, also of alpha");
    addNumber(*command, "--max-outliers", options->maxOutliers, limits::fraction,
              "gate: maximum fraction of outliers, from 0 to 1");
    for (const char *option : {"--mask", "--diff", "--html", "--threshold", "--min-psnr", "--min-ssim",
                               "--max-flip", "--max-diff", "--max-outliers"})
        statistical->excludes(command->get_option(option));
    command->callback([options, &context] {
        const auto run = options->isStatistical ? runStatisticalDiff : runDiff;
        context.exitCode = run(*options, context.commandLine);
    });
}

} // namespace hyalite::core
