// The renderer on a Vulkan device.
#pragma once

#include "host/base/error.h"
#include "host/film/continuation.h"
#include "host/film/film.h"
#include "host/film/ray_counts.h"
#include "host/film/render_timing.h"
#include "host/film/timeline.h"
#include "host/film/work_counts.h"
#include "host/gpu/memory_plan.h"
#include "host/gpu/render_config.h"
#include "host/packing/packed_scene.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::gpu {

struct Result {
    Film film;
    RayCounts rays; ///< of the samples that were added to the film
    RenderTiming timing;
    WorkCounts work;     ///< all 0 unless the render config asks for counting, or the integrator is the cost
    LaneCounts lanes{};  ///< likewise
    MemoryPlan memory{}; ///< what it takes at most
    std::vector<std::string>
        faults{}; ///< Vulkan calls that failed, each with its object or dispatch, in their order
    std::optional<Error>
        failure{}; ///< why the render ended before all was finished, where the device was at fault
};

/// Renders scenes on one device, opened once, and again where it fails.
class Renderer {
  public:
    /// `preferred` kernels run where `config` names none.
    explicit Renderer(const DeviceInfo &device, const RenderConfig &config = {},
                      const KernelChoices &preferred = {});
    ~Renderer();
    Renderer(Renderer &&) noexcept;
    Renderer &operator=(Renderer &&) noexcept;

    /// Which / and sqrt the kernels run.
    [[nodiscard]] const ArithmeticChoice &arithmetic() const;

    /// The word for the kernel of an integrator, and a hash of its SPIR-V: of the one that dispatches begin with.
    [[nodiscard]] std::string_view kernelName(const PackedScene &scene, Integrator integrator) const;
    [[nodiscard]] std::uint64_t kernelHash(const PackedScene &scene, Integrator integrator) const;

    /// Renders `crop` of the scene's image. `onProgress` gets the finished share of the work, in [0, 1], after each
    /// dispatch, and `timeline`, where there is one, what was done when. `shouldStop` is asked after each dispatch:
    /// where it says so, the film has the samples that are finished by then, tile after tile, and no others. Where
    /// `continuation` goes on changes no bit.
    ///
    /// Where a Vulkan call fails, the device is opened anew and given half as much at a time, up to three times, and the
    /// render goes on from a copy of the film; after the last failure the result has what the copy has. Throws
    /// Error{LimitExceeded} where the scene is too large for the limits of the device, Error{Usage} where the
    /// cost, which is that of a traversal with a stack, is asked of another kernel.
    [[nodiscard]] Result render(const PackedScene &scene, const RenderSettings &settings, const Crop &crop,
                                const std::function<void(double)> &onProgress = {},
                                Timeline *timeline = nullptr, const std::function<bool()> &shouldStop = {},
                                Continuation continuation = {});

    /// What one sample of one pixel of the whole image does, step by step; at most 2^17 steps are kept.
    [[nodiscard]] std::vector<layout::TraceEvent> trace(const PackedScene &scene,
                                                        const RenderSettings &settings,
                                                        const glm::uvec2 &pixel, std::uint32_t sampleIndex);

  private:
    struct State;

    /// One try: adds to the result what is missing, and keeps film and rays in step. `isBegun`: the film may have
    /// samples.
    void renderOnce(const PackedScene &scene, const RenderSettings &settings, bool isBegun,
                    const std::function<void(double)> &onProgress, Timeline *timeline,
                    const std::function<bool()> &shouldStop, SnapshotTaker *snapshots, Result &result);

    std::unique_ptr<State> state_;
};

} // namespace hyalite::gpu
