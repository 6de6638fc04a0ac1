#include "host/bvh/joined_triangles.h"

#include "host/bvh/common_edge.h"

#include <algorithm>

namespace hyalite::core {

namespace {

Corners cornersOf(const TriangleMesh &mesh, std::size_t index) {
    const glm::uvec3 &corners = mesh.triangles[index].positions;
    return {mesh.positions[corners.x], mesh.positions[corners.y], mesh.positions[corners.z]};
}

bool canJoin(const TriangleMesh &mesh, std::size_t index) {
    const auto edge = commonEdge(cornersOf(mesh, index), cornersOf(mesh, index + 1));
    return edge && edge->isOpposite && mesh.materialOf(index) == mesh.materialOf(index + 1);
}

/// Whether each item is a triangle that can be joined with the next item.
UnsetVector<std::uint8_t> findNeighbours(std::span<const TriangleMesh> meshes,
                                         std::span<const BuildTriangle> items) {
    UnsetVector<std::uint8_t> canBeJoined(items.size());
    std::ranges::fill(canBeJoined, std::uint8_t{0});
    std::size_t first = 0; // triangle of the mesh
    auto begin = items.begin();
    for (const TriangleMesh &mesh : meshes) {
        const std::size_t last = first + mesh.triangles.size();
        const auto end = std::ranges::lower_bound(begin, items.end(), last, {}, &BuildTriangle::inputIndex);
        const std::int64_t firstItem = begin - items.begin();
        const std::int64_t lastItem = end - items.begin() - 1;
#pragma omp parallel for schedule(static) if (lastItem - firstItem > 8192)
        for (std::int64_t i = firstItem; i < lastItem; ++i) {
            const auto item = static_cast<std::size_t>(i);
            const std::uint32_t index = items[item].inputIndex;
            canBeJoined[item] = items[item + 1].inputIndex == index + 1 && canJoin(mesh, index - first);
        }
        begin = end;
        first = last;
    }
    return canBeJoined;
}

} // namespace

JoinedItems joinTriangles(std::span<const TriangleMesh> meshes, std::vector<BuildTriangle> &items) {
    JoinedItems isJoined;
    const UnsetVector<std::uint8_t> canBeJoined = findNeighbours(meshes, items);
    if (std::ranges::find(canBeJoined, std::uint8_t{1}) == canBeJoined.end())
        return isJoined;
    isJoined.resize(items.back().inputIndex + std::size_t{1});
    std::size_t count = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        BuildTriangle item = items[i];
        if (canBeJoined[i] != 0) {
            item.box.extend(items[++i].box);
            item.centroid = item.box.lower / 2.0f + item.box.upper / 2.0f;
            isJoined[item.inputIndex] = true;
        }
        items[count++] = item;
    }
    items.resize(count);
    return isJoined;
}

} // namespace hyalite::core
