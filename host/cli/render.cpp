#include "host/cli/backend.h"
#include "host/cli/commands.h"
#include "host/image/image_file.h"
#include "host/report/progress.h"
#include "host/report/render_report.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace hyalite {

namespace {

struct RenderOptions {
    SceneOptions scene;
    std::string output;
    std::string device = "auto";
    int threads = 0;
    std::string report;
    bool isQuiet = false;
};

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

BackendResult renderWithProgress(Backend &backend, const PreparedScene &scene, bool isQuiet) {
    ProgressLine progress("render", isQuiet);
    return backend.render(scene, [&](double share) { progress.update(share); });
}

void runRender(const RenderOptions &options, const std::string &commandLine) {
    const Clock::time_point start = Clock::now();
    const ImageFormat format = imageFormatOf(options.output);
    // Opened before the work begins, so that an output that cannot be written is known now.
    AtomicFile image(options.output);
    std::optional<AtomicFile> reportFile;
    if (!options.report.empty())
        reportFile.emplace(options.report);

    const PreparedScene scene = prepareScene(options.scene);
    const RenderSettings &settings = scene.loaded.scene.settings;
    RenderReport report;
    report.commandLine = commandLine;
    report.scene = scene.loaded.file.string();
    report.output = options.output;
    report.width = scene.crop.width();
    report.height = scene.crop.height();
    report.settings = settings;
    report.triangleCount = scene.packed.triangles.size();
    report.loadSeconds = scene.loadSeconds;
    report.buildSeconds = scene.buildSeconds;

    const std::unique_ptr<Backend> backend = openBackend(options.device, options.threads);
    report.deviceName = backend->name();
    report.deviceDriver = backend->driver();
    if (!options.isQuiet)
        fmt::print(stderr, "device: {}\n", backend->description());
    const BackendResult result = renderWithProgress(*backend, scene, options.isQuiet);
    report.timing = result.timing;
    report.rays = result.rays;
    const Clock::time_point writeStart = Clock::now();
    writeImage(image, format, result.film.toImage(), settings.exposureStops);
    image.commit();
    report.writeSeconds = secondsSince(writeStart);
    report.totalSeconds = secondsSince(start);
    if (reportFile) {
        reportFile->write(formatReport(report));
        reportFile->commit();
    }
    if (!options.isQuiet)
        fmt::print("{}: {}x{}, {} spp, {:.2f} M rays in {:.3f} s: {:.1f} Mray/s ({:.3f} s in all)\n",
                   options.output, report.width, report.height, settings.samplesPerPixel,
                   static_cast<double>(report.rays.total()) / 1e6, report.timing.renderSeconds,
                   static_cast<double>(report.rays.total()) / 1e6 / report.timing.renderSeconds,
                   report.totalSeconds);
}

} // namespace

void addRenderCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command = app.add_subcommand("render", "render a scene to an image file");
    const auto options = std::make_shared<RenderOptions>();
    addSceneOptions(*command, options->scene);
    command->add_option("-o,--output", options->output, ".png: 8 bits, gamma 2.2; .pfm: linear float")
        ->required()
        ->type_name("FILE");
    command
        ->add_option(
            "--device", options->device,
            "auto: a GPU before software; cpu: the reference renderer; an index or part of a name as "
            "`hyalite devices` lists them")
        ->type_name("DEVICE")
        ->capture_default_str();
    command
        ->add_option("--threads", options->threads, "of the reference renderer and of lavapipe; default: all")
        ->check(CLI::Range(1, 1024));
    command->add_option("--report", options->report, "write what was done and how long it took")
        ->type_name("FILE.json");
    command->add_flag("--quiet", options->isQuiet, "print errors only");
    command->callback([options, &context] { runRender(*options, context.commandLine); });
}

} // namespace hyalite
