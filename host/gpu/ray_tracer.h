// Traversal alone: traces rays from a buffer through the tree of a scene on a device, without an integrator.
#pragma once

#include "host/gpu/arithmetic.h"
#include "host/gpu/kernels.h"
#include "shaders/layout/ray_records.h"

#include <memory>
#include <span>
#include <vector>

namespace hyalite::core::gpu {

/// trace_rays.comp, compiled for a kernel's row.
struct RayKernel {
    const KernelRow &row;
    std::span<const std::uint32_t> spirv;
};

enum class RayGoal {
    NearestHit,
    AnyHit,
};

/// The tree of a scene in device memory.
class RayScene {
  public:
    /// As `kernel` reads it. `scene` has triangles, all of them opaque; its spheres are ignored. Throws Error{LimitExceeded} if it is too
    /// large for the device, and Error{NoDevice}.
    RayScene(const DeviceInfo &device, const PackedScene &scene, const KernelRow &kernel);
    ~RayScene();
    RayScene(RayScene &&) noexcept;
    RayScene &operator=(RayScene &&) noexcept;

  private:
    friend class RayTracer;
    struct State;
    std::unique_ptr<State> state_;
};

/// Rays in device memory, and the kernel that traces them.
class RayTracer {
  public:
    /// `scene` must outlive the tracer, and was made for a kernel that shares scenes with this one. `rays` is not empty. Throws as
    /// RayScene does.
    RayTracer(RayScene &scene, const RayKernel &kernel, RayGoal goal,
              std::span<const layout::RayRecord> rays);
    ~RayTracer();
    RayTracer(RayTracer &&) noexcept;
    RayTracer &operator=(RayTracer &&) noexcept;

    /// Traces all rays in one dispatch, and waits for it. Throws Error{DeviceLost}.
    void run();

    /// The hits of the last run. Throws Error{LimitExceeded} if a ray needs more traversal steps than one dispatch may
    /// take.
    [[nodiscard]] std::vector<layout::HitRecord> hits() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace hyalite::core::gpu
