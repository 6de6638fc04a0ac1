#include "host/bvh/bvh.h"
#include "host/bvh/split.h"
#include "host/error.h"
#include "shaders/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>

namespace hyalite {

namespace {

Box boxOf(std::span<const BuildTriangle> range) {
    Box box;
    for (const BuildTriangle &triangle : range)
        box.extend(triangle.box);
    return box;
}

/// A node whose range is still to be divided. Depth-first with an explicit stack: input decides the depth.
struct Task {
    std::uint32_t node;
    std::uint32_t begin;
    std::uint32_t end;
    int depth; ///< inner nodes above
};

/// Halving is forced as soon as it is the only way to stay within the depth that traversal stacks have room for.
bool mustHalve(std::size_t count, int depth) {
    constexpr int deepest = static_cast<int>(layout::maxTreeDepth) - 1;
    return depth + static_cast<int>(std::bit_width(count)) >= deepest;
}

} // namespace

double Box::halfArea() const {
    if (isEmpty())
        return 0.0;
    const glm::dvec3 size = glm::dvec3(upper) - glm::dvec3(lower);
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

std::vector<BuildTriangle> buildTriangles(const Scene &scene) {
    const std::size_t count = triangleCount(scene);
    // Ids and leaf references keep one bit for the leaf flag and the first ids for spheres.
    constexpr std::size_t most = layout::leafFlag - layout::firstTriangleId - 1;
    if (count > most)
        throw Error(ExitCode::LimitExceeded,
                    fmt::format("the scene has {} triangles; at most {} can be addressed", count, most));
    std::vector<BuildTriangle> triangles;
    triangles.reserve(count);
    for (const TriangleMesh &mesh : scene.meshes) {
        for (const MeshTriangle &corner : mesh.triangles) {
            const glm::vec3 &a = mesh.positions[corner.positions.x];
            const glm::vec3 &b = mesh.positions[corner.positions.y];
            const glm::vec3 &c = mesh.positions[corner.positions.z];
            BuildTriangle triangle;
            triangle.box.extend(a);
            triangle.box.extend(b);
            triangle.box.extend(c);
            triangle.centroid = a / 3.0f + b / 3.0f + c / 3.0f;
            triangle.inputIndex = static_cast<std::uint32_t>(triangles.size());
            triangles.push_back(triangle);
        }
    }
    return triangles;
}

Bvh buildBvh(TreeKind kind, std::vector<BuildTriangle> triangles, int leafSize) {
    assert(leafSize >= 1);
    Bvh bvh;
    if (triangles.empty())
        return bvh;
    const SplitFunction split = kind == TreeKind::Sah ? splitBySah : splitAtMidpoint;
    const std::size_t size = kind == TreeKind::None ? triangles.size() : static_cast<std::size_t>(leafSize);

    bvh.nodes.push_back({boxOf(triangles), 0, 0});
    std::vector<Task> tasks{{0, 0, static_cast<std::uint32_t>(triangles.size()), 0}};
    while (!tasks.empty()) {
        const Task task = tasks.back();
        tasks.pop_back();
        bvh.depth = std::max(bvh.depth, task.depth);
        const std::span<BuildTriangle> range =
            std::span(triangles).subspan(task.begin, task.end - task.begin);
        const Box box = bvh.nodes[task.node].box;
        std::size_t leftCount = 0;
        if (range.size() > 1 && kind != TreeKind::None) {
            if (!mustHalve(range.size(), task.depth))
                leftCount = split(range, box, size);
            else if (range.size() > size)
                leftCount = splitAtMedian(range, box);
        }
        if (leftCount == 0) {
            bvh.nodes[task.node].first = task.begin;
            bvh.nodes[task.node].count = task.end - task.begin;
            continue;
        }
        const std::uint32_t left = static_cast<std::uint32_t>(bvh.nodes.size());
        const std::uint32_t middle = task.begin + static_cast<std::uint32_t>(leftCount);
        bvh.nodes[task.node].first = left;
        bvh.nodes.push_back({boxOf(range.first(leftCount)), 0, 0});
        bvh.nodes.push_back({boxOf(range.subspan(leftCount)), 0, 0});
        tasks.push_back({left + 1, middle, task.end, task.depth + 1});
        tasks.push_back({left, task.begin, middle, task.depth + 1});
    }
    bvh.order.reserve(triangles.size());
    for (const BuildTriangle &triangle : triangles)
        bvh.order.push_back(triangle.inputIndex);
    return bvh;
}

} // namespace hyalite
