// Rays from a buffer through the tree of a scene on a device: traversal by itself, without an integrator around it.
#pragma once

#include "host/gpu/arithmetic.h"
#include "host/gpu/vk/device_list.h"
#include "host/packing/packed_scene.h"
#include "shaders/layout/ray_records.h"

#include <memory>
#include <span>
#include <vector>

namespace hyalite::gpu {

/// A trace_rays.comp that was compiled for one way through the tree.
struct RayKernel {
    const char *name;
    bool isSkipList; ///< skip lists in texel buffers; otherwise node pairs in storage buffers
    int raysPerInvocation;
    std::span<const std::uint32_t> spirv;
};

enum class RayGoal {
    NearestHit,
    AnyHit,
};

/// A scene's tree in the memory of a device, in the form that some kernels read.
class RayScene {
  public:
    /// `scene` has triangles, all of them opaque; its spheres are left out. Throws Error{LimitExceeded} where it is
    /// too large for the device, Error{NoDevice}.
    RayScene(const DeviceInfo &device, const PackedScene &scene, bool isSkipList);
    ~RayScene();
    RayScene(RayScene &&) noexcept;
    RayScene &operator=(RayScene &&) noexcept;

  private:
    friend class RayTracer;
    struct State;
    std::unique_ptr<State> state_;
};

/// Rays in the memory of a device, and a kernel that follows them.
class RayTracer {
  public:
    /// `scene` outlives the tracer and has the form that the kernel reads; there is at least one ray. Throws as
    /// RayScene does.
    RayTracer(RayScene &scene, const RayKernel &kernel, RayGoal goal,
              std::span<const layout::RayRecord> rays);
    ~RayTracer();
    RayTracer(RayTracer &&) noexcept;
    RayTracer &operator=(RayTracer &&) noexcept;

    /// Follows all rays in one dispatch, and waits for it. Throws Error{DeviceLost}.
    void run();

    /// What the rays of the last run hit. Throws Error{LimitExceeded} where one was not followed to its end, as its
    /// traversal takes more steps than one dispatch has.
    [[nodiscard]] std::vector<layout::HitRecord> hits() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace hyalite::gpu
