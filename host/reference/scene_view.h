// The scene that leaf functions read.
#pragma once

#include "host/film/shading_counts.h"
#include "host/leaves/leaves.h"
#include "host/packing/packed_scene.h"

#include <array>
#include <bit>
#include <vector>

namespace hyalite::core::leaves {

/// The scene as leaf functions read it: what kernels have as specialization constants, uniforms and buffers, by the
/// same names. The packed scene outlives it.
template <class Real> struct SceneView {
    SceneView(const PackedScene &packedScene, const RenderSettings &settings,
              ShadingCounts *readsOfScene = nullptr)
        : SceneView(packedScene, frameOf(packedScene, settings), samplerOf(settings)) {
        reads = readsOfScene;
    }
    /// `samplerKind` is one of layout::sampler...
    explicit SceneView(const PackedScene &packedScene, uint samplerKindOfRender = layout::samplerSobol)
        : SceneView(packedScene, packedScene.frame, samplerKindOfRender) {}

    SceneView(const PackedScene &packedScene, const layout::FrameRecord &frameOfRender,
              uint samplerKindOfRender)
        : packed(packedScene), frame(frameOfRender), samplerKind(samplerKindOfRender),
          scattering(packedScene.scattering), texturing(packedScene.texturing), anyHit(packedScene.anyHit),
          lighting(packedScene.lighting), camera(packedScene.camera),
          emitterCount(static_cast<uint>(packedScene.emitters.size())),
          infiniteEmitterCount(packedScene.infiniteEmitterCount),
          placeCount(static_cast<uint>(packedScene.places.size())),
          sphereCount(static_cast<uint>(packedScene.loopSpheres.size())),
          treeSpheres(packedScene.treeSpheres), hasTriangles(packedScene.hasTriangles),
          hasNormals(packedScene.hasNormals), hasInstances(!packedScene.instances.empty()),
          hasEmission(packedScene.hasEmission), hasLightTree(!packedScene.lightNodes.empty()) {
        for (const SphereRecord<Real> sphere : packedScene.loopSpheres)
            sphereShapes.push_back(makeSphereShape<Real>(sphere.centre, sphere.radius));
    }

#define HYALITE_FETCH(number, value, name, Record, fetch)                                                    \
    [[nodiscard]] Record<Real> fetch(uint index) const {                                                     \
        countRead<layout::number>();                                                                         \
        return packed.name[index];                                                                           \
    }
    HYALITE_SCENE_ARRAYS(HYALITE_FETCH)
#undef HYALITE_FETCH
    /// Word `index` of the textures.
    [[nodiscard]] uint fetchTextureWord(uint index) const {
        countRead<layout::bindingTextures>();
        return std::bit_cast<std::array<uint, 4>>(packed.textures[index / 4])[index % 4];
    }

    template <uint binding> void countRead() const {
        if constexpr (binding == layout::bindingTextures) {
            if (reads != nullptr)
                ++reads->textureReads;
        } else if constexpr (binding == layout::bindingLightNodes) {
            if (reads != nullptr)
                ++reads->lightNodesRead;
        }
    }

    const PackedScene &packed;
    ShadingCounts *reads = nullptr; ///< counts them, unless null; of one thread
    FrameRecord<Real> frame;
    uint samplerKind;
    uint scattering;
    uint texturing;
    uint anyHit;
    uint lighting;
    uint camera;
    uint emitterCount;
    uint infiniteEmitterCount;
    uint placeCount;
    uint sphereCount; ///< outside the tree
    uint treeSpheres;
    bool hasTriangles;
    bool hasNormals;
    bool hasInstances;
    bool hasEmission;
    bool hasLightTree;
    std::vector<SphereShape<Real>> sphereShapes; ///< of spheres outside the tree, for the loops over them
};

} // namespace hyalite::core::leaves

namespace hyalite::core::reference {
using namespace leaves;
}
