// The tree of nodes of a glTF file (glTF 2.0, section 3.5), and where its nodes are.
#pragma once

#include "host/import/gltf/document.h"

#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hyalite::core::gltf {

/// A rotation as x, y, z, w, of any length but 0; one that is not of unit length is told as normalised.
[[nodiscard]] glm::dvec4 readQuaternion(const Document &document, const JsonNode &node);
[[nodiscard]] glm::dmat3 rotationOf(const glm::dvec4 &quaternion);

/// A translation of a rotation of a scale.
struct Trs {
    glm::dvec3 translation{0.0};
    glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0}; ///< a quaternion x, y, z, w of any length but 0
    glm::dvec3 scale{1.0};

    [[nodiscard]] glm::dmat4x3 toMatrix() const;
};

/// Where a node is, relative to its parent. Animations change it.
struct Pose {
    std::variant<Trs, glm::dmat4x3> place{};
    std::vector<double> weights{}; ///< of the morph targets of its mesh; none: those of the mesh

    [[nodiscard]] glm::dmat4x3 toParent() const;
};

/// The poses that the file gives its nodes, in the order of /nodes.
[[nodiscard]] std::vector<Pose> readPoses(const Document &document);

/// The scene that is shown: `choice` is a name or an index; empty: the file's default one, or the first. Nothing where
/// the file has no scenes. Throws Error{Usage} for a choice that is none.
[[nodiscard]] std::optional<JsonObject> chosenScene(const Document &document, const std::string &choice);

/// The hierarchy of nodes.
class NodeTree {
  public:
    /// Memory of a node with its JSON, its pose, its map to the world and its name in the scene.
    static constexpr std::size_t bytesEach = 416;

    /// Throws Error{BadInput} for a node with two parents, and for one that is its own ancestor.
    explicit NodeTree(const Document &document);

    /// Of all nodes, from their own space to the world.
    [[nodiscard]] std::vector<glm::dmat4x3> toWorld(const std::vector<Pose> &poses) const;

    /// The marked nodes and all below them.
    [[nodiscard]] std::vector<bool> below(std::vector<bool> marked) const;

    /// None for a root.
    [[nodiscard]] std::optional<std::size_t> parentOf(std::size_t node) const;

    /// How many ancestors a node has.
    [[nodiscard]] std::size_t depthOf(std::size_t node) const;

    /// The nodes of a scene, parents before their children; all nodes without one.
    [[nodiscard]] std::vector<std::size_t> nodesOfScene(const Document &document,
                                                        const std::optional<JsonObject> &scene) const;

  private:
    /// Nodes are counted by 32 bits: a file has at most 512 MiB, and a million of them should take little memory.
    using Index = std::uint32_t;
    static constexpr Index noParent = ~Index{0};

    [[nodiscard]] std::span<const Index> childrenOf(std::size_t node) const {
        return std::span(children_).subspan(firstChildren_[node],
                                            firstChildren_[node + 1] - firstChildren_[node]);
    }
    [[nodiscard]] std::vector<Index> descend(const std::vector<Index> &roots) const;

    std::vector<Index> firstChildren_; ///< where those of each node begin in `children_`; one more is the end
    std::vector<Index> children_;
    std::vector<Index> parents_;
    std::vector<Index> all_; ///< parents before their children
};

/// The index of the element of `array` that a user means: by its member "name", or by its index in digits. Throws
/// Error{Usage} for a choice that is none, with the names that there are; `what` is for the message: "scene".
[[nodiscard]] std::size_t chosenElement(const Document &document, std::string_view array,
                                        std::string_view what, const std::string &choice);

} // namespace hyalite::core::gltf
