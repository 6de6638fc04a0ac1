// The reference renderer on the CPU: the twin of the kernels, and the same text in double precision, which measures
// rounding.
#pragma once

#include "host/film/film.h"
#include "host/film/ray_counts.h"
#include "host/film/render_hooks.h"
#include "host/film/work_counts.h"
#include "host/film/work_ledger.h"
#include "host/packing/packed_scene.h"

namespace hyalite::core::reference {

enum class Precision { Float32, Float64 };

struct Options {
    /// Float64 results are rounded to float when they reach the film.
    Precision precision = Precision::Float32;
    int threadCount = 0;     ///< chosen by OpenMP
    bool isCounting = false; ///< count the work of the traversal
    /// Charge each ray; a sample is then its box and triangle tests by PathStage. In single precision, and where
    /// canChargeWork().
    bool isCharging = false;
};

struct Result {
    Film film;
    RayCounts rays;      ///< of the samples that were added to the film
    WorkCounts work;     ///< all 0 unless counting was asked for, or samples show the work
    WorkLedger ledger{}; ///< empty unless charging was asked for
};

/// Whether the integrator says where its rays arrive: those of light do, views do not.
[[nodiscard]] bool canChargeWork(const RenderSettings &settings);

/// Adds the missing samples to `begun`, whose crop is that of the scene's image. The result does not depend on the
/// number of threads, nor, with Float32, on which samples were there. `hooks.shouldStop` is asked after each sample.
/// With Float64 each pixel of a snapshot has either all its samples or only those that it began with. No timeline is
/// recorded.
[[nodiscard]] Result render(const PackedScene &scene, const RenderSettings &settings, Film begun,
                            const Options &options = {}, const RenderHooks &hooks = {});

/// Traces one sample of one pixel of the whole image, step by step. `shift` moves the sample by this many pixels.
[[nodiscard]] std::vector<layout::TraceEvent> trace(const PackedScene &scene, const RenderSettings &settings,
                                                    const glm::uvec2 &pixel, std::uint32_t sampleIndex,
                                                    Precision precision,
                                                    const glm::dvec2 &shift = glm::dvec2(0.0));

} // namespace hyalite::core::reference
