// The renderer on a Vulkan device.
#pragma once

#include "host/base/error.h"
#include "host/film/film.h"
#include "host/film/noisy_picture.h"
#include "host/film/ray_counts.h"
#include "host/film/render_hooks.h"
#include "host/film/render_timing.h"
#include "host/film/repeated_pass.h"
#include "host/film/timeline.h"
#include "host/film/work_counts.h"
#include "host/gpu/memory_plan.h"
#include "host/gpu/render_config.h"
#include "host/packing/packed_scene.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core::gpu {

struct Result {
    Film film;
    RayCounts rays; ///< of the samples added to the film
    RenderTiming timing;
    WorkCounts work;     ///< all 0 unless the render config asks for counting, or samples show the work
    LaneCounts lanes{};  ///< likewise
    MemoryPlan memory{}; ///< peak memory
    /// Failed Vulkan calls in their order, each with its object or dispatch.
    std::vector<std::string> faults{};
    std::optional<Error> failure{}; ///< why the device ended the render early, or empty
};

/// Renders scenes on one device, which is opened once, and again after a failure. It keeps the last scene on the
/// device, and the pipelines of the last renders: the next render of the same scene, by another camera or in another
/// crop, begins at once.
class Renderer {
  public:
    /// `preferred` kernels run if `config` names none.
    explicit Renderer(const DeviceInfo &device, const RenderConfig &config = {},
                      const KernelChoices &preferred = {});
    ~Renderer();
    Renderer(Renderer &&) noexcept;
    Renderer &operator=(Renderer &&) noexcept;

    /// Renders by another configuration from now on. The device stays open, with its scene and pipelines, so that
    /// `config` has the same `isStaged`.
    void configure(const RenderConfig &config);

    /// With what was found when it was opened.
    [[nodiscard]] const DeviceInfo &device() const;
    /// The choice of division and square root.
    [[nodiscard]] const ArithmeticChoice &arithmetic() const;
    [[nodiscard]] const BitGuarantee &bits() const;

    /// The word for the first kernel of an integrator's dispatches, and a hash of its SPIR-V.
    [[nodiscard]] std::string_view kernelName(const PackedScene &scene, Integrator integrator) const;
    [[nodiscard]] std::uint64_t kernelHash(const PackedScene &scene, Integrator integrator) const;

    /// Adds the missing samples to `begun`, whose crop is that of the scene's image. The hooks are called after each
    /// dispatch. The image has the same bits whichever samples were there.
    ///
    /// If a Vulkan call fails, the device is opened again with half the work per dispatch, up to three times, and the
    /// render continues from a copy of the film. After the last failure the result is that copy. Throws
    /// Error{LimitExceeded} if the scene is too large for the device, and Error{Usage} if the work, which is that of a
    /// traversal with a stack, is requested from another kernel.
    [[nodiscard]] Result render(const PackedScene &scene, const RenderSettings &settings, Film begun,
                                const RenderHooks &hooks = {});

    /// Renders again and again, without retries, and compares each film with `expected` on the device. `expected` has
    /// all samples and no layers of light. Throws as render() does, Error{LimitExceeded} also where the film does not
    /// fit into one buffer, and DeviceFault at the first failure, after which the next call opens the device again.
    void repeat(const PackedScene &scene, const RenderSettings &settings, const Film &expected,
                const RepeatHooks &hooks);

    /// Traces one sample of one pixel of the whole image, step by step; at most 2^17 steps are recorded.
    [[nodiscard]] std::vector<layout::TraceEvent> trace(const PackedScene &scene,
                                                        const RenderSettings &settings,
                                                        const glm::uvec2 &pixel, std::uint32_t sampleIndex);

    /// The picture without most of its noise. If a Vulkan call fails, the device is opened once more. Throws
    /// Error{LimitExceeded} if the device is too small for it, and DeviceFault.
    [[nodiscard]] Image denoise(const NoisyPicture &picture);

  private:
    struct State;
    class Attempt;

    std::unique_ptr<State> state_;
};

} // namespace hyalite::core::gpu
