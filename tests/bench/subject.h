// A mesh with all that is made of it: trees, ray sets, and their places on the device and in Embree. Each is made when
// it is first asked for.
#pragma once

#include "tests/bench/embree.h"
#include "tests/bench/ray_sets.h"

#include <map>
#include <optional>
#include <string>

namespace hyalite::bench {

class Subject {
  public:
    /// The subject of this name. Only the last one is kept: a large mesh in all its forms takes a gigabyte.
    [[nodiscard]] static Subject &get(const std::string &meshName);

    explicit Subject(const std::string &meshName);

    [[nodiscard]] const TriangleMesh &mesh() const { return scene_.meshes.front(); }
    /// The mesh as `hyalite` frames and lights a bare one, at 512x512.
    [[nodiscard]] const Scene &scene() const { return scene_; }
    /// With the tree that renders fastest: by the surface area heuristic.
    [[nodiscard]] const PackedScene &packed();
    [[nodiscard]] const RaySet &rays(RayKind kind);
    [[nodiscard]] gpu::RayScene &onDevice(bool isSkipList);
    [[nodiscard]] const EmbreeScene &embree();

  private:
    Scene scene_;
    std::optional<PackedScene> packed_;
    std::map<RayKind, RaySet> rays_;
    std::map<bool, gpu::RayScene> onDevice_;
    std::unique_ptr<EmbreeScene> embree_;
};

/// The device that all benchmarks use: the program's --device.
[[nodiscard]] const gpu::DeviceInfo &device();
/// Before all benchmarks. Throws Error{NoDevice}.
void chooseBenchDevice(const std::string &name);

} // namespace hyalite::bench
