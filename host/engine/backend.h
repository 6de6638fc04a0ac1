// Backends: renderers behind one interface.
#pragma once

#include "host/engine/observer.h"
#include "host/engine/prepare.h"
#include "host/engine/time_limit.h"
#include "host/film/continuation.h"
#include "host/film/ray_counts.h"
#include "host/film/render_timing.h"
#include "host/film/timeline.h"
#include "host/film/work_counts.h"
#include "host/gpu/arithmetic.h"
#include "host/gpu/memory_plan.h"
#include "host/report/provenance.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hyalite {

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
    /// Renders the crop of the continuation's film, or else that of the scene. What a backend needs of a scene it may
    /// keep for the next render of the same one.
    ///
    /// `timeline`, if not null, records what happened when. `shouldStop` may be called by several threads at once; if
    /// it returns true, the film has the samples finished so far.
    [[nodiscard]] virtual BackendResult render(const PreparedScene &scene,
                                               const std::function<void(double)> &onProgress,
                                               Timeline *timeline, const std::function<bool()> &shouldStop,
                                               Continuation continuation) = 0;
    /// Traces one sample of one pixel of the whole image.
    [[nodiscard]] virtual std::vector<layout::TraceEvent>
    trace(const PreparedScene &scene, const glm::uvec2 &pixel, std::uint32_t sampleIndex) = 0;
};

/// Renders as the observer's task `task`, until the observer wants it to stop or the limit is reached. Throws
/// Error{LimitExceeded} with the size of the film if memory is too small for it. Device faults are noted.
[[nodiscard]] BackendResult render(Backend &backend, const PreparedScene &scene, const std::string &task,
                                   Observer &observer, const TimeLimit &limit = TimeLimit(),
                                   Timeline *timeline = nullptr, Continuation continuation = {});

/// The result, whose film is of no use in part: throws its failure, if there is one.
[[nodiscard]] BackendResult unlessFailed(BackendResult result);

/// Throws Error{LimitExceeded} if memory cannot hold this number of films of the crop and the images made of them.
void requireFilmMemory(const Crop &crop, unsigned filmCount);

} // namespace hyalite
