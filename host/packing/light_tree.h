// The light tree: what shaders/lights/light_tree.glsl chooses emitters by.
#pragma once

#include "host/packing/packed_scene.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::core {

/// An emitter as the tree sees it.
struct TreeLight {
    glm::vec3 lower{0.0f}; ///< of a box around it
    glm::vec3 upper{0.0f};
    glm::vec3 axis{0.0f, 1.0f, 0.0f};
    float cosineNormals = -1.0f; ///< its normals are within this angle of the axis; -1: anywhere
    float cosineEmission = 0.0f; ///< light leaves within this angle of a normal
    float intensity = 0.0f;      ///< > 0: radiant intensity along a normal, relative to that of all lights
    bool isTwoSided = false;     ///< along the opposites of normals, too
    std::uint32_t emitter = 0;   ///< index of its record
};

struct LightTree {
    std::vector<layout::LightNode> nodes;
    /// Of each light, by its index in the input: layout::EmitterRecord::cumulative.
    std::vector<std::uint32_t> turns;
};

/// Builds the tree over at least two lights, on all threads; it depends on the lights only. Splits are those of the
/// lowest cost between 12 bins along the longest axis, by intensity, size and bounds on orientation. Conty and Kulla,
/// "Importance Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018, section 3.1; the measure of a cone is
/// an approximation.
[[nodiscard]] LightTree buildLightTree(std::span<const TreeLight> lights);

} // namespace hyalite::core
