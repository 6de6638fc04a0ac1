#include "host/scene/instances.h"

#include "host/base/error.h"
#include "host/base/host_memory.h"
#include "host/base/quantities.h"
#include "host/leaves/leaves.h"
#include "host/scene/limits.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace hyalite::core {

namespace {

constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

/// The map as leaf functions read it.
leaves::InstanceRecord<float> recordOf(const Placement &placement) {
    leaves::InstanceRecord<float> record;
    record.toX = placement.rows[0];
    record.offsetX = placement.offset.x;
    record.toY = placement.rows[1];
    record.offsetY = placement.offset.y;
    record.toZ = placement.rows[2];
    record.offsetZ = placement.offset.z;
    return record;
}

bool emitsLight(const TriangleMesh &mesh, const std::vector<Material> &materials) {
    const auto emits = [&](std::uint32_t index) { return materials[index].emission != glm::vec3(0.0f); };
    if (mesh.triangleMaterials.empty())
        return emits(mesh.materialIndex);
    return std::ranges::any_of(mesh.triangleMaterials, emits);
}

/// Beyond it cofactors of the map, scaled as placedNormal scales them, could be subnormal.
bool isNearlyFlat(const Placement &placement) {
    const std::array<glm::vec3, 3> &rows = placement.rows;
    const double largest =
        leaves::largestComponent(glm::max(glm::max(glm::abs(rows[0]), glm::abs(rows[1])), glm::abs(rows[2])));
    return std::abs(determinant(placement)) < 1e-18 * largest * largest * largest;
}

constexpr std::uint64_t bytesPerTriangle = 300; // as a mesh, in the build and packed

/// Throws Error{LimitExceeded} if so many triangles cannot be stored.
void requireRoomFor(std::uint64_t flattenedTriangles) {
    if (flattenedTriangles > limits::triangleCount)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("without instances the scene has {} triangles; at most {} can be stored",
                                flattenedTriangles, limits::triangleCount));
    const std::optional<std::uint64_t> available = availableHostBytes();
    if (available && flattenedTriangles * bytesPerTriangle > *available)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("without instances the scene takes about {} of memory, and {} are available",
                                sizeText(flattenedTriangles * bytesPerTriangle), sizeText(*available)));
}

TriangleMesh flattened(const TriangleMesh &prototype, const Placement &placement) {
    TriangleMesh mesh = prototype;
    for (glm::vec3 &position : mesh.positions)
        position = placedPoint(placement, position);
    for (glm::vec3 &normal : mesh.normals)
        normal = placedNormal(placement, normal);
    for (glm::vec4 &tangent : mesh.tangents.values)
        tangent = placedTangent(placement, tangent);
    return mesh;
}

/// Keeps the prototypes that instances use.
void keepUsedPrototypes(Scene &scene) {
    std::vector<TriangleMesh> kept;
    std::vector<std::uint32_t> indices(scene.prototypes.size(), nowhere);
    for (Instance &instance : scene.instances) {
        std::uint32_t &index = indices[instance.prototype];
        if (index == nowhere) {
            index = static_cast<std::uint32_t>(kept.size());
            kept.push_back(std::move(scene.prototypes[instance.prototype]));
        }
        instance.prototype = index;
    }
    scene.prototypes = std::move(kept);
}

/// Marks prototypes, those with the fewest triangles more first, while all triangles have room.
void flattenFitting(const Scene &scene, std::span<const std::size_t> useCounts,
                    std::vector<bool> &isFlattened) {
    std::uint64_t room = fittingTriangles;
    if (const std::optional<std::uint64_t> available = availableHostBytes())
        room =
            std::min(room, *available / 4 / bytesPerTriangle); // most is left to films, and to other programs
    std::uint64_t count = triangleCount(scene);
    std::vector<std::pair<std::uint64_t, std::size_t>> others; // triangles more, prototype
    for (std::size_t i = 0; i < scene.prototypes.size(); ++i) {
        const std::uint64_t more = useCounts[i] * scene.prototypes[i].triangles.size();
        if (isFlattened[i])
            count += more;
        else if (useCounts[i] > 0)
            others.emplace_back(more, i);
    }
    std::ranges::sort(others);
    for (const auto &[more, prototype] : others) {
        count += more;
        if (count > room)
            return;
        isFlattened[prototype] = true;
    }
}

} // namespace

InputOrder inputOrder(const Scene &scene) {
    InputOrder order;
    order.meshes.reserve(scene.meshes.size());
    order.instances.reserve(scene.instances.size());
    const auto addInstancesBefore = [&](std::size_t mesh) {
        while (order.instances.size() < scene.instances.size() &&
               scene.instances[order.instances.size()].meshesBefore <= mesh) {
            const Instance &instance = scene.instances[order.instances.size()];
            order.instances.push_back(static_cast<std::uint32_t>(order.triangleCount));
            order.triangleCount += scene.prototypes[instance.prototype].triangles.size();
        }
    };
    for (const TriangleMesh &mesh : scene.meshes) {
        addInstancesBefore(order.meshes.size());
        order.meshes.push_back(static_cast<std::uint32_t>(order.triangleCount));
        order.triangleCount += mesh.triangles.size();
    }
    addInstancesBefore(std::numeric_limits<std::size_t>::max());
    return order;
}

double determinant(const Placement &placement) {
    const std::array<glm::vec3, 3> &rows = placement.rows;
    return glm::dot(glm::cross(glm::dvec3(rows[0]), glm::dvec3(rows[1])), glm::dvec3(rows[2]));
}

glm::vec3 placedPoint(const Placement &placement, const glm::vec3 &point) {
    return leaves::placedPoint(recordOf(placement), point);
}

glm::vec3 placedNormal(const Placement &placement, const glm::vec3 &normal) {
    return leaves::placedNormal(recordOf(placement), normal);
}

glm::vec4 placedTangent(const Placement &placement, const glm::vec4 &tangent) {
    return leaves::placedTangent(recordOf(placement), tangent);
}

TriangleMesh mirrored(TriangleMesh mesh) {
    for (glm::vec3 &normal : mesh.normals)
        normal = -normal;
    for (MeshTriangle &triangle : mesh.triangles) {
        std::swap(triangle.positions.y, triangle.positions.z);
        std::swap(triangle.normals.y, triangle.normals.z);
    }
    for (glm::uvec3 &uvs : mesh.triangleUvs)
        std::swap(uvs.y, uvs.z);
    const auto turn = [](std::vector<glm::uvec3> &corners) {
        for (glm::uvec3 &triangle : corners)
            std::swap(triangle.y, triangle.z);
    };
    turn(mesh.secondUvs.corners);
    turn(mesh.colours.corners);
    turn(mesh.tangents.corners);
    for (glm::vec4 &tangent : mesh.tangents.values)
        tangent.w = -tangent.w;
    return mesh;
}

void addInstances(Scene &scene, TriangleMesh mesh, std::span<const Placement> placements,
                  std::span<const std::uint32_t> nodes) {
    assert(nodes.empty() || nodes.size() == placements.size());
    const auto meshesBefore = static_cast<std::uint32_t>(scene.meshes.size());
    const std::size_t mirroringCount =
        static_cast<std::size_t>(std::ranges::count_if(placements, isMirroring));
    const bool hasBoth = mirroringCount > 0 && mirroringCount < placements.size();
    const auto first = static_cast<std::uint32_t>(scene.prototypes.size());
    if (placements.empty())
        return;
    if (hasBoth)
        scene.prototypes.push_back(mesh);
    scene.prototypes.push_back(mirroringCount > 0 ? mirrored(std::move(mesh)) : std::move(mesh));
    scene.instances.reserve(scene.instances.size() + placements.size());
    for (std::size_t i = 0; i < placements.size(); ++i)
        scene.instances.push_back({first + (hasBoth && isMirroring(placements[i]) ? 1u : 0u), placements[i],
                                   meshesBefore, nodes.empty() ? noNode : nodes[i]});
}

glm::dvec3 placedExtent(const Placement &placement, const glm::dvec3 &size) {
    glm::dvec3 extent(glm::abs(placement.offset));
    for (glm::length_t i = 0; i < 3; ++i)
        extent[i] += glm::dot(glm::dvec3(glm::abs(placement.rows[static_cast<std::size_t>(i)])), size);
    return extent;
}

Arrangement arrangeInstances(Scene &scene, Flattening flattening) {
    if (scene.instances.empty() && scene.prototypes.empty())
        return {};
    std::vector<std::size_t> useCounts(scene.prototypes.size(), 0);
    for (const Instance &instance : scene.instances)
        ++useCounts[instance.prototype];
    std::vector<bool> isFlattened; // of each prototype
    for (std::size_t i = 0; i < scene.prototypes.size(); ++i)
        isFlattened.push_back(flattening == Flattening::All || useCounts[i] == 1 ||
                              emitsLight(scene.prototypes[i], scene.materials));
    if (flattening == Flattening::Fitting)
        flattenFitting(scene, useCounts, isFlattened);

    const std::vector<Instance> instances = scene.instances;
    flattenInstances(scene, [&](std::size_t i) {
        return isFlattened[instances[i].prototype] || isNearlyFlat(instances[i].toWorld);
    });
    return {instances.size(),
            static_cast<std::size_t>(
                std::ranges::count_if(useCounts, [](std::size_t count) { return count > 0; })),
            instances.size() - scene.instances.size()};
}

void flattenInstances(Scene &scene, const std::function<bool(std::size_t)> &becomesMesh) {
    std::uint64_t flattenedTriangles = triangleCount(scene);
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (becomesMesh(i))
            flattenedTriangles += scene.prototypes[scene.instances[i].prototype].triangles.size();
    requireRoomFor(flattenedTriangles);

    std::vector<TriangleMesh> meshes;
    std::vector<Instance> instances;
    std::size_t instanceIndex = 0;
    const auto takeInstancesBefore = [&](std::size_t mesh) {
        for (; instanceIndex < scene.instances.size() && scene.instances[instanceIndex].meshesBefore <= mesh;
             ++instanceIndex) {
            Instance instance = scene.instances[instanceIndex];
            instance.meshesBefore = static_cast<std::uint32_t>(meshes.size());
            if (becomesMesh(instanceIndex)) {
                meshes.push_back(flattened(scene.prototypes[instance.prototype], instance.toWorld));
                meshes.back().node = instance.node;
            } else {
                instances.push_back(instance);
            }
        }
    };
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        takeInstancesBefore(i);
        meshes.push_back(std::move(scene.meshes[i]));
    }
    takeInstancesBefore(std::numeric_limits<std::size_t>::max());
    scene.meshes = std::move(meshes);
    scene.instances = std::move(instances);
    keepUsedPrototypes(scene);
}

} // namespace hyalite::core
