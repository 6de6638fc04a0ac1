#include "host/cli/commands.h"
#include "host/cli/device_options.h"
#include "host/cli/options.h"
#include "host/cli/terminal_observer.h"
#include "host/engine/open_backends.h"
#include "host/film/film_file.h"
#include "host/image/exr.h"
#include "host/image/exr_picture.h"
#include "host/image/image_file.h"
#include "host/image/png.h"
#include "host/jobs/denoising.h"
#include "host/jobs/film_picture.h"
#include "host/reference/denoise.h"
#include "host/report/provenance.h"
#include "host/scene/settings_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

namespace {

struct DenoiseOptions {
    std::string input;
    std::string output;
    std::optional<ToneCurve> tone;
    std::optional<double> exposureStops;
    RendererNames devices{"auto"};
    bool isQuiet = false;
};

/// Throws Error{Usage} for an option that the format of the output has not.
void requireOptions(const DenoiseOptions &options) {
    requireFileOptions({.tone = options.tone}, imageFormatOf(options.output), options.output);
    if (options.exposureStops && imageFormatOf(options.output) != ImageFormat::Png)
        throw Error(ErrorKind::Usage,
                    fmt::format("--exposure is for .png files: the output is {}, which holds "
                                "radiance as it is",
                                options.output));
    requireDistinctFiles({{"OUT", options.output}}, {options.input});
}

/// The attributes of an EXR: those of the input, but for the hash of its colours, and the denoiser.
std::vector<Attribute> keptAttributes(const ExrPicture &input) {
    std::vector<Attribute> attributes;
    for (const Attribute &attribute : input.attributes)
        if (attribute.first != pixelsAttribute && attribute.first != denoisedAttribute)
            attributes.push_back(attribute);
    return attributes;
}

void writeDenoised(AtomicFile &file, const ExrPicture &input, const Image &noisy, const Image &clean,
                   const DenoiseOptions &options, const std::string &commandLine, Observer &observer) {
    const ImageFormat format = imageFormatOf(options.output);
    Picture picture(clean);
    if (const ExrChannel *alpha = input.find("A"))
        picture.alpha = alpha->values;
    picture.wholeWidth = input.wholeWidth;
    picture.wholeHeight = input.wholeHeight;
    picture.crop = input.crop;
    picture.projection = input.projection;
    picture.layers = layersOf(input);
    if (input.find("noisy.R") == nullptr)
        picture.layers.push_back(noisyLayer(noisy));
    picture.attributes =
        format == ImageFormat::Exr ? keptAttributes(input) : attributesOf(programToJson(commandLine));
    picture.attributes.emplace_back(denoisedAttribute, reference::denoiserName);
    const FileOptions ofFile{options.tone.value_or(ToneCurve::Gamma), input.options};
    if (format == ImageFormat::Exr)
        picture.attributes.emplace_back(pixelsAttribute, exrPixelHash(picture, ofFile.exr));
    const std::vector<std::string> losses =
        writeImage(file, format, picture, options.exposureStops.value_or(0.0), ofFile);
    file.commit();
    for (const std::string &loss : losses)
        observer.warning(fmt::format("{}: {}", options.output, loss));
}

ExitCode runDenoise(const DenoiseOptions &options, const std::string &commandLine) {
    requireOptions(options);
    AtomicFile file(options.output);
    const InputFile inputFile(options.input);
    if (!isExr(inputFile.head(4)))
        throw Error(ErrorKind::BadInput,
                    fmt::format("cannot denoise '{}': it is not an OpenEXR file", options.input),
                    Remedy::DenoisingData);
    const ExrPicture input = readExrPicture(inputFile);
    if (imageFormatOf(options.output) == ImageFormat::Png)
        requirePngSize(options.output, input.crop.width(), input.crop.height());
    requireFilmMemory(input.crop, 0, 0, denoiserBytes(input.crop));
    const NoisyPicture noisy = noisyPictureOf(input, options.input);
    Image colours(noisy.width, noisy.height);
    std::ranges::transform(noisy.pixels, colours.pixels().begin(), &layout::NoisyPixel::colour);
    TerminalObserver observer(options.isQuiet);
    OpenedRenderers opened = openRenderers(options.devices, observer);
    if (!options.isQuiet)
        for (const std::string &note : opened.notes)
            observer.note(note);
    const std::unique_ptr<Backend> backend = std::move(opened.backend);
    std::optional<Image> clean;
    {
        const ObservedTask task(observer, "denoise", backend->hasCompiler());
        clean = backend->denoise(noisy);
    }
    writeDenoised(file, input, colours, *clean, options, commandLine, observer);
    return ExitCode::Ok;
}

} // namespace

void addDenoiseCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command = app.add_subcommand("denoise", "remove most of the noise of a rendered EXR");
    const auto options = std::make_shared<DenoiseOptions>();
    command->footer(
        "The picture has the bits that `hyalite render --denoise` would have written. An .exr keeps "
        "the layers and the texts of IN, and its noisy colours as the layer noisy.");
    command->add_option("IN", options->input, "an EXR of --denoising-data or --denoise; -: standard input")
        ->required();
    addOutput(*command, "OUT", options->output, "",
              "the picture: .png, .exr, .hdr or .pfm; -: a PNG to standard output, exr:- another format")
        ->required();
    addNumber(*command, "--exposure", options->exposureStops, rangeOf(&RenderSettings::exposureStops),
              "in stops: radiance is multiplied by 2^NUMBER before the tone curve of a PNG");
    addToneOption(*command, options->tone);
    addDevicesOption(*command, options->devices, "as for `hyalite render`: the bits are those of cpu");
    command->add_flag("--quiet", options->isQuiet, "print errors only");
    command->callback([options, &context] { context.exitCode = runDenoise(*options, context.commandLine); });
}

} // namespace hyalite::core
