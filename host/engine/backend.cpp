#include "host/engine/backend.h"

#include "host/base/error.h"
#include "host/base/host_memory.h"
#include "host/base/quantities.h"
#include "host/engine/render_stages.h"
#include "host/reference/denoise.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <optional>
#include <utility>

namespace hyalite::core {

namespace {

/// Memory for a film and its image. Tone mapping and packing come later and take less.
std::uint64_t filmBytes(const Crop &crop) {
    return crop.pixelCount() * (sizeof(layout::FilmPixel) + sizeof(glm::vec3));
}

[[noreturn]] void refuseFilm(const Crop &crop, std::uint64_t neededBytes, const std::string &available) {
    throw Error(ErrorKind::LimitExceeded,
                fmt::format("{}x{} pixels take {} of memory, and {}", crop.width(), crop.height(),
                            sizeText(neededBytes), available),
                Remedy::SmallerImage);
}

} // namespace

void Backend::repeat(const PackedScene &scene, const RenderSettings &settings, const Film &expected,
                     const RepeatHooks &hooks) {
    for (bool goesOn = true; goesOn;) {
        Stopwatch watch;
        const BackendResult result =
            unlessFailed(render(scene, settings, Film(expected.crop), {.shouldStop = hooks.shouldStop}));
        const bool isWhole = std::ranges::all_of(result.film.pixels, [&](const layout::FilmPixel &pixel) {
            return pixel.sampleCount >= static_cast<std::uint32_t>(settings.samplesPerPixel);
        });
        if (!isWhole && hooks.shouldStop && hooks.shouldStop())
            return;
        RepeatedPass pass{.rays = result.rays, .renderSeconds = watch.lap().seconds()};
        pass.isEqual = firstDifference(result.film, expected) == expected.pixels.size();
        pass.compareSeconds = watch.lap().seconds();
        pass.film = [&] { return result.film; };
        pass.laneOf = [](const glm::uvec2 &, std::uint32_t) { return std::nullopt; };
        goesOn = hooks.onPass(pass);
    }
}

Image Backend::denoise(const NoisyPicture &picture) { return reference::denoise(picture); }

void requireFilmMemory(const Crop &crop, unsigned filmCount, std::uint32_t lightPlanes,
                       std::uint64_t moreBytes) {
    const std::uint64_t neededBytes =
        filmCount * filmBytes(crop) +
        crop.pixelCount() * lightPlanes * layout::lightWordsPerPlane * sizeof(float) + moreBytes;
    const std::optional<std::uint64_t> available = availableHostBytes();
    if (available && neededBytes > *available)
        refuseFilm(crop, neededBytes, sizeText(*available) + " are available");
}

BackendResult render(Backend &backend, const PackedScene &scene, const RenderSettings &settings, Film begun,
                     Observer &observer, const RenderTask &task) {
    ObservedTask progress(observer, task.name, backend.hasCompiler());
    const Crop crop = begun.crop;
    const double others = task.shareOfOthers;
    RenderHooks hooks;
    hooks.onProgress = [&](double share) { progress.update(std::max(share - others, 0.0) / (1.0 - others)); };
    hooks.shouldStop = [&] { return observer.wantsStop().has_value() || task.limit.isReached(); };
    hooks.onNoise = [&](double highest) { progress.noise(highest, settings.noise); };
    hooks.timeline = task.timeline;
    hooks.snapshots = task.snapshots;
    try {
        const bool hasStages = isAdaptive(settings) || (task.keepsFirst && keepsDenoisingData(settings));
        BackendResult result = hasStages ? renderInStages(backend, scene, settings, std::move(begun), hooks)
                                         : backend.render(scene, settings, std::move(begun), hooks);
        const std::size_t survived = result.faults.size() - (result.failure ? 1 : 0);
        for (std::size_t i = 0; i < survived; ++i)
            observer.note(result.faults[i] + "; reopened the device to do half as much at a time");
        for (const RendererShare &share : result.shares)
            if (!share.failure.empty() && share.seconds > 0.0) // else it was told before
                observer.note(fmt::format("left out {}: {}", share.name, share.failure));
        return result;
    } catch (const std::bad_alloc &) {
        refuseFilm(crop, filmBytes(crop), "this machine cannot allocate that much");
    }
}

BackendResult unlessFailed(BackendResult result) {
    if (result.failure)
        throw Error(*result.failure);
    return result;
}

} // namespace hyalite::core
