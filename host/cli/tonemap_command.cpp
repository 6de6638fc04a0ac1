#include "host/cli/commands.h"
#include "host/cli/options.h"
#include "host/image/exr.h"
#include "host/image/false_colour.h"
#include "host/image/image_file.h"
#include "host/image/png.h"
#include "host/image/tone_map.h"
#include "host/report/provenance.h"
#include "host/scene/settings_table.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

namespace {

struct ToneMapOptions {
    std::string input;
    std::string output;
    std::string layer; ///< empty: the picture
    std::optional<ToneCurve> tone;
    std::optional<double> exposureStops;
};

/// The layer by the tone curve or, if it has one value a pixel, in false colours.
Drawing drawLayer(const ToneMapOptions &options) {
    const InputFile input(options.input);
    if (!isExr(input.head(4)))
        throw input.bad("it has no layers; name an EXR file");
    const Image values = readExr(input, options.layer);
    Drawing drawing;
    drawing.width = values.width();
    drawing.height = values.height();
    if (!isGreyExrLayer(input, options.layer)) {
        drawing.rgb =
            toneMap(values, options.exposureStops.value_or(0.0), options.tone.value_or(ToneCurve::Gamma));
        return drawing;
    }
    if (options.tone || options.exposureStops)
        throw Error(ErrorKind::Usage,
                    fmt::format("{} is for colours: layer {} has one value a pixel, shown in false colours",
                                options.tone ? "--tone" : "--exposure", options.layer));
    std::vector<float> numbers;
    for (const glm::vec3 &pixel : values.pixels()) {
        if (!std::isfinite(pixel.x) || pixel.x < 0.0f)
            throw input.bad(fmt::format("its layer {} has values that are negative or not finite, for which "
                                        "there are no false colours",
                                        options.layer));
        numbers.push_back(pixel.x);
    }
    return falseColours(drawing.width, drawing.height, numbers, options.layer);
}

ExitCode runToneMap(const ToneMapOptions &options, const std::string &commandLine) {
    if (imageFormatOf(options.output) != ImageFormat::Png)
        throw Error(ErrorKind::Usage, fmt::format("'{}': the output must be a .png file", options.output));
    requireDistinctFiles({{"OUT", options.output}}, {options.input});
    AtomicFile file(options.output);
    const std::vector<Attribute> attributes = attributesOf(programToJson(commandLine));
    if (!options.layer.empty()) {
        const Drawing drawing = drawLayer(options);
        writePng(file, drawing.width, drawing.height, drawing.rgb, attributes);
        file.commit();
        return ExitCode::Ok;
    }
    const LoadedImage loaded = readImage(options.input);
    if (loaded.encoding != Encoding::Linear)
        throw Error(
            ErrorKind::BadInput,
            fmt::format("cannot use image '{}': a PNG is tone-mapped already; name an EXR, HDR or PFM file",
                        options.input));
    Picture picture(loaded.image);
    picture.alpha = loaded.alpha;
    picture.attributes = attributes;
    writeImage(file, ImageFormat::Png, picture, options.exposureStops.value_or(0.0),
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
    command
        ->add_option("--layer", options->layer,
                     "of an EXR, instead of its picture: colours by the tone curve, single values, as of "
                     "samples or depth, in false colours with a legend")
        ->type_name("NAME");
    command->callback([options, &context] { context.exitCode = runToneMap(*options, context.commandLine); });
}

} // namespace hyalite::core
