#include "host/cli/commands.h"
#include "host/cli/options.h"
#include "host/image/image_file.h"
#include "host/image/png.h"
#include "host/image/tone_map.h"
#include "host/report/provenance.h"
#include "host/scene/settings_table.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

namespace hyalite::core {

namespace {

struct ToneMapOptions {
    std::string input;
    std::string output;
    std::optional<ToneCurve> tone;
    double exposureStops = 0.0;
};

ExitCode runToneMap(const ToneMapOptions &options, const std::string &commandLine) {
    if (imageFormatOf(options.output) != ImageFormat::Png)
        throw Error(ErrorKind::Usage, fmt::format("'{}': the output must be a .png file", options.output));
    requireDistinctFiles({{"OUT", options.output}}, {options.input});
    AtomicFile file(options.output);
    const LoadedImage loaded = readImage(options.input);
    if (loaded.encoding != Encoding::Linear)
        throw Error(
            ErrorKind::BadInput,
            fmt::format("cannot use image '{}': a PNG is tone-mapped already; name an EXR, HDR or PFM file",
                        options.input));
    Picture picture(loaded.image);
    picture.alpha = loaded.alpha;
    picture.attributes = attributesOf(programToJson(commandLine));
    writeImage(file, ImageFormat::Png, picture, options.exposureStops,
               {.tone = options.tone.value_or(ToneCurve::Gamma)});
    file.commit();
    return ExitCode::Ok;
}

} // namespace

void addToneMapCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command = app.add_subcommand("tonemap", "make a PNG of an image of linear radiance");
    const auto options = std::make_shared<ToneMapOptions>();
    command->footer(
        "The PNG has the pixels that `hyalite render` would have written with the same options, and the "
        "alpha of an EXR.");
    command->add_option("IN", options->input, "EXR, HDR or PFM; -: standard input")->required();
    addOutput(*command, "OUT", options->output, "", "the .png to write; -: standard output")->required();
    addNumber(*command, "--exposure", options->exposureStops, rangeOf(&RenderSettings::exposureStops),
              "in stops: radiance is multiplied by 2^NUMBER")
        ->default_str("0");
    addToneOption(*command, options->tone);
    command->callback([options, &context] { context.exitCode = runToneMap(*options, context.commandLine); });
}

} // namespace hyalite::core
