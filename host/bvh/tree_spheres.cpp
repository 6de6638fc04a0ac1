#include "host/bvh/tree_spheres.h"

#include <glm/common.hpp>

#include <algorithm>
#include <limits>
#include <numeric>

namespace hyalite::core {

namespace {

/// Half of the longest side of a box that grows.
class Extent {
  public:
    void extend(const glm::dvec3 &point, double radius = 0.0) {
        lower_ = glm::min(lower_, point - radius);
        upper_ = glm::max(upper_, point + radius);
    }
    [[nodiscard]] double half() const {
        const glm::dvec3 size = upper_ - lower_;
        return std::max({size.x, size.y, size.z, 0.0}) / 2.0;
    }

  private:
    glm::dvec3 lower_{std::numeric_limits<double>::infinity()};
    glm::dvec3 upper_{-std::numeric_limits<double>::infinity()};
};

/// Of all but the spheres; an instance counts as a point.
Extent extentOfMeshes(const Scene &scene) {
    Extent extent;
    for (const TriangleMesh &mesh : scene.meshes)
        for (const glm::vec3 &position : mesh.positions)
            extent.extend(glm::dvec3(position));
    for (const Instance &instance : scene.instances)
        extent.extend(glm::dvec3(instance.toWorld.offset));
    return extent;
}

} // namespace

std::vector<std::uint32_t> spheresInTree(const Scene &scene) {
    if (scene.spheres.size() <= layout::maxUnrolledSpheres)
        return {};
    std::vector<std::uint32_t> bySize(scene.spheres.size());
    std::iota(bySize.begin(), bySize.end(), 0u);
    std::ranges::stable_sort(bySize, {}, [&](std::uint32_t index) { return scene.spheres[index].radius; });
    // Giants are larger than all that is smaller than they are, taken together.
    constexpr double larger = 2.0;
    Extent extent = extentOfMeshes(scene);
    std::size_t count = 0;
    for (; count < bySize.size(); ++count) {
        const Sphere &sphere = scene.spheres[bySize[count]];
        if (count > 0 && sphere.radius > larger * extent.half() &&
            bySize.size() - count <= layout::maxUnrolledSpheres)
            break;
        extent.extend(sphere.centre, sphere.radius);
    }
    bySize.resize(count);
    std::ranges::sort(bySize);
    return bySize;
}

} // namespace hyalite::core
