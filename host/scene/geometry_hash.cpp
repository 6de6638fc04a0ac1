#include "host/scene/geometry_hash.h"

#include "host/base/hash.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace hyalite::core {

namespace {

template <class Value> void add(std::uint64_t &hash, const std::vector<Value> &values) {
    hash = hashBytes(std::as_bytes(std::span(values)), hash + values.size());
}

template <class Value> void add(std::uint64_t &hash, const CornerValues<Value> &values) {
    add(hash, values.values);
    add(hash, values.corners);
}

template <class... Values> void addNumbers(std::uint64_t &hash, Values... values) {
    const std::array bytes{static_cast<std::uint32_t>(values)...};
    hash = hashBytes(std::as_bytes(std::span(bytes)), hash);
}

void add(std::uint64_t &hash, const TriangleMesh &mesh) {
    add(hash, mesh.positions);
    add(hash, mesh.normals);
    add(hash, mesh.triangles);
    addNumbers(hash, mesh.materialIndex);
    add(hash, mesh.triangleMaterials);
    add(hash, mesh.uvs);
    add(hash, mesh.triangleUvs);
    add(hash, mesh.secondUvs);
    add(hash, mesh.colours);
    add(hash, mesh.tangents);
}

} // namespace

std::uint64_t geometryHash(const Scene &scene) {
    std::uint64_t hash = 0;
    addNumbers(hash, scene.meshes.size(), scene.prototypes.size(), scene.instances.size());
    for (const TriangleMesh &mesh : scene.meshes)
        add(hash, mesh);
    for (const TriangleMesh &prototype : scene.prototypes)
        add(hash, prototype);
    for (const auto &[prototype, toWorld, meshesBefore, node] : scene.instances) {
        addNumbers(hash, prototype, meshesBefore);
        hash = hashBytes(std::as_bytes(std::span(toWorld.rows)), hash);
        hash = hashBytes(std::as_bytes(std::span(&toWorld.offset, 1)), hash);
    }
    return hash;
}

} // namespace hyalite::core
