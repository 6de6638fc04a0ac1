// The renderer on a Vulkan device.
#pragma once

#include "host/bvh/packed_scene.h"
#include "host/gpu/batching.h"
#include "host/image/film.h"
#include "host/image/snapshots.h"
#include "host/report/ray_counts.h"
#include "host/report/render_timing.h"
#include "host/report/timeline.h"
#include "host/report/work_counts.h"

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

namespace hyalite::gpu {

struct Result {
    Film film;
    RayCounts rays; ///< traced by this call; where it was stopped, also of samples that are not in the film
    RenderTiming timing;
    WorkCounts work; ///< all 0 unless the batching asks for counting
};

/// Renders scenes on one device, opened once.
class Renderer {
  public:
    explicit Renderer(const DeviceInfo &device, const Batching &batching = {});
    ~Renderer();
    Renderer(Renderer &&) noexcept;
    Renderer &operator=(Renderer &&) noexcept;

    /// Which / and sqrt the kernels run.
    [[nodiscard]] const ArithmeticChoice &arithmetic() const;

    /// The word for the kernel that renders, and a hash of its SPIR-V.
    [[nodiscard]] std::string_view kernelName() const;
    [[nodiscard]] std::uint64_t kernelHash(Integrator integrator) const;

    /// Renders `crop` of the scene's image. `onProgress` gets the finished share of the work, in [0, 1], after each
    /// dispatch, and `timeline`, where there is one, what was done when. `shouldStop` is asked after each dispatch:
    /// where it says so, the film has the samples that are finished by then, tile after tile, and no others. Where
    /// `continuation` goes on changes no bit. Throws Error{LimitExceeded} where the scene is too large for the device,
    /// Error{DeviceLost}.
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
    std::unique_ptr<State> state_;
};

} // namespace hyalite::gpu
