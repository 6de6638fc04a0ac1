// Objects of a scene by name: what its nodes enclose, and which of them a user means.
#pragma once

#include "host/scene/framing.h"
#include "host/scene/instances.h"
#include "host/scene/scene.h"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace hyalite::core {

/// A mesh as it is, or a mesh at a place.
struct PlacedObject {
    const TriangleMesh &mesh;
    const Placement *place; ///< null: as it is
    std::uint32_t node;     ///< or noNode

    [[nodiscard]] glm::vec3 point(std::uint32_t position) const {
        return place == nullptr ? mesh.positions[position] : placedPoint(*place, mesh.positions[position]);
    }
};

/// Calls visit(PlacedObject) for each mesh and each instance, in the order of the input: that of inputOrder().
template <class Visit> void visitObjects(const Scene &scene, const Visit &visit) {
    std::size_t next = 0;
    const auto visitInstancesBefore = [&](std::size_t mesh) {
        for (; next < scene.instances.size() && scene.instances[next].meshesBefore <= mesh; ++next) {
            const Instance &instance = scene.instances[next];
            visit(PlacedObject{scene.prototypes[instance.prototype], &instance.toWorld, instance.node});
        }
    };
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        visitInstancesBefore(i);
        visit(PlacedObject{scene.meshes[i], nullptr, scene.meshes[i].node});
    }
    visitInstancesBefore(std::numeric_limits<std::size_t>::max());
}

/// What a scene encloses, in its own coordinates; noBounds for nothing.
struct SceneBounds {
    Bounds all = noBounds;       ///< spheres, too
    std::vector<Bounds> nodes{}; ///< of each node, with those below it
};

/// The meshes are there (Source::Kept in engine/prepare.h).
[[nodiscard]] SceneBounds sceneBounds(const Scene &scene);

/// The box of the nodes of that name: the name of a node or its mesh, or a file name with or without its folder and its
/// extension; or the index of a glTF node, where nothing has that name. Throws Error{Usage} with
/// a list of names where there is none with a triangle.
[[nodiscard]] Bounds boundsNamed(const Scene &scene, const SceneBounds &bounds, const std::string &name);

} // namespace hyalite::core
