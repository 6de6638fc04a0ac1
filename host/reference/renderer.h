// The reference renderer on the CPU: the twin of the kernels, and the same text in double precision as an oracle.
#pragma once

#include "host/film/continuation.h"
#include "host/film/film.h"
#include "host/film/ray_counts.h"
#include "host/film/work_counts.h"
#include "host/packing/packed_scene.h"

#include <functional>

namespace hyalite::reference {

enum class Precision { Float32, Float64 };

struct Options {
    /// Float64 results are rounded to float when they reach the film.
    Precision precision = Precision::Float32;
    int threadCount = 0; ///< chosen by OpenMP
    /// Called occasionally, never by two threads at once, with the finished fraction of the work, in [0, 1].
    std::function<void(double)> onProgress = {};
    bool isCounting = false; ///< count the work of the traversal
    /// Called by each thread after each sample, possibly by several at once. Once it returns true, the film has exactly
    /// the samples finished by then.
    std::function<bool()> shouldStop = {};
};

struct Result {
    Film film;
    RayCounts rays;  ///< of the samples that were added to the film
    WorkCounts work; ///< all 0 unless counting was asked for, or samples show the work
};

/// Renders `crop` of the scene's image. The result does not depend on the number of threads, nor, with Float32, on
/// where `continuation` starts. With Float64 each pixel of a snapshot has either all its samples or only those that it
/// began with.
[[nodiscard]] Result render(const PackedScene &scene, const RenderSettings &settings, const Crop &crop,
                            const Options &options = {}, Continuation continuation = {});

/// Traces one sample of one pixel of the whole image, step by step. `shift` moves the sample by this many pixels.
[[nodiscard]] std::vector<layout::TraceEvent> trace(const PackedScene &scene, const RenderSettings &settings,
                                                    const glm::uvec2 &pixel, std::uint32_t sampleIndex,
                                                    Precision precision,
                                                    const glm::dvec2 &shift = glm::dvec2(0.0));

} // namespace hyalite::reference
