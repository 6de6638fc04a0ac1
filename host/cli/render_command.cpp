#include "host/base/message.h"
#include "host/base/quantities.h"
#include "host/cli/commands.h"
#include "host/cli/device_options.h"
#include "host/cli/layers_option.h"
#include "host/cli/options.h"
#include "host/cli/render_request.h"
#include "host/cli/scene_options.h"
#include "host/import/assets.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace hyalite {

namespace {

constexpr Interval anySeconds{0.0, 1e9, false};

/// The finished samples of a render in percent, rounded down: an incomplete render is never at 100 %.
double percentOf(std::uint64_t sampleCount, std::uint64_t pixelCount, const RenderReport &report) {
    const double share = static_cast<double>(sampleCount) / static_cast<double>(pixelCount) /
                         report.origin.settings.samplesPerPixel;
    return std::floor(share * 1000.0) / 10.0;
}

std::vector<NamedFile> outputsOf(const RenderRequest &request) {
    const std::string olderGeneration =
        request.checkpoint.empty() ? "" : olderCheckpoint(request.checkpoint).string();
    const std::string lock = request.checkpoint.empty() ? "" : lockOfCheckpoint(request.checkpoint).string();
    return {{"--output", request.output},
            {"--report", request.report},
            {"--checkpoint", request.checkpoint},
            {"--checkpoint", olderGeneration},
            {"--checkpoint", lock}};
}

/// Throws Error{Usage} for options that a part does without.
void requirePartOptions(const RenderRequest &request) {
    if (std::filesystem::path(request.output).extension() != ".part")
        throw Error(ErrorKind::Usage,
                    fmt::format("--part: --output is {}, and must be a .part file, of which `hyalite merge` "
                                "makes a picture",
                                request.output));
    if (!request.checkpoint.empty() || request.isResuming)
        throw Error(ErrorKind::Usage,
                    "--part: --output is the checkpoint, from which each render of the part "
                    "goes on; leave out --checkpoint and --resume");
    if (request.partialSeconds || request.tone)
        throw Error(ErrorKind::Usage,
                    fmt::format("--part: {} is for pictures", request.tone ? "--tone" : "--partial"));
    if (request.device == "cpu-double")
        throw Error(ErrorKind::Usage,
                    "--part: cpu-double sums in double precision, which a part does not hold; "
                    "use --device cpu or a Vulkan device");
}

/// Throws Error{Usage} for conflicting options.
void requireOptionsThatGoTogether(const RenderRequest &request) {
    requireDistinctFiles(outputsOf(request), {resolveScene(request.scene.scene).string()});
    if (request.part) {
        requirePartOptions(request);
        return;
    }
    const ImageFormat format = imageFormatOf(request.output);
    if (request.checkpoint.empty() && request.isResuming)
        throw Error(ErrorKind::Usage, "--resume needs --checkpoint FILE to resume from");
    if (request.checkpoint.empty() && request.checkpointSeconds)
        throw Error(ErrorKind::Usage, "--checkpoint-interval needs --checkpoint FILE to write to");
    if (!request.checkpoint.empty() && request.device == "cpu-double")
        throw Error(ErrorKind::Usage,
                    "--checkpoint: cpu-double sums in double precision, which a checkpoint does "
                    "not hold; use --device cpu or a Vulkan device");
    if (request.tone && format != ImageFormat::Png)
        throw Error(ErrorKind::Usage,
                    fmt::format("--tone is for .png files: --output is {}, which holds radiance as it is; "
                                "`hyalite tonemap` makes a PNG of it",
                                request.output));
    if (!request.layers.empty() && format != ImageFormat::Exr)
        throw Error(ErrorKind::Usage,
                    fmt::format("--layers are for .exr files: --output is {}", request.output));
}

void tellDevice(const Backend &device) {
    printMessage("device: {}\n", device.description());
    if (const gpu::BitGuarantee bits = device.bits(); bits.degree == gpu::BitDegree::None)
        printMessage("note: bits may differ from the CPU twin's: {}\n", bits.reason);
}

/// The checkpoint that the render resumes from.
void tellWhatIsResumed(const RenderJob &job, const RenderRequest &request) {
    const RenderReport &report = job.report();
    if (!job.checkpointDamage().empty() && report.resumed)
        printMessage("note: {}; resuming from the older {}\n", job.checkpointDamage(),
                     report.resumed->checkpoint);
    else if (!job.checkpointDamage().empty())
        printMessage("note: {}; starting from the beginning\n", job.checkpointDamage());
    if (request.isQuiet || !(request.isResuming || (request.part && report.resumed)))
        return;
    if (report.resumed)
        printMessage("resuming from {}: {:.1f} % of the samples are finished\n", report.resumed->checkpoint,
                     percentOf(report.resumed->sampleCount, job.pixelCount(), report));
    else
        printMessage("no checkpoint {} yet: starting from the beginning\n", request.checkpoint);
}

/// The finished part of an incomplete image, and its file.
void tellWhatIsFinished(const RenderReport &report) {
    const FinishedWork &finished = report.finished;
    printMessage("stopped by {}: {} of {} pixels are finished, {:.1f} % of the samples; {} has them\n",
                 report.stoppedBy, finished.pixelCount, finished.wantedPixelCount,
                 percentOf(finished.sampleCount, finished.wantedPixelCount, report), report.output);
}

/// The last line: the speed of this run.
void tellSpeed(const RenderReport &report, const std::optional<Part> &part) {
    const std::uint64_t rayCount = report.rays.total() - (report.resumed ? report.resumed->rays.total() : 0);
    const double megaraysPerSecond =
        rayCount > 0 ? static_cast<double>(rayCount) / 1e6 / report.timing.renderSeconds : 0.0;
    fmt::print("{}: {}{}x{}, {}{} spp, {}{} in {:.3f} s: {:.{}f} Mray/s ({:.3f} s in all)\n", report.output,
               part ? fmt::format("part {} of {} of ", part->index, part->count) : "", report.origin.width,
               report.origin.height, report.finished.isComplete ? "" : "up to ",
               report.origin.settings.samplesPerPixel, report.resumed ? "resumed, " : "",
               roundedText(rayCount, "rays"), report.timing.renderSeconds, megaraysPerSecond,
               megaraysPerSecond < 1.0 ? 3 : 1, report.totalSeconds);
}

void tellOutcome(const RenderJob &job, const RenderRequest &request) {
    const bool isQuiet = request.isQuiet;
    const RenderReport &report = job.report();
    if (!report.finished.isComplete && !(isQuiet && job.isCutByTime()))
        tellWhatIsFinished(report);
    if (isQuiet)
        return;
    tellSpeed(report, request.part);
    if (const std::optional<std::string> fault = job.diagnosis())
        printWarning("{}", *fault);
}

ExitCode runRender(const RenderRequest &request, const std::string &commandLine) {
    requireOptionsThatGoTogether(request);
    RenderJob job(request, commandLine);
    job.prepare();
    requireDistinctFiles(outputsOf(request), job.scene().loaded.inputFiles);
    job.openDevice();
    if (!request.isQuiet)
        tellDevice(job.device());
    job.resume();
    if (job.isFinishedBefore()) {
        if (!request.isQuiet)
            fmt::print("{}: part {} of {} is finished\n", request.output, request.part->index,
                       request.part->count);
        return ExitCode::Ok;
    }
    tellWhatIsResumed(job, request);
    job.renderLayers();
    job.render();
    job.writeImage();
    job.writeReport();
    tellOutcome(job, request);
    job.throwFailure();
    const int signal = job.stoppingSignal();
    return signal != 0 ? exitCodeOf(errorKindOf(signal)) : ExitCode::Ok;
}

/// "3/16".
Part readPart(const std::string &word) {
    const std::size_t slash = word.find('/');
    const auto refuse = [&] {
        refuseValue(
            "--part", word,
            fmt::format("I/N: part I, from 1, of N, which are at most {:.0f}", limits::partCount.high));
    };
    if (slash == std::string::npos)
        refuse();
    const std::string_view text = word;
    Part part;
    try {
        part.count = readAs<std::uint32_t>("--part", text.substr(slash + 1), limits::partCount);
        part.index = readAs<std::uint32_t>("--part", text.substr(0, slash), limits::partCount);
    } catch (const Error &) {
        refuse();
    }
    if (part.index > part.count)
        refuse();
    return part;
}

/// Options for long renders.
void addLongRenderOptions(CLI::App &command, RenderRequest &request) {
    const char *group = "Long renders";
    addFile(command, "--checkpoint", request.checkpoint, "FILE",
            "write the finished samples to FILE at intervals, and at the end; FILE.1 is the previous "
            "checkpoint")
        ->group(group);
    addNumber(command, "--checkpoint-interval", request.checkpointSeconds, anySeconds,
              "time between two checkpoints")
        ->type_name("SECONDS")
        ->default_str("10")
        ->group(group);
    command
        .add_flag("--resume", request.isResuming,
                  "continue from the checkpoint, if there is one, to the same image; --device, --threads, "
                  "--kernel and --bvh may differ, and --spp may be larger")
        ->group(group);
    addNumber(command, "--partial", request.partialSeconds, anySeconds,
              "replace the output by a partial image at this interval")
        ->type_name("SECONDS")
        ->group(group);
}

} // namespace

void addRenderOptions(CLI::App &command, RenderRequest &request) {
    addSceneOptions(command, request.scene);
    command
        .add_option("-o,--output", request.output,
                    ".png: 8 bits, tone-mapped by --tone; .exr: linear float, with variance and "
                    "sample counts; .hdr, .pfm: linear")
        ->required()
        ->type_name("FILE");
    command
        .add_option("--device", request.device,
                    "auto: a GPU before software; cpu: the reference renderer; an index or part of a name as "
                    "`hyalite devices` lists them")
        ->type_name("DEVICE")
        ->capture_default_str();
    addToneOption(command, request.tone);
    addLayersOption(command, request.layers);
    addThreadsOption(command, request.threadCount);
    addDeviceOptions(command, request.deviceOptions);
    addFile(command, "--report", request.report, "FILE.json",
            "write a report with settings, counts and times");
    command
        .add_option("--part", CLI::callback_t([&request](const CLI::results_t &words) {
                        request.part = readPart(words.front());
                        return true;
                    }),
                    "render only part I of N of the picture into --output, a .part file, from which the same "
                    "command goes on; `hyalite merge` makes the picture of all parts")
        ->type_name("I/N");
    addNumber(command, "--time-limit", request.timeLimitSeconds, anySeconds,
              "stop after this time and write the partial image; loading and building do not count")
        ->type_name("SECONDS");
    addLongRenderOptions(command, request);
    command.add_flag("--quiet", request.isQuiet, "print errors only");
}

RenderRequest readRenderRequest(const std::vector<std::string> &words) {
    RenderRequest request;
    CLI::App app;
    addRenderOptions(*app.add_subcommand("render"), request);
    std::vector<std::string> arguments; // the last first, as CLI11 wants them
    for (std::size_t i = words.size(); i-- > 1;)
        arguments.push_back(words[i]);
    try {
        app.parse(arguments);
    } catch (const std::runtime_error &error) { // CLI::Error, or Error for a value
        throw Error(ErrorKind::BadInput, fmt::format("cannot read a part's command line: {}", error.what()));
    }
    request.words = words;
    return request;
}

void addRenderCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command = app.add_subcommand("render", "render a scene to an image file");
    const auto request = std::make_shared<RenderRequest>();
    addRenderOptions(*command, *request);
    command->callback([request, &context] {
        request->words = context.words;
        context.exitCode = runRender(*request, context.commandLine);
    });
}

} // namespace hyalite
