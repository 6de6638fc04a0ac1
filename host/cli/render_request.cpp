#include "host/cli/render_request.h"

#include "host/cli/device_options.h"
#include "host/cli/layers_option.h"
#include "host/cli/options.h"
#include "host/cli/scene_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string_view>

namespace hyalite::core {

namespace {

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

/// "0..239", or "7".
FrameRange readFrames(const std::string &word) {
    const std::size_t dots = word.find("..");
    FrameRange range;
    try {
        range.first = readAs<int>("--frames", std::string_view(word).substr(0, dots), limits::frame);
        range.last = dots == std::string::npos
                         ? range.first
                         : readAs<int>("--frames", std::string_view(word).substr(dots + 2), limits::frame);
    } catch (const Error &) {
        range.last = -1;
    }
    if (range.last < range.first)
        refuseValue("--frames", word,
                    fmt::format("FIRST..LAST, of frames from 0 to {:.0f}; or one frame", limits::frame.high));
    return range;
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

void addRenderOptions(CLI::App &command, RenderRequest &request, bool &isQuiet) {
    addSceneOptions(command, request.scene);
    addOutput(
        command, "-o,--output", request.output, "FILE",
        ".png: 8 bits, tone-mapped by --tone; .exr: linear float, with variance and sample counts; .hdr, "
        ".pfm: linear; of frames also .webp, .apng: a clip; -: a PNG to standard output, exr:- another "
        "format")
        ->required();
    addDevicesOption(
        command, request.devices,
        "auto: a GPU before software; cpu: the reference renderer; an index or part of a name as "
        "`hyalite devices` lists them. May be repeated, for devices that share the picture; all: every "
        "device, and cpu unless a software device computes on it");
    addFileOptions(command, request.file);
    addLayersOption(command, request.scene.views);
    addThreadsOption(command, request.threadCount);
    addDeviceOptions(command, request.deviceOptions);
    addOutput(command, "--report", request.report, "FILE.json",
              "write a report with settings, counts and times");
    command
        .add_option("--part", CLI::callback_t([&request](const CLI::results_t &words) {
                        request.part = readPart(words.front());
                        return true;
                    }),
                    "render only part I of N of the picture into --output, a .part file, from which the same "
                    "command goes on; `hyalite merge` makes the picture of all parts")
        ->type_name("I/N");
    addTimeLimit(command, request.timeLimitSeconds, "stop after this time and write the partial image");
    addDisplayOption(command, request.display);
    addLongRenderOptions(command, request);
    command.add_flag("--quiet", isQuiet, "print errors and warnings only");
}

RenderRequest readRenderRequest(const std::vector<std::string> &words) {
    RenderRequest request;
    bool isQuiet = false;
    CLI::App app;
    addRenderOptions(*app.add_subcommand("render"), request, isQuiet);
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

namespace {

/// "front,top", or "contact:8"; words that commas separate.
void readViews(const std::vector<std::string> &words, std::vector<View> &views) {
    constexpr std::string_view around = "contact:";
    std::vector<std::string_view> allowed;
    std::ranges::transform(viewNames, std::back_inserter(allowed), [](const auto &row) { return row.first; });
    for (const std::string &word : words) {
        if (word.starts_with(around)) {
            const auto count = readAs<int>("--views", word.substr(around.size()), limits::viewCount);
            std::ranges::move(viewsAround(count), std::back_inserter(views));
            continue;
        }
        const auto *const known =
            std::ranges::find(viewNames, word, [](const auto &row) { return row.first; });
        if (known == viewNames.end())
            refuseValue("--views", word,
                        quotedList(allowed) + ", and \"contact:N\", N views around" +
                            suggestion(word, allowed));
        views.push_back({word, known->second});
    }
}

} // namespace

void addViewOptions(CLI::App &command, ViewOptions &options) {
    const char *group = "Views";
    command
        .add_option(
            "--views", CLI::callback_t([&options](const CLI::results_t &words) {
                readViews(words, options.views);
                return true;
            }),
            "pictures from these sides, by cameras that frame the scene: front, back, left, right, top, "
            "bottom, iso, and contact:N, N views around it. Several in a .png are a sheet, with a name "
            "above each; {view} in the name of --output makes a file of each, named so")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("VIEW,...")
        ->group(group);
    addWord(
        command, "--frame", options.object, "a name", "NAME",
        "what the cameras of --views frame: a node or mesh of this name, as `hyalite inspect` lists them, or "
        "a mesh file; all without it")
        ->group(group);
}

void addSequenceOptions(CLI::App &command, SequenceOptions &options) {
    const char *group = "Sequences";
    command
        .add_option(
            "--frames", CLI::callback_t([&options](const CLI::results_t &words) {
                options.frames = readFrames(words.front());
                return true;
            }),
            "render these frames by the scene's moving camera, or its animations, from one loaded "
            "scene; --output has # for their numbers: frame.####.exr; or it is one clip of all, a .webp or "
            ".apng. With --part, every N-th of them; with --resume, those that are missing")
        ->type_name("FIRST..LAST")
        ->group(group);
    addNumber(command, "--turntable", options.turntable, {1, limits::frame.high},
              "frames of a full turn around what the camera looks at, instead of the scene's path")
        ->type_name("COUNT")
        ->group(group);
    addNumber(command, "--fps", options.framesPerSecond, limits::framesPerSecond,
              "frames in a second of glTF animations, and of a clip")
        ->default_str("24")
        ->group(group);
    command
        .add_flag(
            "--motion", options.hasMotion,
            "a layer of each .exr: vector, how far what a pixel shows moves to the frames before and after")
        ->group(group);
}

} // namespace hyalite::core
