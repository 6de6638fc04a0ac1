#include "host/base/message.h"
#include "host/cli/commands.h"
#include "host/cli/compare_options.h"
#include "host/cli/device_options.h"
#include "host/cli/options.h"
#include "host/cli/scene_options.h"
#include "host/cli/statistical.h"
#include "host/scene/settings_table.h"

#include <fmt/format.h>

#include <memory>

namespace hyalite::core {

namespace {

void addStatisticalOptions(CLI::App &command, CompareOptions &options) {
    CLI::Option *statistical =
        command.add_flag("--statistical", options.isStatistical,
                         "render with two seeds, and ask whether both can be "
                         "estimates of one picture, as `hyalite diff --statistical` does");
    addSignificanceOption(command, options.welch)->needs(statistical);
    addNumber(command, "--against-seed", options.againstSeed, rangeOf(&RenderSettings::seed),
              "seed of the second render of --statistical; default: the first seed plus 1")
        ->needs(statistical);
    for (const char *option : {"--tolerance", "--max-outliers", "--diff", "--html"})
        statistical->excludes(command.get_option(option));
}

} // namespace

void printRenderers(const PreparedScene &scene, const ComparisonRun &run) {
    printResult("scene        {}: {}x{}, {} spp\n", scene.loaded.file.string(), scene.crop.width(),
                scene.crop.height(), scene.loaded.settings.samplesPerPixel);
    printResult("first        {}\nsecond       {}\n", run.first->description(), run.second->description());
    for (const Backend *backend : {run.first.get(), run.second.get()})
        if (const gpu::BitGuarantee bits = backend->bits(); bits.degree != gpu::BitDegree::Promised)
            printResult("note         equal bits are not promised by {}: {}\n", backend->name(), bits.reason);
}

void addCompareCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command =
        app.add_subcommand("compare", "render a scene twice and compare the images bit for bit");
    const auto options = std::make_shared<CompareOptions>();
    addSceneOptions(*command, options->scene);
    command
        ->add_option(
            "scenes", options->moreScenes,
            "more scenes, one after another by the same options; --html is an index of their pages then")
        ->type_name("SCENE...");
    command->add_option("--device", options->comparison.device, "the first renderer: as for `hyalite render`")
        ->type_name("DEVICE")
        ->capture_default_str();
    command
        ->add_option("--against", options->comparison.against,
                     "the second renderer: cpu, the twin of the kernels; cpu-double, which measures the "
                     "error of float32 "
                     "and explains outliers; or another device")
        ->type_name("DEVICE")
        ->capture_default_str();
    command
        ->add_option("--tolerance", options->tolerance,
                     "allowed difference of a channel: linear radiance (1e-5) or ULPs (4ulp)")
        ->type_name("DIFFERENCE")
        ->capture_default_str();
    addNumber(*command, "--max-outliers", options->maxOutliers, limits::fraction,
              "allowed fraction of pixels beyond the tolerance")
        ->default_str("0");
    addThreadsOption(*command, options->comparison.threadCount);
    addDeviceOptions(*command, options->comparison.deviceOptions);
    addOutput(*command, "--diff", options->heatMap, "FILE.png",
              "write a heat map of the difference (HDR-FLIP)");
    addOutput(*command, "--report", options->report, "FILE.json", "write all metrics");
    addOutput(*command, "--html", options->html, "FILE.html",
              "write a page to look at both images and their difference, in any browser");
    addOutput(*command, "--junit", options->junit, "FILE.xml", "write the verdict as JUnit XML, for CI");
    command->add_flag("--quiet", options->isQuiet, "print the result only");
    addStatisticalOptions(*command, *options);
    command->callback([options, &context] {
        const auto run = options->isStatistical ? runStatisticalCompare : runCompare;
        context.exitCode = run(*options, context.commandLine);
    });
}

} // namespace hyalite::core
