// A counter that charges the work of each ray, and counts what shading does (host/film/work_ledger.h).
#pragma once

#include "host/film/work_ledger.h"
#include "host/reference/scene_view.h"

namespace hyalite::core::reference {

struct LedgerCounter {
    WorkLedger ledger;
    glm::vec3 sample{0.0f}; ///< tests by stage since the last reset

    void visitNode(const layout::NodePair &node) {
        ray_.boxes += (node.left != layout::noNode ? 1u : 0u) + (node.right != layout::noNode ? 1u : 0u);
    }
    void waitSubtrees(std::size_t) {}
    void testTriangle() { ++ray_.triangles; }

    /// A ray along the path has met the primitive, or layout::noPrimitive. What a path tests before its first ray, to
    /// learn in which glass it begins, is part of that one.
    template <class Real>
    void arrive(const SceneView<Real> &scene, std::uint32_t depth, std::uint32_t primitive,
                std::uint32_t materialIndex) {
        const bool isMet = primitive != layout::noPrimitive;
        object_ = isMet ? numberOf(scene, layout::viewObject, primitive, materialIndex) : 0;
        material_ = isMet ? numberOf(scene, layout::viewMaterial, primitive, materialIndex) : 0;
        charge(depth == 1 ? PathStage::Primary : PathStage::Further);
    }
    void lookAtLight() { ++ledger.shading.lightSamples; }
    /// A surface has been shaded, and a direction sampled of this lobe.
    void scatter(Lobe lobe) { ++ledger.shading.lobes[static_cast<std::size_t>(lobe)]; }
    /// Where a view of the scene counts what it reads. The counter stays where it is as long as the view.
    [[nodiscard]] ShadingCounts *readsOf() { return &ledger.shading; }

    /// A shadow ray of the surface where the path arrived last has been followed.
    void followShadowRay() { charge(PathStage::Shadow); }

  private:
    void charge(PathStage stage) {
        ray_.rays = 1;
        ledger.charge(stage, object_, material_, ray_);
        sample[static_cast<glm::length_t>(stage)] += static_cast<float>(ray_.tests());
        ray_ = {};
    }

    ChargedWork ray_; ///< since the last charge
    std::uint32_t object_ = 0;
    std::uint32_t material_ = 0;
};

} // namespace hyalite::core::reference
