#include "host/packing/packed_trees.h"

#include "host/packing/leaf_pairs.h"
#include "host/packing/surface_features.h"
#include "host/scene/instances.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace hyalite::core {

namespace {

// Triangles that the tree dropped.
constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

/// Whether a loop of `count` iterations is long enough for several threads.
bool isLong(std::int64_t count) { return count > 8192; }

/// The place of each entry of a tree's order among the records: triangles and instances have arrays of their own.
std::vector<std::uint32_t> recordsOf(const Bvh &bvh, std::uint32_t firstTriangleRecord) {
    std::vector<std::uint32_t> records;
    records.reserve(bvh.order.size());
    std::uint32_t instanceCount = 0;
    std::uint32_t triangleRecord = firstTriangleRecord;
    for (const std::uint32_t inputIndex : bvh.order)
        records.push_back(bvh.isInstance(inputIndex) ? instanceCount++ : triangleRecord++);
    return records;
}

/// Writes the records of a mesh: `recordOf` has the index of each, or `nowhere`. Ids count from `firstId`.
void packTriangles(const Scene &scene, const TriangleMesh &mesh, std::span<const std::uint32_t> recordOf,
                   std::uint32_t firstId, std::span<const std::uint32_t> packedMaterial,
                   PackedScene &packed) {
    const auto count = static_cast<std::int64_t>(mesh.triangles.size());
    const bool hasTransparency = hasTransparentColours(mesh);
    bool hasNormals = packed.hasNormals;
#pragma omp parallel for schedule(static) reduction(|| : hasNormals) if (isLong(count))
    for (std::int64_t i = 0; i < count; ++i) {
        const auto index = static_cast<std::size_t>(i);
        const MeshTriangle &corner = mesh.triangles[index];
        const std::uint32_t record = recordOf[index];
        if (record == nowhere)
            continue;
        layout::TriangleRecord triangle;
        triangle.v0 = mesh.positions[corner.positions.x];
        triangle.v1 = mesh.positions[corner.positions.y];
        triangle.v2 = mesh.positions[corner.positions.z];
        triangle.primitiveId = firstId + static_cast<std::uint32_t>(i);
        const std::uint32_t materialIndex = mesh.materialOf(index);
        const Material &material = scene.materials[materialIndex];
        const bool isTransmissive = material.kind == MaterialKind::Dielectric;
        triangle.materialIndex = packedMaterial[materialIndex];
        const std::uint32_t anyHit = anyHitOf(material, hasTransparency);
        triangle.flags = (isTransmissive ? layout::triangleIsTransmissive : 0u) |
                         ((anyHit & layout::anyHitAlpha) != 0 ? layout::triangleIsAlphaTested : 0u) |
                         ((anyHit & layout::anyHitCulled) != 0 ? layout::triangleIsCulled : 0u);
        packed.triangles[record] = triangle;
        layout::NormalRecord normals{};
        if (corner.normals.x != MeshTriangle::noNormal) {
            normals.n0 = mesh.normals[corner.normals.x];
            normals.n1 = mesh.normals[corner.normals.y];
            normals.n2 = mesh.normals[corner.normals.z];
            hasNormals = true;
        }
        packed.normals[record] = normals;
    }
    packed.hasNormals = hasNormals;
}

/// Writes the records of spheres in the tree; `recordOf` has the index of each.
void packSpheres(std::span<const std::uint32_t> spheres, std::span<const std::uint32_t> recordOf,
                 PackedScene &packed) {
    const auto count = static_cast<std::int64_t>(spheres.size());
#pragma omp parallel for schedule(static) if (isLong(count))
    for (std::int64_t i = 0; i < count; ++i) {
        const layout::SphereRecord &sphere = packed.spheres[spheres[static_cast<std::size_t>(i)]];
        const std::uint32_t index = recordOf[static_cast<std::size_t>(i)];
        layout::TriangleRecord record{};
        record.v0 = sphere.centre;
        record.v1.x = sphere.radius;
        record.primitiveId = sphere.primitiveId;
        record.materialIndex = materialIndexOf(sphere);
        record.flags =
            layout::triangleIsSphere | (sphere.isTransmissive != 0 ? layout::triangleIsTransmissive : 0u);
        packed.triangles[index] = record;
        packed.normals[index] = {};
    }
}

/// Leaves with triangles.
struct LeafCount {
    std::int64_t pairs = 0;
    std::int64_t others = 0;
};

/// Marks the last triangle of each leaf.
void endLeaves(const Bvh &bvh, std::span<const std::uint32_t> records, PackedScene &packed,
               LeafCount &leaves) {
    const auto count = static_cast<std::int64_t>(bvh.nodes.size());
    std::int64_t pairs = 0;
    std::int64_t others = 0;
#pragma omp parallel for schedule(static) reduction(+ : pairs, others) if (isLong(count))
    for (std::int64_t i = 0; i < count; ++i) {
        const BvhNode &node = bvh.nodes[static_cast<std::size_t>(i)];
        if (!node.isLeaf() || bvh.isInstance(bvh.order[node.first]))
            continue;
        layout::TriangleRecord *const first = &packed.triangles[records[node.first]];
        first[node.count - 1].flags |= layout::triangleEndsLeaf;
        const bool isPair = node.count == 2 && pairingOf(first[0], first[1]) != 0;
        pairs += isPair;
        others += !isPair;
    }
    leaves.pairs += pairs;
    leaves.others += others;
}

std::uint32_t leafReference(const Bvh &bvh, std::span<const std::uint32_t> records, const BvhNode &leaf) {
    return layout::leafFlag | (bvh.isInstance(bvh.order[leaf.first]) ? layout::instanceFlag : 0u) |
           records[leaf.first];
}

/// Appends the inner nodes in the order of their creation, which is depth first, so that a left child is close to its
/// parent.
void packNodes(const Bvh &bvh, std::span<const std::uint32_t> records, PackedScene &packed) {
    const auto emptyPair = [] {
        layout::NodePair pair{};
        pair.left = layout::noNode;
        pair.right = layout::noNode;
        return pair;
    };
    if (bvh.nodes.empty() || bvh.nodes.front().isLeaf()) {
        layout::NodePair root = emptyPair();
        if (!bvh.nodes.empty()) {
            root.leftLower = bvh.nodes.front().box.lower;
            root.leftUpper = bvh.nodes.front().box.upper;
            root.left = leafReference(bvh, records, bvh.nodes.front());
        }
        packed.nodes.push_back(root);
        return;
    }
    UnsetVector<std::uint32_t> reference(bvh.nodes.size());
    auto innerCount = static_cast<std::uint32_t>(packed.nodes.size());
    for (std::size_t i = 0; i < bvh.nodes.size(); ++i)
        reference[i] = bvh.nodes[i].isLeaf() ? leafReference(bvh, records, bvh.nodes[i]) : innerCount++;
    packed.nodes.resize(innerCount);
    const auto nodeCount = static_cast<std::int64_t>(bvh.nodes.size());
#pragma omp parallel for schedule(static) if (isLong(nodeCount))
    for (std::int64_t i = 0; i < nodeCount; ++i) {
        const BvhNode &node = bvh.nodes[static_cast<std::size_t>(i)];
        if (node.isLeaf())
            continue;
        layout::NodePair pair{};
        const BvhNode &left = bvh.nodes[node.first];
        const BvhNode &right = bvh.nodes[node.first + 1];
        pair.leftLower = left.box.lower;
        pair.leftUpper = left.box.upper;
        pair.left = reference[node.first];
        pair.rightLower = right.box.lower;
        pair.rightUpper = right.box.upper;
        pair.right = reference[node.first + 1];
        packed.nodes[reference[static_cast<std::size_t>(i)]] = pair;
    }
}

/// Makes room for a tree's triangles, whose records are unset.
PackedTree beginTree(const Bvh &bvh, std::size_t triangleCount, PackedScene &packed) {
    PackedTree tree;
    tree.firstPair = static_cast<std::uint32_t>(packed.nodes.size());
    tree.firstRecord = static_cast<std::uint32_t>(packed.triangles.size());
    if (!bvh.nodes.empty())
        tree.box = bvh.nodes.front().box;
    packed.triangles.resize(packed.triangles.size() + triangleCount);
    packed.normals.resize(packed.triangles.size());
    return tree;
}

void packSceneTree(const Scene &scene, const Bvh &bvh, const InputOrder &order,
                   std::span<const std::uint32_t> packedMaterial, PackedScene &packed, LeafCount &leaves) {
    const auto hasRecord = [&](std::uint32_t inputIndex) { return !bvh.isInstance(inputIndex); };
    packed.trees.push_back(
        beginTree(bvh, static_cast<std::size_t>(std::ranges::count_if(bvh.order, hasRecord)), packed));
    const std::vector<std::uint32_t> records = recordsOf(bvh, 0);
    UnsetVector<std::uint32_t> recordOf(triangleCount(scene) +
                                        bvh.spheres.size()); // of each triangle and sphere
    const auto total = static_cast<std::int64_t>(bvh.order.size());
    if (packed.triangles.size() < recordOf.size()) // the tree dropped some
        std::ranges::fill(recordOf, nowhere);
#pragma omp parallel for schedule(static) if (isLong(total))
    for (std::int64_t i = 0; i < total; ++i)
        if (hasRecord(bvh.order[static_cast<std::size_t>(i)]))
            recordOf[bvh.order[static_cast<std::size_t>(i)]] = records[static_cast<std::size_t>(i)];
    packSpheres(bvh.spheres, std::span(recordOf).subspan(triangleCount(scene)), packed);
    std::size_t first = 0;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const TriangleMesh &mesh = scene.meshes[i];
        packTriangles(scene, mesh, std::span(recordOf).subspan(first, mesh.triangles.size()),
                      packed.frame.firstTriangleId + order.meshes[i], packedMaterial, packed);
        first += mesh.triangles.size();
    }
    endLeaves(bvh, records, packed, leaves);
    packNodes(bvh, records, packed);
}

/// The triangles' ids are their indices in the mesh; an instance adds that of its first one.
void packPrototype(const Scene &scene, const TriangleMesh &mesh, const Bvh &bvh,
                   std::span<const std::uint32_t> packedMaterial, PackedScene &packed, LeafCount &leaves) {
    packed.trees.push_back(beginTree(bvh, bvh.order.size(), packed));
    const std::vector<std::uint32_t> records = recordsOf(bvh, packed.trees.back().firstRecord);
    UnsetVector<std::uint32_t> recordOf(mesh.triangles.size());
    for (std::size_t i = 0; i < records.size(); ++i)
        recordOf[bvh.order[i]] = records[i];
    packTriangles(scene, mesh, recordOf, 0, packedMaterial, packed);
    endLeaves(bvh, records, packed, leaves);
    packNodes(bvh, records, packed);
}

layout::InstanceRecord packInstance(const Instance &instance, std::uint32_t firstPrimitive,
                                    const PackedTree &tree) {
    const Placement &placement = instance.toWorld;
    layout::InstanceRecord record{};
    record.toX = placement.rows[0];
    record.toY = placement.rows[1];
    record.toZ = placement.rows[2];
    record.offsetX = placement.offset.x;
    record.offsetY = placement.offset.y;
    record.offsetZ = placement.offset.z;
    // The bound of instance.glsl. The grid of skip lists reaches a little beyond the box, hence more than 24.
    constexpr double roundings = 25.0 / 16777216.0;
    const glm::dvec3 size(glm::max(glm::abs(tree.box.lower), glm::abs(tree.box.upper)));
    record.slack = glm::vec3(placedExtent(placement, size) * roundings);
    record.firstPrimitive = firstPrimitive;
    record.tree = instance.prototype;
    record.root = tree.firstPair;
    return record;
}

} // namespace

void packTrees(const Scene &scene, const Bvh &bvh, std::span<const std::uint32_t> packedMaterial,
               PackedScene &packed) {
    const InputOrder order = inputOrder(scene);
    LeafCount leaves;
    packSceneTree(scene, bvh, order, packedMaterial, packed, leaves);
    int deepest = 0;
    for (std::size_t i = 0; i < bvh.prototypes.size(); ++i) {
        packPrototype(scene, scene.prototypes[i], bvh.prototypes[i], packedMaterial, packed, leaves);
        deepest = std::max(deepest, bvh.prototypes[i].depth);
    }
    for (const std::uint32_t inputIndex : bvh.order)
        if (bvh.isInstance(inputIndex)) {
            const std::size_t index = inputIndex - bvh.firstInstance;
            const Instance &instance = scene.instances[index];
            packed.instances.push_back(packInstance(instance,
                                                    packed.frame.firstTriangleId + order.instances[index],
                                                    packed.trees[instance.prototype + 1]));
        }
    // Two triangles at once take about 1.2 times as long as one.
    packed.hasPairs = packed.treeSpheres == layout::treeHasTriangles && 4 * leaves.pairs > leaves.others &&
                      packed.triangles.size() <= std::size_t{1} << layout::leafRecordBits;
    // On the way into an instance, the way back waits on the stack, too.
    packed.treeDepth = bvh.depth + (packed.instances.empty() ? 0 : 1 + deepest);
}

} // namespace hyalite::core
