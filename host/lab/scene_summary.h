// Summary of a prepared scene: what `hyalite inspect` tells, as numbers and names. Points are in the coordinates of the
// file.
#pragma once

#include "host/bvh/tree_statistics.h"
#include "host/engine/prepare.h"
#include "host/scene/framing.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hyalite::core {

struct MaterialSummary {
    std::string name;
    MaterialKind kind = MaterialKind::Diffuse;
    std::uint64_t sphereCount = 0;   ///< that wear it
    std::uint64_t triangleCount = 0; ///< likewise; those of instances once for each place
    glm::vec3 emission{0.0f};
    bool isTwoSided = false;
    std::vector<std::pair<std::string_view, std::string>> textures{}; ///< key and file

    [[nodiscard]] bool isUsed() const { return sphereCount > 0 || triangleCount > 0; }
    [[nodiscard]] bool emits() const { return emission != glm::vec3(0.0f) && isUsed(); }
};

struct EnvironmentSummary {
    int width = 0;
    int height = 0;
    float scale = 1.0f;
    double rotateDegrees = 0.0;
};

struct ProfileSummary {
    std::string file;
    std::size_t gammaCount = 0; ///< angles
    std::size_t planeCount = 0; ///< all around
    double candela = 0.0;       ///< the greatest
    double lumens = 0.0;
};

struct NodeSummary {
    SceneNode node;
    std::optional<Bounds> bounds; ///< of all triangles at the node and below it
};

struct TreeSummary {
    BvhStatistics statistics;
    std::size_t droppedCount = 0; ///< triangles with the corners and the material of one before
    std::string fault{};          ///< in words; empty: none
};

struct SceneSummary {
    std::string file;
    std::vector<std::string> inputFiles; ///< all that were read, each once
    std::uint64_t contentHash = 0;
    std::uint64_t triangleCount = 0; ///< of all meshes, at all places
    std::size_t sphereCount = 0;
    std::optional<Bounds> bounds; ///< none: there is nothing
    glm::dvec3 origin{0.0};       ///< what coordinates are read relative to
    Camera camera;
    std::vector<Light> lights;
    std::vector<ProfileSummary> profiles; ///< of lights
    std::optional<EnvironmentSummary> environment;
    glm::vec3 background{0.0f}; ///< without an environment
    std::vector<MaterialSummary> materials;
    std::vector<std::pair<std::string_view, std::size_t>> shapes; ///< type and number, by type
    Arrangement arrangement;                                      ///< of instances
    std::optional<GltfOutline> outline;
    std::vector<NodeSummary> nodes;
    std::vector<MeshReport> meshes;
    RenderSettings settings;
    std::optional<TreeSummary> tree; ///< none: there are only a few spheres
    std::size_t nodeBytes = 0;       ///< and so on: packed
    std::size_t triangleBytes = 0;
    std::size_t normalBytes = 0;
    std::size_t sceneBytes = 0;
    double loadSeconds = 0.0;
    double buildSeconds = 0.0;
};

/// The source of the scene was kept.
[[nodiscard]] SceneSummary summariseScene(const PreparedScene &prepared);

} // namespace hyalite::core
