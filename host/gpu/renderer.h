// The renderer on a Vulkan device.
#pragma once

#include "host/bvh/packed_scene.h"
#include "host/gpu/arithmetic.h"
#include "host/image/film.h"
#include "host/report/ray_counts.h"
#include "host/report/render_timing.h"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace hyalite::gpu {

/// How rays go through the tree. Stack: the portable one, over storage buffers. SkipList: over texel buffers, which
/// lavapipe reads several times faster.
enum class Traversal { Automatic, Stack, SkipList };

/// How work is cut into dispatches, and what for. The image does not depend on any of it.
struct Batching {
    int tileWidth = 0;          ///< pixels, a multiple of 8; 0: by the device
    int tileHeight = 0;         ///< pixels, a multiple of 8; 0: by the device
    std::uint32_t steps = 0;    ///< loop iterations of a path slot in one dispatch; 0: by the device
    int slotsPerInvocation = 0; ///< path slots of one invocation, 1 or 2; 0: by the device
    bool isStaged = false;      ///< transfer everything through staging buffers
    Arithmetic arithmetic = Arithmetic::Automatic; ///< which / and sqrt run
    Traversal traversal = Traversal::Automatic;
    /// SPIR-V to run in place of our kernel, to see how a faulty one is found; empty: ours. One slot an
    /// invocation, and the stack.
    std::span<const std::uint32_t> kernel{};
};

struct Result {
    Film film;
    RayCounts rays;
    RenderTiming timing;
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

    /// Renders `crop` of the scene's image. `onProgress` gets the finished share of the work, in [0, 1], after each
    /// dispatch. Throws Error{LimitExceeded} where the scene is too large for the device, Error{DeviceLost}.
    [[nodiscard]] Result render(const PackedScene &scene, const RenderSettings &settings, const Crop &crop,
                                const std::function<void(double)> &onProgress = {});

    /// What one sample of one pixel of the whole image does, step by step; at most 2^17 steps are kept.
    [[nodiscard]] std::vector<layout::TraceEvent> trace(const PackedScene &scene,
                                                        const RenderSettings &settings,
                                                        const glm::uvec2 &pixel, std::uint32_t sampleIndex);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace hyalite::gpu
