#include "host/base/message.h"
#include "host/base/quantities.h"
#include "host/cli/commands.h"
#include "host/cli/device_options.h"
#include "host/cli/layers_option.h"
#include "host/cli/options.h"
#include "host/cli/scene_options.h"
#include "host/film/film_file.h"
#include "host/image/png.h"
#include "host/import/assets.h"
#include "host/render/backend.h"
#include "host/render/identity.h"
#include "host/render/periodic_files.h"
#include "host/render/stop.h"
#include "host/report/render_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hyalite {

namespace {

struct RenderOptions {
    SceneOptions scene;
    std::string output;
    std::optional<ToneCurve> tone;
    std::vector<Integrator> layers;
    std::string device = "auto";
    int threads = 0;
    DeviceOptions deviceOptions;
    std::string report;
    std::optional<double> timeLimitSeconds;
    std::string checkpoint;
    std::optional<double> checkpointSeconds;
    bool isResuming = false;
    std::optional<double> partialSeconds;
    bool isQuiet = false;
};

constexpr Interval anySeconds{0.0, 1e9, false};

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The share of a render's samples that is finished, in percent. Rounded down: what is not complete is never 100 %.
double percentOf(std::uint64_t sampleCount, std::uint64_t pixelCount, const RenderSettings &settings) {
    const double share =
        static_cast<double>(sampleCount) / static_cast<double>(pixelCount) / settings.samplesPerPixel;
    return std::floor(share * 1000.0) / 10.0;
}

/// What there is of an image that is not complete, and where it is.
void tellWhatIsFinished(const RenderReport &report) {
    const std::uint64_t pixelCount =
        static_cast<std::uint64_t>(report.origin.width) * static_cast<std::uint64_t>(report.origin.height);
    printMessage("stopped by {}: {} of {} pixels are finished, {:.1f} % of the samples; {} has them\n",
                 report.stoppedBy, report.finished.pixelCount, pixelCount,
                 percentOf(report.finished.sampleCount, pixelCount, report.origin.settings), report.output);
}

/// The closing line: of what this run has done.
void tellSpeed(const RenderReport &report) {
    const std::uint64_t rayCount = report.rays.total() - (report.resumed ? report.resumed->rays.total() : 0);
    const double megaraysPerSecond =
        rayCount > 0 ? static_cast<double>(rayCount) / 1e6 / report.timing.renderSeconds : 0.0;
    fmt::print("{}: {}x{}, {}{} spp, {}{} in {:.3f} s: {:.{}f} Mray/s ({:.3f} s in all)\n", report.output,
               report.origin.width, report.origin.height, report.finished.isComplete ? "" : "up to ",
               report.origin.settings.samplesPerPixel, report.resumed ? "resumed, " : "",
               roundedText(rayCount, "rays"), report.timing.renderSeconds, megaraysPerSecond,
               megaraysPerSecond < 1.0 ? 3 : 1, report.totalSeconds);
}

/// Reads the checkpoint that is to be resumed, if there is one, and says so.
std::optional<ResumedCheckpoint> resume(const RenderOptions &options, const PreparedScene &scene,
                                        const RenderIdentity &identity) {
    const RenderSettings &settings = scene.loaded.scene.settings;
    std::optional<ResumedCheckpoint> resumed = resumeCheckpoint(
        options.checkpoint, identity, scene.crop, static_cast<std::uint32_t>(settings.samplesPerPixel));
    if (resumed && !resumed->damage.empty())
        printMessage("note: {}; going on from the older {}\n", resumed->damage, resumed->path.string());
    if (!resumed && !options.isQuiet)
        printMessage("there is no checkpoint {} yet: beginning anew\n", options.checkpoint);
    if (resumed && !options.isQuiet) {
        const Film &film = resumed->checkpoint.film;
        const std::uint64_t sampleCount = finishedWork(film, settings.samplesPerPixel).sampleCount;
        printMessage("resuming from {}: {:.1f} % of the samples are finished\n", resumed->path.string(),
                     percentOf(sampleCount, film.pixels.size(), settings));
    }
    return resumed;
}

void writeResult(AtomicFile &file, ImageFormat format, ToneCurve tone, const Film &film,
                 const std::vector<ViewFilm> &views, const PreparedScene &scene, const RenderReport &report) {
    const Image image = film.toImage();
    Picture picture(image);
    picture.wholeWidth = scene.loaded.scene.camera.width;
    picture.wholeHeight = scene.loaded.scene.camera.height;
    picture.crop = film.crop;
    picture.layers = filmLayers(film);
    std::ranges::move(viewLayers(views), std::back_inserter(picture.layers));
    picture.attributes = attributesOf(provenanceToJson(report.origin, report.device));
    writeFilm(file, format, film, picture, scene.loaded.scene.settings, tone);
}

ExitCode runRender(const RenderOptions &options, const std::string &commandLine) {
    const Clock::time_point start = Clock::now();
    const ImageFormat format = imageFormatOf(options.output);
    const std::string olderGeneration =
        options.checkpoint.empty() ? "" : olderCheckpoint(options.checkpoint).string();
    const std::vector<NamedFile> outputs{{"--output", options.output},
                                         {"--report", options.report},
                                         {"--checkpoint", options.checkpoint},
                                         {"--checkpoint", olderGeneration}};
    requireDistinctFiles(outputs, {resolveScene(options.scene.scene).string()});
    if (options.checkpoint.empty() && options.isResuming)
        throw Error(ErrorKind::Usage, "--resume needs --checkpoint FILE, to go on from");
    if (options.checkpoint.empty() && options.checkpointSeconds)
        throw Error(ErrorKind::Usage, "--checkpoint-interval needs --checkpoint FILE, to write each time");
    if (!options.checkpoint.empty() && options.device == "cpu-double")
        throw Error(ErrorKind::Usage,
                    "--checkpoint: cpu-double sums in double precision, which a checkpoint does "
                    "not hold; use --device cpu or a Vulkan device");
    if (!options.layers.empty() && format != ImageFormat::Exr)
        throw Error(ErrorKind::Usage,
                    fmt::format("--layers are for .exr files: --output is {}", options.output));
    // Opened before the work begins, so that an output that cannot be written is known now.
    AtomicFile image(options.output);
    std::optional<AtomicFile> reportFile;
    if (!options.report.empty())
        reportFile.emplace(options.report);
    if (!options.checkpoint.empty())
        const CheckpointWriter writability(options.checkpoint, {}, false);

    std::future<std::unique_ptr<Backend>> opening;
    const auto beginOpening = [&](const SceneOutline &outline) {
        opening = beginOpeningBackend(options.device, processorsFor(options.threads, outline),
                                      batchingFor(options.deviceOptions));
    };
    PreparedScene scene = prepareScene(options.scene, Source::Dropped, options.isQuiet, beginOpening);
    requireDistinctFiles(outputs, scene.loaded.inputFiles);
    if (format == ImageFormat::Png)
        requirePngSize(options.output, scene.crop.width(), scene.crop.height());
    requireFilmMemory(scene.crop, (options.checkpoint.empty() && !options.partialSeconds ? 1 : 2) +
                                      static_cast<unsigned>(options.layers.size()));
    const RenderSettings &settings = scene.loaded.scene.settings;
    RenderReport report;
    report.origin = provenanceOf(scene, commandLine);
    report.output = options.output;
    report.loadSeconds = scene.loadSeconds;
    report.buildSeconds = scene.buildSeconds;

    const std::unique_ptr<Backend> backend = opening.get();
    report.device = backend->identity(scene.packed, settings.integrator);
    // Until all is written: at the last moment, most would be lost.
    const CaughtSignals signals(options.isQuiet);
    if (!options.isQuiet) {
        printMessage("device: {}\n", backend->description());
        if (!backend->unpromisedBits().empty())
            printMessage("note: bits may differ from the CPU twin's: {}\n", backend->unpromisedBits());
    }
    const ToneCurve tone = options.tone.value_or(ToneCurve::Gamma);
    Continuation continuation;
    RayCounts raysBefore;
    std::optional<CheckpointWriter> checkpoint;
    std::vector<ViewFilm> views;
    std::vector<PeriodicFile> periodicFiles;
    if (!options.checkpoint.empty()) {
        const RenderIdentity identity = identityOf(scene, *backend);
        std::optional<ResumedCheckpoint> resumed;
        if (options.isResuming)
            resumed = resume(options, scene, identity);
        // Without --resume what is there is another render's, and may be gone with the second generation.
        checkpoint.emplace(options.checkpoint, identity, !resumed || resumed->damage.empty());
        if (resumed) {
            raysBefore = resumed->checkpoint.rays;
            report.resumed = ResumedWork{
                resumed->path.string(),
                finishedWork(resumed->checkpoint.film, settings.samplesPerPixel).sampleCount, raysBefore};
            continuation.film = std::move(resumed->checkpoint.film);
        }
        periodicFiles.push_back(
            {options.checkpointSeconds.value_or(10.0),
             [&](const Film &film, const RayCounts &rays) { checkpoint->write(film, raysBefore + rays); }});
    }
    if (options.partialSeconds)
        periodicFiles.push_back({*options.partialSeconds, [&](const Film &film, const RayCounts &) {
                                     AtomicFile partial(options.output);
                                     writeResult(partial, format, tone, film, views, scene, report);
                                     partial.commit();
                                 }});
    PeriodicFiles snapshots(scene.crop, std::move(periodicFiles));
    continuation.snapshots = &snapshots;
    const Clock::time_point renderStart = Clock::now();
    const auto shouldStop = [&] {
        return signals.first() != 0 ||
               (options.timeLimitSeconds && secondsSince(renderStart) >= *options.timeLimitSeconds);
    };
    views = renderViews(*backend, scene, options.layers, options.isQuiet, shouldStop);
    const BackendResult result = renderWithProgress(*backend, scene, "render", options.isQuiet, nullptr,
                                                    shouldStop, std::move(continuation));
    snapshots.finish();
    const int stoppingSignal = signals.first();
    report.finished = finishedWork(result.film, settings.samplesPerPixel);
    if (result.failure && report.finished.sampleCount == 0)
        throw Error(*result.failure);
    if (stoppingSignal != 0 && report.finished.sampleCount == 0)
        throw Error(errorKindOf(stoppingSignal),
                    fmt::format("stopped by {} before the first sample was finished: nothing is written",
                                signalName(stoppingSignal)));
    if (!report.finished.isComplete)
        report.stoppedBy = result.failure        ? "the device"
                           : stoppingSignal != 0 ? signalName(stoppingSignal)
                                                 : "the time limit";
    report.faults = result.faults;
    report.timing = result.timing;
    report.deviceBytes = result.memory.deviceBytes;
    report.rays = raysBefore + result.rays;
    const Clock::time_point writeStart = Clock::now();
    std::optional<Error> checkpointFailure;
    if (checkpoint) {
        try { // first: where there is no room for the picture, nothing is lost
            checkpoint->write(result.film, report.rays);
        } catch (const Error &error) {
            checkpointFailure.emplace(error);
        }
    }
    writeResult(image, format, tone, result.film, views, scene, report);
    image.commit();
    report.writeSeconds = secondsSince(writeStart);
    report.totalSeconds = secondsSince(start);
    if (reportFile) {
        reportFile->write(formatReport(report));
        reportFile->commit();
    }
    if (!report.finished.isComplete && (result.failure || stoppingSignal != 0 || !options.isQuiet))
        tellWhatIsFinished(report);
    if (!options.isQuiet)
        tellSpeed(report);
    if (checkpointFailure)
        throw *checkpointFailure;
    if (result.failure)
        throw Error(*result.failure);
    return signals.first() != 0 ? exitCodeOf(errorKindOf(signals.first())) : ExitCode::Ok;
}

} // namespace

void addRenderCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command = app.add_subcommand("render", "render a scene to an image file");
    const auto options = std::make_shared<RenderOptions>();
    addSceneOptions(*command, options->scene);
    command
        ->add_option("-o,--output", options->output,
                     ".png: 8 bits, gamma 2.2; .exr: linear float, with variance and "
                     "sample counts; .hdr, .pfm: linear")
        ->required()
        ->type_name("FILE");
    command
        ->add_option(
            "--device", options->device,
            "auto: a GPU before software; cpu: the reference renderer; an index or part of a name as "
            "`hyalite devices` lists them")
        ->type_name("DEVICE")
        ->capture_default_str();
    addToneOption(*command, options->tone);
    addLayersOption(*command, options->layers);
    addThreadsOption(*command, options->threads);
    addDeviceOptions(*command, options->deviceOptions);
    addFile(*command, "--report", options->report, "FILE.json", "write what was done and how long it took");
    addNumber(*command, "--time-limit", options->timeLimitSeconds, anySeconds,
              "stop then, and write what is finished; loading and building do not count")
        ->type_name("SECONDS");
    const char *group = "Long renders";
    addFile(
        *command, "--checkpoint", options->checkpoint, "FILE",
        "write what is finished there again and again, and when the render ends; FILE.1 is the one before")
        ->group(group);
    addNumber(*command, "--checkpoint-interval", options->checkpointSeconds, anySeconds,
              "between two checkpoints")
        ->type_name("SECONDS")
        ->default_str("10")
        ->group(group);
    command
        ->add_flag("--resume", options->isResuming,
                   "go on from the checkpoint, if there is one, to the same image; --device, --threads, "
                   "--kernel, --bvh and more --spp may be others")
        ->group(group);
    addNumber(*command, "--partial", options->partialSeconds, anySeconds,
              "replace the output by what is finished, again and again after so long")
        ->type_name("SECONDS")
        ->group(group);
    command->add_flag("--quiet", options->isQuiet, "print errors only");
    command->callback([options, &context] { context.exitCode = runRender(*options, context.commandLine); });
}

} // namespace hyalite
