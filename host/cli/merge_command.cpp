#include "host/base/message.h"
#include "host/base/quantities.h"
#include "host/cli/commands.h"
#include "host/cli/device_options.h"
#include "host/cli/options.h"
#include "host/cli/part_command.h"
#include "host/cli/render_request.h"
#include "host/cli/terminal_observer.h"
#include "host/engine/identity.h"
#include "host/engine/open_backends.h"
#include "host/farm/audit.h"
#include "host/farm/merge.h"
#include "host/image/png.h"
#include "host/import/assets.h"
#include "host/import/file_access.h"
#include "host/jobs/denoising.h"
#include "host/jobs/display.h"
#include "host/jobs/film_picture.h"
#include "host/reference/denoise.h"
#include "host/report/render_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

namespace {

struct MergeOptions {
    std::vector<std::string> parts;
    std::string output;
    bool isPartial = false;
    bool isDenoised = false;
    FileRequest file;
    std::optional<double> auditPercent;
    std::optional<std::uint32_t> auditSeed;
    RendererNames devices{"auto"};
    std::vector<std::filesystem::path> allowedPaths;
    std::string display;
    bool isQuiet = false;
};

constexpr std::size_t maxShown = 20; // of a list that may have thousands of lines

/// The lines, indented; of many, the first.
std::string listOf(const std::vector<std::string> &lines) {
    std::string text;
    for (std::size_t i = 0; i < std::min(lines.size(), maxShown); ++i)
        text += fmt::format("\n  {}", lines[i]);
    if (lines.size() > maxShown)
        text += fmt::format("\n  ... and {} more", lines.size() - maxShown);
    return text;
}

std::vector<std::string> commandsFor(const Merger &merger, const std::vector<std::uint32_t> &missing) {
    std::vector<std::string> commands;
    for (const std::uint32_t index : missing) {
        commands.push_back(
            commandFor(merger.origin(), merger.firstPart(), {index, merger.firstPart().count}));
        if (commands.size() > maxShown) // more are only counted
            break;
    }
    commands.resize(missing.size());
    return commands;
}

/// Throws Error{BadInput} unless the parts make a picture, or a part of one if that is enough.
void requireParts(const Merger &merger, ImageFormat format, const MergeOptions &options) {
    const Merger::Faults &faults = merger.faults();
    if (format == ImageFormat::Png && merger.hasParts())
        requirePngSize(options.output, merger.film().crop.width(), merger.film().crop.height());
    if (!merger.hasParts())
        throw Error(ErrorKind::BadInput,
                    fmt::format("there is no part to merge:{}", listOf(faults.unusable)));
    if (!faults.foreign.empty())
        throw Error(ErrorKind::BadInput,
                    fmt::format("the parts are not of one picture:{}", listOf(faults.foreign)));
    const std::vector<std::uint32_t> missing = merger.missing();
    if (missing.empty())
        return;
    const std::string lack =
        fmt::format("{} of {} parts are missing", missing.size(), merger.partition().partCount());
    const std::string unusable =
        faults.unusable.empty() ? "" : fmt::format("; of what is there:{}", listOf(faults.unusable));
    if (options.isPartial)
        printMessage("note: {}, and black in the picture{}\n", lack, unusable);
    else
        throw Error(
            ErrorKind::BadInput,
            fmt::format("{}{}\nthese commands make them, or go on with them:{}\n--partial makes a picture "
                        "of what is there",
                        lack, unusable, listOf(commandsFor(merger, missing))));
}

/// Throws Error{BadInput} for files of a part's command that the user of `merge` did not allow.
void requireAllowed(const SceneOptions &scene, const std::vector<std::filesystem::path> &allowedPaths) {
    const FileAccess access("./part", allowedPaths); // of the working folder
    for (const std::filesystem::path &file :
         {resolveScene(scene.scene), std::filesystem::path(scene.environment)})
        if (!file.empty() && !access.allows(file))
            throw Error(
                ErrorKind::BadInput,
                fmt::format("--audit: a part names '{}'; allowed: files in the working folder and in the "
                            "shipped assets",
                            file.string()),
                Remedy::AllowPath);
}

/// The renderers of --device, after notes on them.
std::unique_ptr<Backend> openBackend(const MergeOptions &options, Observer &observer) {
    OpenedRenderers opened = openRenderers(options.devices, observer);
    for (const std::string &note : opened.notes)
        printMessage("note: {}\n", note);
    return std::move(opened.backend);
}

/// The denoised colours, if they are wanted.
std::optional<Image> denoisedColours(const Merger &merger, const MergeOptions &options, Observer &observer) {
    if (!options.isDenoised && !merger.origin().isDenoised)
        return std::nullopt;
    const bool hasData = std::ranges::any_of(merger.layers(), &ViewFilm::isOfDenoiser);
    if (!hasData || merger.film().first.empty())
        throw Error(ErrorKind::Usage, "--denoise: the parts have none of the data that it needs",
                    Remedy::DenoisingData);
    if (!merger.missing().empty()) {
        observer.warning("the picture stays noisy: it lacks parts");
        return std::nullopt;
    }
    requireFilmMemory(merger.film().crop, 0, 0, denoiserBytes(merger.film().crop));
    return denoised(*openBackend(options, observer), merger.film(), merger.layers(), observer);
}

/// Whether all tiles that are drawn have the bits that this machine computes.
bool passesAudit(const Merger &merger, const MergeOptions &options, Observer &observer) {
    RenderRequest request = readRenderRequest(merger.origin().words);
    request.scene.load.allowedPaths = options.allowedPaths; // what a part says opens no others
    requireAllowed(request.scene, options.allowedPaths);
    const std::unique_ptr<Backend> backend = openBackend(options, observer);
    if (const gpu::BitGuarantee bits = backend->bits(); bits.degree == gpu::BitDegree::None)
        throw Error(
            ErrorKind::Usage,
            fmt::format("--audit: {} does not promise the bits of other devices ({}), so that it cannot "
                        "judge them; --device cpu can",
                        backend->description(), bits.reason));
    request.scene.settings.push_back({[&](RenderSettings &settings) {
        settings.samplesPerPixel = static_cast<int>(merger.samplesPerPixel());
        settings.noise = merger.noise();
    }});
    const PreparedScene scene = prepareScene(request.scene, Source::Dropped, observer);
    requireFilmMemory(scene.crop, 3);
    const std::vector<Integrator> views = merger.origin().views();
    const std::string here = identityText(identityOf(scene, *backend, &views));
    if (here != merger.identity() || scene.crop != merger.film().crop)
        throw Error(
            ErrorKind::BadInput,
            fmt::format("--audit: what `{}` renders here is another picture than that of the parts: {}; "
                        "on {} it ran in the folder {}",
                        request.scene.scene, describeDifferences(merger.identity(), here),
                        merger.origin().host, merger.origin().folder));
    const std::uint64_t seed = options.auditSeed ? std::uint64_t{*options.auditSeed} : auditSeed(merger);
    const AuditResult result = audit(merger, *backend, scene, *options.auditPercent / 100.0, seed, observer);
    for (const AuditFinding &finding : result.findings)
        printResult(
            "part {} of {} has other pixels than this machine computes, {} of the tile at {},{}, first "
            "{},{}: {}\n",
            finding.part, merger.partition().partCount(), finding.differingPixels, finding.tile.x0,
            finding.tile.y0, finding.x, finding.y, merger.describe(finding.part));
    if (!options.isQuiet)
        printResult("audit: {} of {} tiles, rendered again on {}, have other pixels\n",
                    result.findings.size(), result.tileCount, backend->description());
    return result.findings.empty();
}

/// Of the parts that are there.
PictureNoise noiseOf(const Merger &merger) {
    std::vector<Crop> squares;
    for (std::uint32_t part = 1; part <= merger.partition().partCount(); ++part)
        if (merger.has(part))
            std::ranges::copy(merger.partition().squaresOf(part), std::back_inserter(squares));
    return noiseOf(merger.film(), blocksInFilm(merger.film().crop, squares), merger.noiseTarget());
}

/// The provenance of the first part, and who made how many.
nlohmann::ordered_json provenanceOf(const Merger &merger, const std::string &commandLine) {
    nlohmann::ordered_json provenance = nlohmann::ordered_json::parse(merger.origin().provenance);
    provenance["commandLine"] = commandLine;
    provenance["parts"] = {{"count", merger.partition().partCount()}, {"merged", merger.partCount()}};
    if (const double wanted = merger.noise(); wanted > 0.0)
        provenance["noise"] = noiseToJson(noiseOf(merger), wanted);
    nlohmann::ordered_json &makers = provenance["parts"]["makers"]; // a list: their names are no keys
    makers = nlohmann::ordered_json::array();
    for (const auto &[maker, count] : merger.makers())
        makers.push_back({{"maker", maker}, {"parts", count}});
    return provenance;
}

void writePicture(AtomicFile &file, ImageFormat format, const Merger &merger,
                  const std::optional<Image> &clean, const MergeOptions &options,
                  const std::string &commandLine, Observer &observer) {
    const PartOrigin &origin = merger.origin();
    FilmPicture picture{.film = merger.film(), .views = merger.layers()};
    picture.wholeWidth = origin.wholeWidth;
    picture.wholeHeight = origin.wholeHeight;
    picture.attributes = attributesOf(provenanceOf(merger, commandLine));
    picture.settings.integrator = origin.integrator;
    picture.settings.exposureStops = origin.exposureStops;
    picture.settings.hasAlpha = origin.hasAlpha;
    picture.options = options.file.options();
    picture.projection = origin.projection;
    if (clean) {
        picture.clean = &*clean;
        picture.attributes.emplace_back(denoisedAttribute, reference::denoiserName);
    }
    const std::vector<std::string> losses = writeFilmPicture(file, format, picture);
    file.commit();
    for (const std::string &loss : losses)
        observer.warning(fmt::format("{}: {}", options.output, loss));
}

/// Of the pixels that are there.
std::string samplesText(const Merger &merger) {
    if (merger.noise() == 0.0)
        return fmt::format("{}", merger.samplesPerPixel());
    std::uint32_t fewest = merger.samplesPerPixel();
    std::uint32_t most = 0;
    for (const layout::FilmPixel &pixel : merger.film().pixels)
        if (pixel.sampleCount > 0) {
            fewest = std::min(fewest, pixel.sampleCount);
            most = std::max(most, pixel.sampleCount);
        }
    return fmt::format("{} to {}", fewest, most);
}

ExitCode runMerge(const MergeOptions &options, const std::string &commandLine) {
    const ImageFormat format = imageFormatOf(options.output);
    if (options.auditSeed && !options.auditPercent)
        throw Error(ErrorKind::Usage, "--audit-seed needs --audit PERCENT");
    requireFileOptions(options.file, format, options.output);
    requireDistinctFiles({{"--output", options.output}}, options.parts);
    AtomicFile file(options.output);
    std::unique_ptr<Display> display;
    if (!options.display.empty())
        display = std::make_unique<Display>(options.display, options.output);
    TerminalObserver observer(options.isQuiet);
    Merger merger;
    {
        using Clock = std::chrono::steady_clock;
        Clock::time_point due{};
        ObservedTask progress(observer, "merge");
        for (std::size_t i = 0; i < options.parts.size(); ++i) {
            merger.add(options.parts[i]);
            const bool isDue = i + 1 == options.parts.size() || Clock::now() >= due;
            if (isDue && merger.hasParts()) {
                showOn(display, observer, [&](Display &viewer) { viewer.update(merger.film()); });
                due = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                         std::chrono::duration<double>(Display::secondsBetween));
            }
            progress.update(static_cast<double>(i + 1) / static_cast<double>(options.parts.size()));
        }
    }
    requireParts(merger, format, options);
    const std::vector<std::string> &differences = merger.faults().differences;
    for (const std::string &difference : differences)
        printResult("{}\n", difference);
    if (!differences.empty() || (options.auditPercent && !passesAudit(merger, options, observer))) {
        printResult("{} is not written\n", options.output);
        return ExitCode::AnswerIsNo;
    }
    const bool hasLayers = std::ranges::any_of(merger.layers(), [](const ViewFilm &layer) {
        return layer.view != Integrator::Shadow && !layer.isOfDenoiser;
    }); // shadows are in alpha
    if (hasLayers && format != ImageFormat::Exr)
        printMessage("note: {} has no layers: those of the parts are for .exr files\n", options.output);
    const std::optional<Image> clean = denoisedColours(merger, options, observer);
    if (clean)
        showOn(display, observer, [&](Display &viewer) { viewer.show(*clean); });
    writePicture(file, format, merger, clean, options, commandLine, observer);
    if (!options.isQuiet)
        printResult("{}: {}x{}, {} spp, {} of {} parts, made by {}, {}\n", options.output,
                    merger.film().crop.width(), merger.film().crop.height(), samplesText(merger),
                    merger.partCount(), merger.partition().partCount(),
                    merger.makers().size() == 1 ? merger.makers().begin()->first
                                                : fmt::format("{} makers", merger.makers().size()),
                    roundedText(merger.rays().total(), "rays"));
    return ExitCode::Ok;
}

} // namespace

void addMergeCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command = app.add_subcommand("merge", "make a picture of its parts, from any machines");
    const auto options = std::make_shared<MergeOptions>();
    command->footer("`hyalite render --part I/N` makes parts. The picture has the bits of one render.");
    command->add_option("PART", options->parts, "the .part files; two of one part are compared, bit for bit")
        ->required();
    addOutput(*command, "-o,--output", options->output, "FILE",
              "the picture: .png, .exr, .hdr or .pfm; -: a PNG to standard output, exr:- another format")
        ->required();
    command->add_flag("--partial", options->isPartial, "merge what is there; missing parts are black");
    command->add_flag("--denoise", options->isDenoised,
                      "denoise parts of --denoising-data; those of --denoise are anyway");
    command
        ->add_option(
            "--audit", CLI::callback_t([options](const CLI::results_t &words) {
                const std::string &word = words.front();
                const bool isMarked = !word.empty() && word.back() == '%';
                options->auditPercent =
                    readNumber("--audit", isMarked ? std::string_view(word).substr(0, word.size() - 1) : word,
                               {0.0, 100.0, false});
                return true;
            }),
            "render this share of all tiles again on this machine, compare them bit for bit, and name "
            "the parts that differ; layers are not compared")
        ->type_name("PERCENT");
    addNumber(*command, "--audit-seed", options->auditSeed, {0.0, 4294967295.0},
              "chooses the tiles to audit, instead of a hash of the picture");
    addDevicesOption(*command, options->devices, "for --audit and to denoise: as for `hyalite render`");
    addPaths(*command, "--allow-path", options->allowedPaths,
             "for --audit: also read this file, or files in this folder; repeatable");
    addFileOptions(*command, options->file);
    addDisplayOption(*command, options->display);
    command->add_flag("--quiet", options->isQuiet, "print errors, and what differs, only");
    command->callback([options, &context] { context.exitCode = runMerge(*options, context.commandLine); });
}

} // namespace hyalite::core
