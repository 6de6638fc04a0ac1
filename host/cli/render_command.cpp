#include "host/base/message.h"
#include "host/base/quantities.h"
#include "host/base/standard_stream.h"
#include "host/cli/commands.h"
#include "host/cli/options.h"
#include "host/cli/render_request.h"
#include "host/cli/terminal_observer.h"
#include "host/engine/time_limit.h"
#include "host/farm/rank_backend.h"
#include "host/image/image_file.h"
#include "host/import/assets.h"
#include "host/jobs/picture_render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace hyalite::core {

namespace {

/// The finished samples of a render in percent, rounded down: an incomplete render is never at 100 %.
double percentOf(std::uint64_t sampleCount, std::uint64_t pixelCount, const RenderReport &report) {
    const double share = static_cast<double>(sampleCount) / static_cast<double>(pixelCount) /
                         report.origin.settings.samplesPerPixel;
    return std::floor(share * 1000.0) / 10.0;
}

std::vector<NamedFile> outputsOf(const RenderRequest &request) {
    std::vector<NamedFile> outputs = {
        {"--output", request.output}, {"--report", request.report}, {"--checkpoint", request.checkpoint}};
    const std::string option = request.part ? "--output" : "--checkpoint"; // a part is a checkpoint
    if (const std::string checkpoint = request.part ? request.output : request.checkpoint;
        !checkpoint.empty())
        outputs.insert(outputs.end(), {{option, olderCheckpoint(checkpoint).string()},
                                       {option, lockOfCheckpoint(checkpoint).string()}});
    return outputs;
}

bool isInDouble(const RenderRequest &request) {
    return std::ranges::find(request.devices, "cpu-double") != request.devices.end();
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
    const std::string_view ofFile = givenOption(request.file);
    if (request.partialSeconds || !ofFile.empty())
        throw Error(ErrorKind::Usage,
                    fmt::format("--part: {} is for pictures", ofFile.empty() ? "--partial" : ofFile));
    if (isInDouble(request))
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
    const ImageFormat format = formatOf(request);
    if (isStandardStream(request.output) && request.partialSeconds)
        throw Error(ErrorKind::Usage,
                    "--partial: a partial image is replaced, which standard output does not do; "
                    "name a file as --output");
    if (isStandardStream(request.checkpoint))
        throw Error(ErrorKind::Usage,
                    "--checkpoint: it is written again and again, and read to resume; name a file");
    if (request.checkpoint.empty() && request.isResuming && !request.frame)
        throw Error(ErrorKind::Usage, "--resume needs --checkpoint FILE to resume from");
    if (request.checkpoint.empty() && request.checkpointSeconds)
        throw Error(ErrorKind::Usage, "--checkpoint-interval needs --checkpoint FILE to write to");
    if (!request.checkpoint.empty() && isInDouble(request))
        throw Error(ErrorKind::Usage,
                    "--checkpoint: cpu-double sums in double precision, which a checkpoint does "
                    "not hold; use --device cpu or a Vulkan device");
    requireFileOptions(request.file, format, request.output);
    if (!request.scene.views.empty() && format != ImageFormat::Exr)
        throw Error(ErrorKind::Usage,
                    fmt::format("--layers are for .exr files: --output is {}", request.output));
}

void printDevice(const RenderSession &session) {
    const Backend &device = session.backend();
    printMessage("device: {}\n", device.description());
    for (const std::string &note : session.notes())
        printMessage("note: {}\n", note);
    if (const gpu::BitGuarantee bits = device.bits(); bits.degree == gpu::BitDegree::None)
        printMessage("note: bits may differ from the CPU twin's: {}\n", bits.reason);
}

/// The checkpoint that the render resumes from.
void printResumed(const PictureBeginning &begun, const RenderRequest &request, bool isQuiet) {
    const RenderReport &report = begun.report;
    if (!begun.checkpointDamage.empty() && report.resumed)
        printMessage("note: {}; resuming from the older {}\n", begun.checkpointDamage,
                     report.resumed->checkpoint);
    else if (!begun.checkpointDamage.empty())
        printMessage("note: {}; starting from the beginning\n", begun.checkpointDamage);
    if (isQuiet || !(request.isResuming || (request.part && report.resumed)))
        return;
    if (report.resumed && isAdaptive(report.origin.settings))
        printMessage("resuming from {}: pixels have {:.1f} samples in the mean\n", report.resumed->checkpoint,
                     static_cast<double>(report.resumed->sampleCount) /
                         static_cast<double>(begun.pixelCount));
    else if (report.resumed)
        printMessage("resuming from {}: {:.1f} % of the samples are finished\n", report.resumed->checkpoint,
                     percentOf(report.resumed->sampleCount, begun.pixelCount, report));
    else if (!request.checkpoint.empty())
        printMessage("no checkpoint {} yet: starting from the beginning\n", request.checkpoint);
}

/// The highest noise of a block, and what it is to be.
std::string noiseText(const RenderReport &report) {
    const double highest = report.finished.noise->highest;
    return fmt::format("{} of {}", std::isfinite(highest) ? percentText(highest) : "?",
                       percentText(report.origin.settings.noise));
}

/// The finished part of an incomplete image, and its file.
void printFinished(const RenderReport &report, const RenderRequest &request) {
    const FinishedWork &finished = report.finished;
    std::string where = report.output + " has them";
    if (request.frame)
        where = !request.checkpoint.empty() ? request.checkpoint + " has them"
                : request.isInClip          ? fmt::format("frame {} is left out", *request.frame)
                                            : "nothing is written";
    const std::string done =
        finished.noise ? fmt::format("with {:.1f} samples in the mean, and noise {}", finished.meanSamples(),
                                     noiseText(report))
                       : fmt::format("{:.1f} % of the samples",
                                     percentOf(finished.sampleCount, finished.wantedPixelCount, report));
    printMessage("stopped by {}: {} of {} pixels are finished, {}; {}\n", report.stoppedBy,
                 finished.pixelCount, finished.wantedPixelCount, done, where);
}

/// The samples of the pixels.
std::string samplesText(const RenderReport &report) {
    const FinishedWork &finished = report.finished;
    if (!finished.noise)
        return fmt::format("{}{} spp", finished.isComplete ? "" : "up to ",
                           report.origin.settings.samplesPerPixel);
    return fmt::format("{} to {} spp, {:.1f} in the mean, noise {}", finished.fewestSamples,
                       finished.mostSamples, finished.meanSamples(), noiseText(report));
}

/// The last line: the speed of this run.
void printSpeed(const RenderReport &report, const RenderRequest &request) {
    const std::optional<Part> &part = request.part;
    const std::uint64_t rayCount = report.rays.total() - (report.resumed ? report.resumed->rays.total() : 0);
    const double megaraysPerSecond =
        rayCount > 0 ? static_cast<double>(rayCount) / 1e6 / report.timing.renderSeconds : 0.0;
    printResult("{}: {}{}x{}, {}, {}{} in {:.3f} s: {:.{}f} Mray/s ({:.3f} s in all)\n",
                request.isInClip ? fmt::format("{}, frame {}", report.output, *request.frame) : report.output,
                part ? fmt::format("part {} of {} of ", part->index, part->count) : "", report.origin.width,
                report.origin.height, samplesText(report), report.resumed ? "resumed, " : "",
                roundedText(rayCount, "rays"), report.timing.renderSeconds, megaraysPerSecond,
                megaraysPerSecond < 1.0 ? 3 : 1, report.totalSeconds);
}

/// The shares of several renderers in the picture.
void printShares(const RenderReport &report) {
    std::uint64_t all = 0;
    for (const RendererShare &share : report.shares)
        all += share.sampleCount;
    for (const RendererShare &share : report.shares)
        printMessage("  {:.1f} % by {}, in {} tiles\n",
                     all > 0 ? 100.0 * static_cast<double>(share.sampleCount) / static_cast<double>(all)
                             : 0.0,
                     share.name, share.tileCount);
}

void printOutcome(const FinishedPicture &picture, const RenderRequest &request, bool isQuiet) {
    const RenderReport &report = picture.report;
    if (!report.finished.isComplete && !(isQuiet && picture.isCutByTime))
        printFinished(report, request);
    if (isQuiet || (request.frame && !report.finished.isComplete))
        return;
    printSpeed(report, request);
    printShares(report);
    if (report.finished.noise && report.finished.noise->atLimit > 0)
        printMessage("note: {} of {} blocks have more noise than {} with --spp {}, which is the most for a "
                     "pixel\n",
                     report.finished.noise->atLimit, report.finished.noise->blockCount,
                     percentText(report.origin.settings.noise), report.origin.settings.samplesPerPixel);
    if (picture.diagnosis)
        printWarning("{}", *picture.diagnosis);
}

/// Throws Error{Usage} for options that frames of a clip do without.
void requireClipOptions(const RenderRequest &request) {
    const auto refuse = [&](std::string_view option, std::string_view reason) {
        throw Error(ErrorKind::Usage,
                    fmt::format("{}: {}, {}; allowed: for frames in files of their own, frame.####.png",
                                option, request.output, reason));
    };
    if (request.part)
        refuse("--part", "the clip, has all frames");
    if (!request.checkpoint.empty())
        refuse("--checkpoint", "the clip, begins anew each time");
    if (request.isResuming)
        refuse("--resume", "the clip, begins anew each time");
}

/// Throws Error{Usage} for options that frames do without.
void requireSequenceOptions(const RenderRequest &request, const SequenceOptions &options) {
    if (request.partialSeconds)
        throw Error(ErrorKind::Usage,
                    "--partial: found frames, whose pictures are written when they are finished");
    if (request.scene.load.timeSeconds)
        throw Error(ErrorKind::Usage, "--time: found frames, which have a time each; allowed: --fps");
    if (options.framesPerSecond && options.turntable && !request.isInClip)
        throw Error(ErrorKind::Usage,
                    "--fps: found --turntable, whose frames have no time; allowed: for a clip");
    const ImageFormat format = formatOf(request);
    if (options.hasMotion && format != ImageFormat::Exr)
        throw Error(ErrorKind::Usage,
                    fmt::format("--motion is for .exr files: --output is {}", request.output));
    if (request.isInClip)
        requireClipOptions(request);
    if (request.isResuming && format != ImageFormat::Exr && format != ImageFormat::Png)
        throw Error(
            ErrorKind::Usage,
            fmt::format("--resume: .exr and .png say which frame they are; --output is {}", request.output));
}

/// One picture, or one frame of a sequence, from a session that may be prepared already. `clip` gets the frame, or is
/// null.
ExitCode renderOne(const RenderRequest &request, const std::string &commandLine, RenderSession &session,
                   TerminalObserver &observer, SequenceClip *clip = nullptr) {
    PictureFiles files = openFiles(request);
    files.clip = clip;
    if (!session.isPrepared())
        session.prepare(request);
    requireDistinctFiles(outputsOf(request), session.scene().loaded.inputFiles);
    requireRoom(files, session.scene());
    session.open();
    observer.catchSignals();
    if (session.isFirstPicture() && !observer.isQuiet())
        printDevice(session);
    PictureBeginning begun = beginPicture(files, commandLine, session);
    if (begun.isFinished) {
        if (!observer.isQuiet())
            printResult("{}: {} is finished\n", request.output,
                        request.part ? fmt::format("part {} of {}", request.part->index, request.part->count)
                                     : fmt::format("frame {}", *request.frame));
        return ExitCode::Ok;
    }
    printResumed(begun, request, observer.isQuiet());
    const FinishedPicture picture = finishPicture(files, std::move(begun), session);
    printOutcome(picture, request, observer.isQuiet());
    if (picture.failure)
        throw Error(*picture.failure);
    const std::optional<Stop> stop = observer.wantsStop();
    if (!request.isInClip) // else they count until the clip is written
        observer.releaseSignals();
    return stop ? exitCodeOf(stop->kind) : ExitCode::Ok;
}

/// A rank but the first: renders tiles, and writes nothing.
ExitCode serve(const RenderRequest &request, Ranks &ranks) {
    TerminalObserver observer(true);
    RenderSession session(observer);
    try {
        session.prepare(request);
        session.open();
    } catch (const Error &error) {
        reportFailure(ranks, error.what());
        return ExitCode::Ok; // rank 0 says so
    }
    serveTiles(ranks, session.scene(), session.backend());
    return ExitCode::Ok;
}

ExitCode runRender(const RenderRequest &request, const std::string &commandLine, TerminalObserver &observer) {
    requireOptionsThatGoTogether(request);
    const std::unique_ptr<Ranks> ranks = joinRanks();
    if (ranks != nullptr && ranks->rank() > 0)
        return serve(request, *ranks);
    std::optional<RankPool> pool;
    if (ranks != nullptr)
        pool.emplace(*ranks);
    RenderSession session(observer, pool ? &*pool : nullptr);
    return renderOne(request, commandLine, session, observer);
}

/// All that the time allows, in turn.
ExitCode renderFrames(Sequence &sequence, const RenderRequest &request, const std::string &commandLine,
                      RenderSession &session, TerminalObserver &observer, SequenceClip *clip) {
    const TimeLimit limit(request.timeLimitSeconds);
    for (const int frame : sequence.frames()) {
        RenderRequest ofFrame = sequence.requestOf(frame);
        if (limit.isReached()) {
            printMessage("stopped by the time limit before frame {}\n", frame);
            break;
        }
        ofFrame.timeLimitSeconds = limit.secondsLeft();
        sequence.moveTo(frame, session);
        if (const ExitCode code = renderOne(ofFrame, commandLine, session, observer, clip);
            code != ExitCode::Ok)
            return code;
    }
    return ExitCode::Ok;
}

void writeClip(SequenceClip &clip, const Sequence &sequence, const RenderRequest &request,
               const std::string &commandLine, const RenderSession &session,
               const TerminalObserver &observer) {
    const std::size_t wanted = sequence.frames().size();
    if (!clip.isWhole()) {
        printMessage("{}: none of {} is finished, and nothing is written\n", request.output,
                     countText(wanted, "frame"));
        return;
    }
    clip.write(sequence.frames(), session, commandLine);
    if (const std::size_t finished = clip.frames().size(); finished < wanted)
        printMessage("{}: the clip has {} of {} frames\n", request.output, finished, wanted);
    else if (!observer.isQuiet())
        printResult("{}: {}, {} a second\n", request.output, countText(wanted, "frame"),
                    clip.framesPerSecond());
}

/// All frames in one file. If a frame fails, the file has those before it.
ExitCode renderClip(Sequence &sequence, const SequenceOptions &options, const RenderRequest &request,
                    const std::string &commandLine, RenderSession &session, TerminalObserver &observer) {
    SequenceClip clip(request.output, options.framesPerSecond.value_or(defaultFramesPerSecond));
    sequence.prepare(session);
    const Crop &crop = session.scene().crop;
    requireClipSize(request.output, clipFormatOf(request.output).value(), crop.width(), crop.height());
    ExitCode code = ExitCode::Ok;
    try {
        code = renderFrames(sequence, request, commandLine, session, observer, &clip);
    } catch (const Error &) {
        if (clip.isWhole())
            writeClip(clip, sequence, request, commandLine, session, observer);
        throw;
    }
    writeClip(clip, sequence, request, commandLine, session, observer);
    observer.releaseSignals();
    return code;
}

ExitCode runSequence(RenderRequest request, const SequenceOptions &options, const std::string &commandLine,
                     TerminalObserver &observer) {
    request.isInClip = isNameOfClip(request.output);
    requireSequenceOptions(request, options);
    const std::unique_ptr<Ranks> ranks = joinRanks();
    if (ranks != nullptr && request.isInClip)
        throw Error(ErrorKind::Usage,
                    fmt::format("--output: found {} and several ranks; allowed: frames in files of "
                                "their own, frame.####.png",
                                request.output));
    if (ranks != nullptr && request.part)
        throw Error(ErrorKind::Usage, "--part: found several ranks, which are the parts of a sequence");
    if (ranks != nullptr)
        request.part =
            Part{static_cast<std::uint32_t>(ranks->rank()) + 1, static_cast<std::uint32_t>(ranks->count())};
    Sequence sequence(request, options);
    if (sequence.frames().empty()) {
        if (!observer.isQuiet())
            printResult("part {} of {} has no frame\n", request.part->index, request.part->count);
        return ExitCode::Ok;
    }
    requireOptionsThatGoTogether(sequence.requestOf(sequence.frames().front()));
    RenderSession session(observer);
    if (request.isInClip)
        return renderClip(sequence, options, request, commandLine, session, observer);
    sequence.prepare(session);
    return renderFrames(sequence, request, commandLine, session, observer, nullptr);
}

/// Throws Error{Usage} for options that views do without.
void requireViewOptions(const RenderRequest &request, const SequenceOptions &sequence) {
    const auto refuse = [](std::string_view option) {
        throw Error(ErrorKind::Usage, fmt::format("{}: found --views; allowed: for one picture", option));
    };
    if (sequence.areGiven())
        refuse(sequence.turntable ? "--turntable" : "--frames");
    if (request.part)
        refuse("--part");
    if (!request.checkpoint.empty() || request.isResuming)
        refuse(request.isResuming ? "--resume" : "--checkpoint");
    if (request.partialSeconds)
        refuse("--partial");
    const std::unique_ptr<Ranks> ranks = joinRanks();
    if (ranks != nullptr)
        throw Error(ErrorKind::Usage, "--views: found several ranks; allowed: one");
}

/// All views in one file.
ExitCode renderViewSheet(const ViewSeries &series, const RenderRequest &request,
                         const std::string &commandLine, RenderSession &session, TerminalObserver &observer) {
    if (!request.display.empty())
        throw Error(ErrorKind::Usage,
                    "--display: found a sheet of views; allowed: views with a picture each");
    AtomicFile file(request.output);
    requireDistinctFiles(outputsOf(request), session.scene().loaded.inputFiles);
    session.open();
    observer.catchSignals();
    if (!observer.isQuiet())
        printDevice(session);
    const FinishedSheet sheet = renderSheet(series, request, file, commandLine, session);
    if (sheet.viewCount < series.views().size())
        printMessage("stopped by the time limit: {} of {} views are finished\n", sheet.viewCount,
                     series.views().size());
    if (!observer.isQuiet())
        printResult("{}: {}, {}x{} each, {}x{} in all, {}{} spp, {} in {:.3f} s\n", request.output,
                    countText(series.views().size(), "view"), session.scene().crop.width(),
                    session.scene().crop.height(), sheet.width, sheet.height,
                    isAdaptive(session.scene().loaded.settings) ? "up to " : "",
                    session.scene().loaded.settings.samplesPerPixel, roundedText(sheet.rayCount, "rays"),
                    sheet.renderSeconds);
    observer.releaseSignals();
    return ExitCode::Ok;
}

ExitCode runViews(const RenderRequest &request, const ViewOptions &options, const std::string &commandLine,
                  TerminalObserver &observer) {
    ViewSeries series(request, options);
    requireOptionsThatGoTogether(series.requestOf(series.views().front()));
    RenderSession session(observer);
    series.prepare(session);
    if (series.isSheet())
        return renderViewSheet(series, request, commandLine, session, observer);
    const TimeLimit limit(request.timeLimitSeconds);
    for (const View &view : series.views()) {
        RenderRequest ofView = series.requestOf(view);
        if (limit.isReached()) {
            printMessage("stopped by the time limit before view {}\n", view.name);
            break;
        }
        ofView.timeLimitSeconds = limit.secondsLeft();
        series.moveTo(view, session);
        if (const ExitCode code = renderOne(ofView, commandLine, session, observer); code != ExitCode::Ok)
            return code;
    }
    return ExitCode::Ok;
}

ExitCode runAny(const RenderRequest &request, const SequenceOptions &sequence, const ViewOptions &views,
                const std::string &commandLine, TerminalObserver &observer) {
    if (views.areGiven()) {
        requireViewOptions(request, sequence);
        return runViews(request, views, commandLine, observer);
    }
    if (!views.object.empty())
        throw Error(ErrorKind::Usage, "--frame needs --views; for a frame of a sequence, use --frames");
    return sequence.areGiven() ? runSequence(request, sequence, commandLine, observer)
                               : runRender(request, commandLine, observer);
}

} // namespace

void addRenderCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command = app.add_subcommand("render", "render a scene to an image file");
    const auto request = std::make_shared<RenderRequest>();
    const auto sequence = std::make_shared<SequenceOptions>();
    const auto isQuiet = std::make_shared<bool>(false);
    addRenderOptions(*command, *request, *isQuiet);
    addSequenceOptions(*command, *sequence);
    const auto views = std::make_shared<ViewOptions>();
    addViewOptions(*command, *views);
    command->callback([request, sequence, views, isQuiet, &context] {
        request->words = context.words;
        if (sequence->framesPerSecond && !sequence->areGiven())
            throw Error(ErrorKind::Usage, "--fps needs --frames FIRST..LAST, or --turntable and a clip");
        if (sequence->hasMotion && !sequence->areGiven())
            throw Error(ErrorKind::Usage,
                        "--motion: found one picture, which has no frame before it or after; "
                        "allowed: with --frames or --turntable");
        TerminalObserver observer(*isQuiet);
        context.exitCode = runAny(*request, *sequence, *views, context.commandLine, observer);
    });
}

} // namespace hyalite::core
