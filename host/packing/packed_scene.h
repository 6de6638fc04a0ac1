// The scene as both renderers read it: exactly the bytes of shaders/layout/layout.h.
#pragma once

#include "host/base/unset_vector.h"
#include "host/bvh/bvh.h"
#include "host/scene/scene.h"
#include "host/scene/scene_names.h"
#include "host/scene/settings.h"
#include "shaders/layout/buffers.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace hyalite::core {

/// The bytes of an array of records.
struct SceneArray {
    std::uint32_t binding;
    std::string_view name; ///< in plural: "materials"
    std::span<const std::byte> bytes;
};

/// A tree among the node pairs.
struct PackedTree {
    std::uint32_t firstPair = 0;   ///< its root; its other pairs follow
    std::uint32_t firstRecord = 0; ///< of its triangles
    Box box;                       ///< around all of it
};

/// Scene arrays that are large, and filled by several threads.
template <class Record>
inline constexpr bool isFilledByThreads =
    std::is_same_v<Record, layout::TriangleRecord> || std::is_same_v<Record, layout::NormalRecord> ||
    std::is_same_v<Record, layout::TextureRow>;

template <class Record>
using RecordVector = std::conditional_t<isFilledByThreads<Record>, UnsetVector<Record>, std::vector<Record>>;

struct PackedScene {
    /// Given by packScene, and no other time to another scene: scenes of one serial number differ at most in `frame`
    /// and `camera`, so that a device that holds one holds the others. 0: unknown.
    std::uint64_t serial = 0;
    std::uint64_t geometry = 0;          ///< geometryHash() of the scene before its instances were arranged
    layout::FrameRecord frame{};         ///< without what the settings of a render decide: frameOf() adds it
    UnsetVector<layout::NodePair> nodes; ///< never empty
    /// The scene's own tree, then those of the prototypes. The triangle records are in the same order.
    std::vector<PackedTree> trees;
    std::vector<layout::SphereRecord> loopSpheres; ///< those outside the tree
    /// All triangles, if they are few, in a closed room, with nothing else in the tree.
    std::vector<layout::TrianglePair> trianglePairs;
    int treeDepth = 0;                      ///< subtrees that can wait on a traversal stack
    SceneNames names;                       ///< of the numbers of places and materials
    std::vector<std::string> lightGroups{}; ///< names, by their numbers

    // The scene arrays, by the names that shaders/layout/buffers.h gives them.
#define HYALITE_MEMBER(number, value, name, Record, fetch) RecordVector<layout::Record> name;
    HYALITE_SCENE_ARRAYS(HYALITE_MEMBER)
#undef HYALITE_MEMBER

    // Features of the scene: kernels leave out what it does not use.
    bool hasTriangles = false; ///< in the tree: those of instances, and spheres, included
    bool hasNormals = false;   ///< corners of triangles have normals
    std::uint32_t treeSpheres = layout::treeHasTriangles; ///< layout::treeHas...
    bool hasPairs = false; ///< leaves of skip lists are told apart by whether they are pairs of triangles
    bool hasSpecular = false;
    bool hasDielectric = false;
    bool hasEmission = false;
    std::uint32_t infiniteEmitterCount = 0; ///< outside the light tree, if there is one: the first emitters
    /// Bits of layout::scattersAt...: features of the path integrator that the materials need.
    std::uint32_t scattering = 0;
    std::uint32_t lighting = 0;  ///< bits of layout::lightsBy...
    std::uint32_t texturing = 0; ///< bits of layout::textures...
    std::uint32_t anyHit = 0;    ///< bits of layout::anyHit...
    std::uint32_t camera = layout::cameraPinhole;

    /// How many of `trianglePairs` rays of a kernel over skip lists test in turn; 0: they go through the tree. Where
    /// light comes from within, paths are long and their rays go everywhere. The tree takes less time for others.
    [[nodiscard]] std::size_t listedPairs(Integrator integrator) const {
        return rowOf(integrator).aimsAtEmitters ? trianglePairs.size() : 0;
    }
    /// Whether such rays go through a tree.
    [[nodiscard]] bool needsTree(Integrator integrator) const {
        return hasTriangles && listedPairs(integrator) == 0;
    }

    /// A view of each scene array, in the order of the bindings.
    [[nodiscard]] std::array<SceneArray, layout::sceneArrayCount> arrays() const;

    /// Bytes of all that a device has to hold of the scene.
    [[nodiscard]] std::size_t sizeBytes() const;

    /// Hash of the visible scene: camera and image size, background, lights, materials and primitives. It does not
    /// depend on the tree, on which instances became meshes, the seed or the maximum depth, and is the same on every
    /// machine. `ofArrays` is arraysHash().
    [[nodiscard]] std::uint64_t contentHash(std::uint64_t ofArrays) const;
    [[nodiscard]] std::uint64_t contentHash() const { return contentHash(arraysHash()); }

    /// Of all but `frame`, `camera`, names and their numbers: of what scenes of one serial number have in common.
    [[nodiscard]] std::uint64_t arraysHash() const;

    /// Of names and their numbers.
    [[nodiscard]] std::uint64_t namesHash() const;

    /// The names of the numbers that a view shows, from 1 on; none for other views. Places have those of their objects.
    /// Throws Error{LimitExceeded} where there are more numbers than floats can tell apart, layout::maxNumber.
    [[nodiscard]] std::vector<std::string> namesOf(Integrator view) const;
};

/// The frame of a render of the scene.
[[nodiscard]] layout::FrameRecord frameOf(const PackedScene &scene, const RenderSettings &settings);

/// The sampler of the kernels, layout::sampler...
[[nodiscard]] std::uint32_t samplerOf(const RenderSettings &settings);

/// Maximum size of decoded 8-bit textures, at 16 bytes a pixel.
inline constexpr std::size_t maxDecodedBytes = std::size_t{64} << 20;

/// Choices about the packed bytes. Images by light choices agree in their mean, and do not depend on the rest.
struct PackOptions {
    LightChoice lightChoice = LightChoice::Auto;
    /// 8-bit textures are decoded to floats if all of them then take at most so many bytes: a lookup reads 4 rows in
    /// place of 16.
    std::size_t maxDecoded = maxDecodedBytes;
    std::optional<std::uint64_t> geometry{}; ///< PackedScene::geometry; without it, the scene's as it is
};

/// `scene` is valid, and `bvh` was built from its triangles.
[[nodiscard]] PackedScene packScene(const Scene &scene, const Bvh &bvh, const PackOptions &options = {});

/// Moves the camera of a packed scene: `scene` is what it was packed from, except for its camera.
void packCamera(const Scene &scene, PackedScene &packed);

/// Replaces the lights of a packed scene, which becomes another one, with a serial number of its own: `scene` is what
/// it was packed from, except for its camera and its lights. Its meshes and textures are not read.
void packLights(const Scene &scene, LightChoice choice, PackedScene &packed);

} // namespace hyalite::core
