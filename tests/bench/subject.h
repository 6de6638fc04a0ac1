// A mesh with all that is made of it: trees, ray sets, and their places on the device and in Embree. Each is made when
// it is first asked for.
#pragma once

#include "tests/bench/embree.h"
#include "tests/bench/ray_sets.h"
#include "tests/bench/target.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hyalite::core::bench {

class Subject {
  public:
    /// `device` outlives the subject.
    Subject(const std::string &meshName, const gpu::DeviceInfo &device);

    [[nodiscard]] const TriangleMesh &mesh() const { return scene_.meshes.front(); }
    /// The mesh as `hyalite` frames and lights a bare one, at 512x512.
    [[nodiscard]] const Scene &scene() const { return scene_; }
    /// With the tree that renders fastest: by the surface area heuristic.
    [[nodiscard]] const PackedScene &packed();
    [[nodiscard]] const RaySet &rays(RayKind kind);
    [[nodiscard]] gpu::RayScene &onDevice(const gpu::KernelRow &kernel);
    [[nodiscard]] const EmbreeScene &embree();

  private:
    const gpu::DeviceInfo &device_;
    Scene scene_;
    std::optional<PackedScene> packed_;
    std::map<RayKind, RaySet> rays_;
    std::map<std::pair<gpu::KernelTree, gpu::KernelMemory>, gpu::RayScene> onDevice_;
    std::unique_ptr<EmbreeScene> embree_;
};

/// What the benchmarks share. It has to be gone before the program ends: drivers tidy up for themselves then.
class Context {
  public:
    explicit Context(gpu::DeviceInfo device);

    [[nodiscard]] const gpu::DeviceInfo &device() const { return device_; }
    /// What processes of `hyalite` render on beside the CPU: the same device first, then those of other drivers.
    [[nodiscard]] const std::vector<Target> &targets() const { return targets_; }
    [[nodiscard]] const Target &systemTarget() const { return targets_.front(); }
    /// Of another driver. If a driver calls itself the same, this one's name gets longer.
    void addTarget(Target target);
    /// Only the last one is kept: a large mesh in all its forms takes a gigabyte.
    [[nodiscard]] Subject &subject(const std::string &meshName);

  private:
    gpu::DeviceInfo device_;
    std::vector<Target> targets_;
    std::string subjectName_;
    std::unique_ptr<Subject> subject_;
};

} // namespace hyalite::core::bench
