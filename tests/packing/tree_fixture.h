// Scenes for tests of trees.
#pragma once

#include "host/packing/packed_scene.h"

#include <random>

namespace hyalite::core::testing {

/// `count` small triangles in a cube of the given size around `centre`.
inline Scene randomScene(std::size_t count, float size, const glm::vec3 &centre) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(-0.5f, 0.5f);
    const auto point = [&](float scale) {
        return glm::vec3(uniform(random), uniform(random), uniform(random)) * scale;
    };
    Scene scene;
    scene.materials.push_back({});
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 corner = centre + point(size);
        mesh.positions.insert(mesh.positions.end(),
                              {corner, corner + point(size * 0.02f), corner + point(size * 0.02f)});
        mesh.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}});
    }
    scene.meshes.push_back(mesh);
    return scene;
}

inline PackedScene pack(const Scene &scene, TreeKind kind, int leafSize) {
    return packScene(scene, buildBvh(kind, buildTriangles(scene), leafSize));
}

} // namespace hyalite::core::testing
