#include "host/base/message.h"
#include "host/base/quantities.h"
#include "host/cli/commands.h"
#include "host/cli/device_options.h"
#include "host/cli/options.h"
#include "host/cli/profile_files.h"
#include "host/cli/scene_options.h"
#include "host/cli/terminal_observer.h"
#include "host/import/assets.h"
#include "host/lab/measurement.h"
#include "host/report/baseline_json.h"
#include "host/report/figure_text.h"
#include "host/report/profile_table.h"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {

namespace {

struct ProfileOptions {
    MeasurementRequest measurement;
    bool isQuiet = false;
    ProfilePaths paths;
    std::string baseline;
    std::optional<std::string> maxRegression; ///< default: 5%
    std::optional<Gate> gate;
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

void printHead(const Profile &profile, const Backend &backend) {
    const Provenance &origin = profile.origin;
    printResult("scene        {}: {}x{}, {} spp, {}, {} of scene data\n", origin.scene, origin.width,
                origin.height, origin.settings.samplesPerPixel, countText(origin.triangleCount, "triangle"),
                sizeText(profile.sceneBytes));
    printResult("device       {}\n", backend.description());
}

void printMeasured(const Profile &profile) {
    std::size_t measured = 0;
    for (const Frame &frame : profile.frames)
        measured += frame.isMeasured ? 1u : 0u;
    printResult("verified     {}\n", profile.verification);
    printResult("clock        {}\n", profile.frames.back().timeline.clock);
    printResult("measured     {}, after {} that {} not\n", countText(measured, "frame"),
                profile.frames.size() - measured, profile.frames.size() - measured == 1 ? "is" : "are");
    const std::optional<StartSummary> warm = summariseWarmFrame(profile);
    printResult("cold start   {} ms from loading to the end of the first frame{}\n",
                millisText(summariseColdStart(profile).millis),
                warm ? fmt::format("; a later frame takes {} ms", millisText(warm->millis)) : "");
    if (const std::uint64_t bytes = maxDeviceBytes(profile); bytes > 0)
        printResult("memory       {} in buffers on the device\n", sizeText(bytes));
    if (profile.charges) {
        printResult("dearest      {}\n", cleanText(dearestText(*profile.charges)));
        printResult("shading      {}\n", shadingText(profile.charges->shading));
    }
    for (const std::string &omission : profile.leftOut)
        printResult("left out     by the time limit: {}\n", omission);
    fmt::print("\n{}", cleanText(profileTable(profile)));
}

void printFault(const std::string &fault, const Backend &backend) {
    printResult("NOT verified: {}. Nothing was measured: `hyalite compare` says more, --no-verify measures "
                "anyway{}\n",
                fault,
                backend.bits().degree == gpu::BitDegree::Promised
                    ? ""
                    : fmt::format(" (equal bits are not promised here: {})", backend.bits().reason));
}

/// The baseline's figures and the allowed regression.
struct Baseline {
    std::optional<ProfileFigures> figures; ///< empty: no comparison
    double maxRegression = 0.0;
    Gate gate = Gate::All;
};

Baseline readBaseline(const ProfileOptions &options) {
    if (options.baseline.empty() && (options.gate || options.maxRegression))
        throw Error(ErrorKind::Usage, fmt::format("{} needs --baseline FILE.json to compare with",
                                                  options.gate ? "--gate" : "--max-regression"));
    Baseline baseline;
    baseline.maxRegression = parsePercent("--max-regression", options.maxRegression.value_or("5%"));
    baseline.gate = options.gate.value_or(Gate::All);
    if (!options.baseline.empty())
        baseline.figures = readFigures(options.baseline);
    return baseline;
}

/// Nothing without a baseline, or if the time limit left nothing to compare.
std::optional<BaselineVerdict> judge(const Measurement &measurement, const Baseline &baseline) {
    if (!baseline.figures || measurement.isCut)
        return std::nullopt;
    return BaselineVerdict{compareWithBaseline(*baseline.figures, figuresOf(measurement.profile),
                                               baseline.maxRegression, baseline.gate),
                           baseline.figures->report, baseline.maxRegression, baseline.gate};
}

ExitCode printVerdict(const std::optional<BaselineVerdict> &verdict) {
    if (!verdict) {
        printResult("\nNOT compared with the baseline: the time limit ended what it is compared with\n");
        return ExitCode::AnswerIsNo;
    }
    fmt::print("\n{}",
               cleanText(comparisonTable(verdict->comparison, verdict->maxRegression, verdict->gate)));
    return verdict->comparison.isPassed ? ExitCode::Ok : ExitCode::AnswerIsNo;
}

ExitCode runProfile(const ProfileOptions &options, const std::string &commandLine) {
    const Baseline baseline = readBaseline(options);
    MeasurementRequest request = options.measurement;
    request.isCharging = request.isCounting || !options.paths.html.empty();
    const std::vector<NamedFile> outputs = namedFiles(options.paths);
    requireDistinctFiles(outputs, {resolveScene(options.measurement.scene.scene).string(), options.baseline});
    ProfileFiles files(options.paths);
    TerminalObserver observer(options.isQuiet);
    const MeasurementSubject subject = prepareMeasurement(request, commandLine, observer);
    const Provenance &origin = subject.profile.origin;
    requireDistinctFiles(outputs, subject.scene.loaded.inputFiles);
    files.requireSizes(origin.width, origin.height);
    if (baseline.figures)
        requireSameJob(*baseline.figures, subject.profile);
    printHead(subject.profile, *subject.device);
    Measurement measurement = measure(subject, request, files.wantsHeatMap(subject.scene), observer);
    if (measurement.fault) {
        printFault(*measurement.fault, *subject.device);
        return ExitCode::AnswerIsNo;
    }
    files.writeImage(measurement);
    printMeasured(measurement.profile);
    const std::optional<BaselineVerdict> verdict = judge(measurement, baseline);
    files.writeFigures(measurement, verdict ? &*verdict : nullptr);
    return baseline.figures ? printVerdict(verdict) : ExitCode::Ok;
}

void addMeasurementOptions(CLI::App &command, MeasurementRequest &request) {
    addSceneOptions(command, request.scene);
    command.add_option("--device", request.device, "the device to measure: as for `hyalite render`")
        ->type_name("DEVICE")
        ->capture_default_str();
    addThreadsOption(command, request.threadCount);
    addDeviceOptions(command, request.deviceOptions);
    addNumber(command, "--warmup", request.warmupCount, warmupCounts,
              "number of renders before the measured ones")
        ->default_str("1");
    addNumber(command, "--repeat", request.repeatCount, repeatCounts, "number of measured renders")
        ->default_str("5");
    addTimeLimit(command, request.timeLimitSeconds,
                 "end all renders after this time and write what was measured and counted until then");
    command.add_flag("--no-verify", request.isUnverified,
                     "skip the comparison with the image of the CPU twin");
}

void addFileOptions(CLI::App &command, ProfilePaths &paths) {
    addOutput(command, "-o,--output", paths.output, "FILE", "write the image, too, and time that");
    addOutput(command, "--report", paths.report, "FILE.json", "write all figures, as --baseline reads them");
    addOutput(command, "--csv", paths.csv, "FILE.csv", "write a line for each dispatch");
    addOutput(command, "--trace", paths.trace, "FILE.json",
              "write a timeline that ui.perfetto.dev and chrome://tracing open");
    addOutput(command, "--heatmap", paths.heatMap, "FILE.png",
              "render once more, and write how many boxes and triangles each pixel tests, in false colours");
    addOutput(command, "--html", paths.html, "FILE.html",
              "render once more, and write a page with the image, the heat map, the figures and where they "
              "come from; with --baseline, both profiles side by side");
}

void addBaselineOptions(CLI::App &command, ProfileOptions &options) {
    addFile(command, "--baseline", options.baseline, "FILE.json",
            "compare with an older --report; a regression is exit code 1");
    command
        .add_option(
            "--max-regression", options.maxRegression,
            "allowed slowdown of a kernel against the baseline, beyond the noise, and allowed growth of "
            "work counts")
        ->type_name("PERCENT%")
        ->default_str("5%");
    addChoice(command, "--gate", options.gate, gateNames,
              "what fails: times and work counts (all, the default), or one of them; counts do not jitter");
}

} // namespace

void addProfileCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command = app.add_subcommand("profile", "measure repeated renders of a scene, stage by stage");
    const auto options = std::make_shared<ProfileOptions>();
    addMeasurementOptions(*command, options->measurement);
    command->add_flag("--quiet", options->isQuiet, "show no progress");
    addFileOptions(*command, options->paths);
    command->add_flag(
        "--counts", options->measurement.isCounting,
        "render again and count nodes, boxes and triangles, of the same rays with a stack and of "
        "the kernel's own traversal, how busy the kernel's lanes are, and which objects and "
        "materials the rays work for");
    addBaselineOptions(*command, *options);
    command->callback([options, &context] { context.exitCode = runProfile(*options, context.commandLine); });
}

} // namespace hyalite::core
