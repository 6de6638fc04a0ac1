#include "host/packing/primitive_boxes.h"

#include "host/leaves/leaves.h"

#include <cstddef>
#include <tuple>
#include <utility>

namespace hyalite::core {

namespace {

/// The records of a tree: the first one, and the one after the last.
std::pair<std::uint32_t, std::uint32_t> recordsOf(const PackedScene &scene, std::size_t tree) {
    const bool isLast = tree + 1 == scene.trees.size();
    return {scene.trees[tree].firstRecord,
            isLast ? static_cast<std::uint32_t>(scene.triangles.size()) : scene.trees[tree + 1].firstRecord};
}

/// The box by which kernels confine the primitive's hits.
Box boxOf(const leaves::TriangleRecord<float> &record) {
    Box box;
    if ((record.flags & layout::triangleIsSphere) != 0) {
        const float radius = record.v1.x;
        const glm::vec3 margin = leaves::sphereBoxMargin(record.v0, radius);
        box.extend(record.v0 - radius - margin);
        box.extend(record.v0 + radius + margin);
    } else {
        box.extend(record.v0);
        box.extend(record.v1);
        box.extend(record.v2);
    }
    return box;
}

Box widened(const Box &box, float pad) {
    constexpr float roundings = 4.0f / 16777216.0f;
    return {box.lower - (pad + leaves::abs(box.lower) * roundings),
            box.upper + (pad + leaves::abs(box.upper) * roundings)};
}

} // namespace

std::uint64_t countPrimitiveBoxes(const PackedScene &scene) {
    const auto countOf = [&](std::size_t tree) {
        const auto [begin, end] = recordsOf(scene, tree);
        return std::uint64_t{end - begin};
    };
    std::uint64_t count = countOf(0);
    for (const layout::InstanceRecord &instance : scene.instances)
        count += countOf(instance.tree + 1);
    return count;
}

PrimitiveBoxes makePrimitiveBoxes(const PackedScene &scene) {
    const float pad = leaves::queryBoxPad(scene.frame.boundsLower, scene.frame.boundsUpper);
    PrimitiveBoxes made;
    made.boxes.reserve(countPrimitiveBoxes(scene));
    const auto [ownBegin, ownEnd] = recordsOf(scene, 0);
    for (std::uint32_t record = ownBegin; record < ownEnd; ++record)
        made.boxes.push_back(widened(boxOf(scene.triangles[record]), pad));
    made.counts.push_back(ownEnd - ownBegin);
    made.instances = scene.instances;
    for (layout::InstanceRecord &instance : made.instances) {
        std::tie(instance.listBegin, instance.listEnd) = recordsOf(scene, instance.tree + 1);
        for (std::uint32_t record = instance.listBegin; record < instance.listEnd; ++record)
            made.boxes.push_back(
                widened(boxOf(leaves::placedTriangle<float>(instance, scene.triangles[record])), pad));
        made.counts.push_back(instance.listEnd - instance.listBegin);
    }
    return made;
}

} // namespace hyalite::core
