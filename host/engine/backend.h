// Backends: renderers behind one interface.
#pragma once

#include "host/engine/observer.h"
#include "host/engine/prepare.h"
#include "host/engine/time_limit.h"
#include "host/film/noisy_picture.h"
#include "host/film/ray_counts.h"
#include "host/film/render_hooks.h"
#include "host/film/render_timing.h"
#include "host/film/repeated_pass.h"
#include "host/film/work_counts.h"
#include "host/gpu/arithmetic.h"
#include "host/gpu/memory_plan.h"
#include "host/report/provenance.h"

#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

struct BackendResult {
    Film film;
    RayCounts rays;           ///< traced by this call
    RenderTiming timing;      ///< only renderSeconds on the CPU
    WorkCounts work;          ///< all 0 without counting, unless samples show the work
    LaneCounts lanes{};       ///< of a device, likewise
    gpu::MemoryPlan memory{}; ///< peak memory of a device, and of the host for it
    std::vector<std::string>
        faults{}; ///< failed Vulkan calls; the render continued after each, except perhaps the last
    std::optional<Error> failure{};      ///< why the device ended the render early, or empty
    std::vector<RendererShare> shares{}; ///< of several renderers, if there are several
};

class Backend {
  public:
    virtual ~Backend() = default;

    [[nodiscard]] virtual std::string name() const = 0;        ///< "cpu", or the name of the device
    [[nodiscard]] virtual std::string description() const = 0; ///< for people
    [[nodiscard]] virtual RendererIdentity
    identity(const PackedScene &scene,
             Integrator integrator) const = 0; ///< kernel and the like, for reports
    /// How sure it is that images have the bits of the CPU twin's.
    [[nodiscard]] virtual gpu::BitGuarantee bits() const { return {}; }
    /// Backends with the same text add samples with the same bits to a film, and can continue one another's films;
    /// empty: this one cannot.
    [[nodiscard]] virtual std::string precision() const { return "float32"; }
    /// Whether a driver may compile for long before the first ray.
    [[nodiscard]] virtual bool hasCompiler() const { return true; }
    /// Adds the missing samples to `begun`, whose crop is that of the scene's image. A backend may keep its copy of a
    /// scene for the next render of the same one; it does not refer to `scene` after it returns. One thread renders at
    /// a time. Throws Error{LimitExceeded} if the scene or its films are too large, and Error{Usage} for a setting that
    /// it cannot render.
    [[nodiscard]] virtual BackendResult render(const PackedScene &scene, const RenderSettings &settings,
                                               Film begun, const RenderHooks &hooks = {}) = 0;
    /// Renders again and again from no samples, and compares each film with `expected`, which has all of them and no
    /// layers of light. Throws as render() does, and at the first failure of a device.
    virtual void repeat(const PackedScene &scene, const RenderSettings &settings, const Film &expected,
                        const RepeatHooks &hooks);
    /// Traces one sample of one pixel of the whole image.
    [[nodiscard]] virtual std::vector<layout::TraceEvent> trace(const PackedScene &scene,
                                                                const RenderSettings &settings,
                                                                const glm::uvec2 &pixel,
                                                                std::uint32_t sampleIndex) = 0;
    /// The picture without most of its noise; the bits are those of the CPU twin's. By default, the twin does it. Throws
    /// Error{LimitExceeded} and Error{DeviceLost}.
    [[nodiscard]] virtual Image denoise(const NoisyPicture &picture);
};

/// How an observer sees a render, and what it may take.
struct RenderTask {
    std::string name; ///< of the observer's task
    TimeLimit limit{};
    Timeline *timeline = nullptr;       ///< records what happened when
    SnapshotTaker *snapshots = nullptr; ///< takes copies of the film
    /// Of the film's pixels, in [0, 1): they have all samples already, as others render them.
    double shareOfOthers = 0.0;
    /// Of the settings that keep data for the denoiser: whether the film gets first samples (first_samples.h). That of an
    /// adaptive render has them in any case.
    bool keepsFirst = false;
};

/// Adds the missing samples to `begun`, until the observer wants a stop or the limit is reached. `begun` is of a crop
/// of the scene's image; without samples, it is rendered from the beginning. Throws Error{LimitExceeded} with the size
/// of the film if memory is too small for it. Device faults are noted.
[[nodiscard]] BackendResult render(Backend &backend, const PackedScene &scene, const RenderSettings &settings,
                                   Film begun, Observer &observer, const RenderTask &task);

/// The result, whose film is of no use in part: throws its failure, if there is one.
[[nodiscard]] BackendResult unlessFailed(BackendResult result);

/// Throws Error{LimitExceeded} if memory cannot hold this number of films of the crop and the images made of them, with
/// this number of layers of light in all, and `moreBytes` beside them.
void requireFilmMemory(const Crop &crop, unsigned filmCount, std::uint32_t lightPlanes = 0,
                       std::uint64_t moreBytes = 0);

} // namespace hyalite::core
