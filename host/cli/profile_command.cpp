#include "host/base/json_text.h"
#include "host/base/message.h"
#include "host/base/quantities.h"
#include "host/cli/commands.h"
#include "host/cli/device_options.h"
#include "host/cli/options.h"
#include "host/cli/scene_options.h"
#include "host/film/film_file.h"
#include "host/image/metrics.h"
#include "host/image/png.h"
#include "host/image/tone_map.h"
#include "host/import/assets.h"
#include "host/render/backend.h"
#include "host/report/baseline.h"
#include "host/report/profile.h"
#include "host/report/profile_csv.h"
#include "host/report/profile_html.h"
#include "host/report/profile_json.h"
#include "host/report/profile_table.h"
#include "host/report/trace_json.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace hyalite {

namespace {

struct ProfileOptions {
    SceneOptions scene;
    std::string device = "auto";
    int threads = 0;
    DeviceOptions deviceOptions;
    int warmupCount = 1;
    int repeatCount = 5;
    bool isUnverified = false;
    bool isCounting = false;
    std::string output;
    std::string report;
    std::string csv;
    std::string trace;
    std::string html;
    std::string heatMap;
    std::string baseline;
    std::string maxRegression = "5%";
    std::optional<Gate> gate;
    bool isQuiet = false;
};

constexpr Interval warmupCounts{0, 1000};
constexpr Interval repeatCounts{1, 10'000};
constexpr Interval regressionPercents{0.0, 1e6};
constexpr std::array<Name<Gate>, 3> gateNames{
    {{"all", Gate::All}, {"times", Gate::Times}, {"work", Gate::Work}}};

/// "5%" as 0.05. Throws Error{Usage}.
double parsePercent(const std::string &option, const std::string &text) {
    if (!text.ends_with('%'))
        refuseValue(option, text, "a percentage such as 5%");
    return readNumber(option, std::string_view(text).substr(0, text.size() - 1), regressionPercents) / 100.0;
}

/// The files that a profile is written to. They are opened before the work begins, so that one that cannot be written
/// is known then, and appear when all is done.
struct Outputs {
    std::optional<AtomicFile> image;
    std::optional<AtomicFile> report;
    std::optional<AtomicFile> csv;
    std::optional<AtomicFile> trace;
    std::optional<AtomicFile> html;
    std::optional<AtomicFile> heatMap;

    explicit Outputs(const ProfileOptions &options) {
        requireDistinctFiles(names(options), {resolveScene(options.scene.scene).string(), options.baseline});
        open(image, options.output);
        open(report, options.report);
        open(csv, options.csv);
        open(trace, options.trace);
        open(html, options.html);
        open(heatMap, options.heatMap);
    }

    static std::vector<NamedFile> names(const ProfileOptions &options) {
        return {{"--output", options.output}, {"--report", options.report}, {"--csv", options.csv},
                {"--trace", options.trace},   {"--html", options.html},     {"--heatmap", options.heatMap}};
    }

  private:
    static void open(std::optional<AtomicFile> &file, const std::string &path) {
        if (!path.empty())
            file.emplace(path);
    }
};

void store(std::optional<AtomicFile> &file, const std::string &text) {
    if (!file)
        return;
    file->write(text);
    file->commit();
}

/// One render, with all that it did.
Film renderFrame(Backend &backend, const PreparedScene &scene, const std::string &label, bool isMeasured,
                 Profile &profile, bool isQuiet) {
    Frame frame;
    frame.label = label;
    frame.isMeasured = isMeasured;
    Stopwatch watch;
    BackendResult result = renderWithProgress(backend, scene, label, isQuiet, &frame.timeline);
    frame.span = watch.lap();
    profile.frames.push_back(std::move(frame));
    return std::move(result.film);
}

std::vector<Attribute> originOf(const Profile &profile) {
    return attributesOf(provenanceToJson(profile.origin, profile.device));
}

std::vector<std::byte> pngOf(const Drawing &drawing, const Profile &profile) {
    return encodePng(drawing.width, drawing.height, drawing.rgb, originOf(profile));
}

/// Renders once more, and counts what the traversal of the measured kernel does.
KernelWork countKernelWork(const ProfileOptions &options, const PreparedScene &scene) {
    gpu::Batching batching = batchingFor(options.deviceOptions);
    batching.isCounting = true;
    const std::unique_ptr<Backend> counter =
        openBackend(options.device, processorsFor(options.threads, scene), batching);
    const BackendResult result =
        renderWithProgress(*counter, scene, "counting the kernel's work", options.isQuiet);
    return {counter->identity(scene.packed, scene.loaded.scene.settings.integrator).kernel, result.work,
            result.lanes};
}

/// Renders the work of a traversal with a stack, whichever kernel is measured, and writes down what it came to.
Drawing countWork(const ProfileOptions &options, PreparedScene &scene, Profile &profile) {
    const std::unique_ptr<Backend> counter =
        openBackend(options.device, processorsFor(options.threads, scene));
    RenderSettings &settings = scene.loaded.scene.settings;
    const Integrator measured = std::exchange(settings.integrator, Integrator::Cost);
    const BackendResult result = renderWithProgress(*counter, scene, "counting", options.isQuiet);
    settings.integrator = measured;
    profile.work = result.work;
    profile.workHistogram = binWork(testsPerSample(result.film));
    return drawCost(result.film);
}

RayCounts raysOf(const Frame &frame) {
    RayCounts rays;
    for (const DispatchRecord &dispatch : frame.timeline.dispatches)
        rays += dispatch.rays;
    return rays;
}

/// Renders a first frame and compares it with the CPU twin's. Returns why nothing should be measured, or nothing.
std::optional<std::string> verify(Backend &backend, const PreparedScene &scene, Profile &profile,
                                  bool isQuiet) {
    const Film film = renderFrame(backend, scene, "verification", false, profile, isQuiet);
    const std::unique_ptr<Backend> twin = openBackend("cpu");
    Stopwatch watch;
    const BackendResult wanted = renderWithProgress(*twin, scene, "the CPU twin", isQuiet);
    profile.hostStages.push_back({"the CPU twin", watch.lap()});
    if (const std::size_t count = differingPixelCount(film, wanted.film); count > 0)
        return fmt::format("{} of {} pixels differ from the CPU twin's", count, film.pixels.size());
    if (const RayCounts rays = raysOf(profile.frames.back()); rays != wanted.rays)
        return fmt::format("{} rays were traced, and {} by the CPU twin", rays.total(), wanted.rays.total());
    profile.isVerified = true;
    profile.verification = "equal to the CPU twin, bit for bit, ray counts too";
    return std::nullopt;
}

/// Loads the scene and opens the device, and writes both down.
PreparedScene prepare(const ProfileOptions &options, const std::string &commandLine,
                      std::unique_ptr<Backend> &backend, Profile &profile) {
    Stopwatch watch;
    PreparedScene scene = prepareScene(options.scene, Source::Dropped, options.isQuiet);
    requireDistinctFiles(Outputs::names(options), scene.loaded.inputFiles);
    const Span prepared = watch.lap();
    const auto nanos = [](double seconds) { return std::llround(seconds * 1e9); };
    const std::int64_t loaded = prepared.beginNanos + nanos(scene.loadSeconds);
    profile.hostStages.push_back({"load", {prepared.beginNanos, loaded}});
    profile.hostStages.push_back({"build", {loaded, loaded + nanos(scene.buildSeconds)}});
    requireFilmMemory(scene.crop, 2);
    watch = {};
    backend = openBackend(options.device, processorsFor(options.threads, scene),
                          batchingFor(options.deviceOptions));
    profile.hostStages.push_back({"open the device", watch.lap()});
    profile.origin = provenanceOf(scene, commandLine);
    profile.device = backend->identity(scene.packed, profile.origin.settings.integrator);
    profile.sceneBytes = scene.packed.sizeBytes();
    return scene;
}

void printHead(const Profile &profile, const Backend &backend) {
    const Provenance &origin = profile.origin;
    fmt::print("scene        {}: {}x{}, {} spp, {}, {} of scene data\n", origin.scene, origin.width,
               origin.height, origin.settings.samplesPerPixel, countText(origin.triangleCount, "triangle"),
               sizeText(profile.sceneBytes));
    fmt::print("device       {}\n", backend.description());
}

void printMeasured(const Profile &profile) {
    std::size_t measured = 0;
    for (const Frame &frame : profile.frames)
        measured += frame.isMeasured ? 1u : 0u;
    fmt::print("verified     {}\n", profile.verification);
    fmt::print("clock        {}\n", profile.frames.back().timeline.clock);
    fmt::print("measured     {}, after {} that {} not\n", countText(measured, "frame"),
               profile.frames.size() - measured, profile.frames.size() - measured == 1 ? "is" : "are");
    if (const std::uint64_t bytes = mostDeviceBytes(profile); bytes > 0)
        fmt::print("memory       {} in buffers on the device\n", sizeText(bytes));
    fmt::print("\n{}", profileTable(profile));
}

ExitCode runProfile(const ProfileOptions &options, const std::string &commandLine) {
    if (!options.heatMap.empty() && imageFormatOf(options.heatMap) != ImageFormat::Png)
        throw Error(ErrorKind::Usage, fmt::format("--heatmap {}: the heat map is a .png", options.heatMap));
    const ImageFormat format = options.output.empty() ? ImageFormat::Png : imageFormatOf(options.output);
    const double maxRegression = parsePercent("--max-regression", options.maxRegression);
    std::optional<ProfileFigures> baseline;
    if (!options.baseline.empty())
        baseline = readFigures(options.baseline);
    Outputs outputs(options);
    Profile profile;
    std::unique_ptr<Backend> backend;
    PreparedScene scene = prepare(options, commandLine, backend, profile);
    if (outputs.image && format == ImageFormat::Png)
        requirePngSize(options.output, profile.origin.width, profile.origin.height);
    if (outputs.html)
        requirePngSize(options.html, profile.origin.width, profile.origin.height);
    if (baseline)
        requireSameJob(*baseline, profile);
    printHead(profile, *backend);

    const bool isVerifiable = !isReference(options.device);
    if (!isVerifiable || options.isUnverified) {
        profile.verification =
            options.isUnverified ? "not verified, as asked" : "not verified: it is the reference itself";
    } else if (const auto fault = verify(*backend, scene, profile, options.isQuiet)) {
        fmt::print(
            "NOT verified: {}. Nothing is measured: `hyalite compare` tells more, --no-verify measures "
            "all the same{}\n",
            *fault,
            backend->unpromisedBits().empty()
                ? ""
                : fmt::format(" (bits are not promised here: {})", backend->unpromisedBits()));
        return ExitCode::AnswerIsNo;
    }
    for (int i = 1; i <= options.warmupCount; ++i)
        (void)renderFrame(*backend, scene, fmt::format("warm-up {}", i), false, profile, options.isQuiet);
    std::optional<Film> film;
    for (int i = 1; i <= options.repeatCount; ++i)
        film = renderFrame(*backend, scene, fmt::format("repeat {}", i), true, profile, options.isQuiet);
    std::vector<std::byte> heatMapPng;
    if (options.isCounting || outputs.heatMap || (outputs.html && scene.packed.hasTriangles))
        heatMapPng = pngOf(countWork(options, scene, profile), profile);
    if (options.isCounting && isVerifiable)
        profile.kernelWork = countKernelWork(options, scene);
    if (outputs.image) {
        Stopwatch watch;
        const Image image = film->toImage();
        Picture picture(image);
        picture.attributes = originOf(profile);
        writeFilm(*outputs.image, format, *film, picture, profile.origin.settings);
        outputs.image->commit();
        profile.hostStages.push_back({"write", watch.lap()});
    }
    printMeasured(profile);
    store(outputs.report, jsonText(profileToJson(profile)));
    store(outputs.csv, profileCsv(profile));
    store(outputs.trace, jsonText(profileToTrace(profile)));
    if (outputs.html)
        store(outputs.html,
              profileHtml(profile, pngOf(drawFilm(*film, profile.origin.settings), profile), heatMapPng));
    if (outputs.heatMap) {
        outputs.heatMap->write(heatMapPng);
        outputs.heatMap->commit();
    }
    if (!baseline)
        return ExitCode::Ok;
    const Gate gate = options.gate.value_or(Gate::All);
    const BaselineComparison comparison =
        compareWithBaseline(*baseline, figuresOf(profile), maxRegression, gate);
    fmt::print("\n{}", comparisonTable(comparison, maxRegression, gate));
    return comparison.isPassed ? ExitCode::Ok : ExitCode::AnswerIsNo;
}

} // namespace

void addProfileCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command =
        app.add_subcommand("profile", "render a scene again and again, and tell where the time goes");
    const auto options = std::make_shared<ProfileOptions>();
    addSceneOptions(*command, options->scene);
    command->add_option("--device", options->device, "what to measure: as for `hyalite render`")
        ->type_name("DEVICE")
        ->capture_default_str();
    addThreadsOption(*command, options->threads);
    addDeviceOptions(*command, options->deviceOptions);
    addNumber(*command, "--warmup", options->warmupCount, warmupCounts,
              "renders before those that are measured")
        ->default_str("1");
    addNumber(*command, "--repeat", options->repeatCount, repeatCounts, "renders that are measured")
        ->default_str("5");
    command->add_flag("--no-verify", options->isUnverified,
                      "do not compare the image with the CPU twin's first");
    addFile(*command, "-o,--output", options->output, "FILE", "write the image, too, and time that");
    addFile(*command, "--report", options->report, "FILE.json",
            "write all figures, as --baseline reads them");
    addFile(*command, "--csv", options->csv, "FILE.csv", "write a line for each dispatch");
    addFile(*command, "--trace", options->trace, "FILE.json",
            "write a timeline that ui.perfetto.dev and chrome://tracing open");
    command->add_flag("--counts", options->isCounting,
                      "render twice more and count nodes, boxes and triangles of a traversal with a stack, "
                      "and of the kernel's own, and how busy its lanes are");
    addFile(*command, "--heatmap", options->heatMap, "FILE.png",
            "render once more, and write how many boxes and triangles each pixel tests, in false colours");
    addFile(*command, "--html", options->html, "FILE.html",
            "render once more, and write a page with the image, the heat map, the figures and where they "
            "come from");
    addFile(*command, "--baseline", options->baseline, "FILE.json",
            "compare with an older --report; a regression is exit code 1");
    command
        ->add_option(
            "--max-regression", options->maxRegression,
            "how much slower a kernel may be than in the baseline, beyond the noise, and how much more "
            "work may be done")
        ->type_name("PERCENT%")
        ->capture_default_str();
    addChoice(*command, "--gate", options->gate, gateNames,
              "what fails: times and work counts (all, the default), or one of them; counts do not jitter");
    command->add_flag("--quiet", options->isQuiet, "show no progress");
    command->callback([options, &context] { context.exitCode = runProfile(*options, context.commandLine); });
}

} // namespace hyalite
