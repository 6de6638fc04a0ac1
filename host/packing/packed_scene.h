// The scene as both renderers read it: exactly the bytes of shaders/layout/layout.h.
#pragma once

#include "host/bvh/bvh.h"
#include "host/scene/scene.h"
#include "shaders/layout/layout.h"

namespace hyalite {

struct PackedScene {
    layout::FrameRecord frame{};
    std::vector<layout::SphereRecord> spheres;
    std::vector<layout::LightRecord> lights;
    std::vector<layout::MaterialRecord> materials; ///< what light passes first, by falling priority
    std::vector<layout::EmitterRecord> emitters;   ///< for the path integrator only
    std::vector<layout::LookupRow> texels;         ///< what is looked up by index
    std::vector<layout::TextureRow> textures;      ///< see layout.h; empty where nothing reads them
    std::vector<layout::NodePair> nodes;           ///< never empty
    std::vector<layout::TriangleRecord> triangles; ///< leaf by leaf
    std::vector<layout::NormalRecord> normals;     ///< one for each triangle record
    int treeDepth = 0;

    // Features that some kernels can leave out.
    bool hasTriangles = false;
    bool hasSpecular = false;
    bool hasDielectric = false;
    bool hasEmission = false;
    /// Bits of layout::scattersAt...: what the materials need of the path integrator.
    std::uint32_t scattering = 0;
    std::uint32_t lighting = 0;  ///< bits of layout::lightsBy...
    std::uint32_t texturing = 0; ///< bits of layout::textures...
    std::uint32_t camera = layout::cameraPinhole;

    /// Of all arrays together: what a device has to hold of the scene.
    [[nodiscard]] std::size_t sizeBytes() const;

    /// A hash of what there is to see: camera and image size, background, lights, materials and primitives. It does not
    /// depend on the tree, nor on the seed and the depth of paths, and is the same on every machine.
    [[nodiscard]] std::uint64_t contentHash() const;
};

/// Where the samples of a pixel lie, as kernels call it: layout::sampler...
[[nodiscard]] std::uint32_t samplerOf(const RenderSettings &settings);

/// What a kernel shows of the first hit for an integrator that is a view; 0 for others.
[[nodiscard]] std::uint32_t viewOf(Integrator integrator);

/// As much as textures of 8 bits may take when they are decoded: 16 bytes a pixel.
inline constexpr std::size_t maxDecodedBytes = std::size_t{64} << 20;

/// `scene` is valid, and `bvh` was built from its triangles. Textures of 8 bits are decoded if all together take no more
/// than `maxDecoded` bytes so: they look the same, and a lookup reads 4 rows in place of 16.
[[nodiscard]] PackedScene packScene(const Scene &scene, const Bvh &bvh,
                                    std::size_t maxDecoded = maxDecodedBytes);

} // namespace hyalite
