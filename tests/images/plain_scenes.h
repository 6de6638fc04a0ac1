// Small scenes in which the renderers are compared with the plain path tracer.
#pragma once

#include "host/scene/scene.h"
#include "tests/fixtures/test_scene.h"

#include <array>
#include <vector>

namespace hyalite::core::testing {

/// For the path integrator, with nothing in it, seen along -z from (0, 0, 4): a 16 x 16 image.
[[nodiscard]] TestScene emptyScene(int maxDepth, int samplesPerPixel = 512);

/// A dim room with a warm window and a cold one, of few pixels.
[[nodiscard]] Environment studioEnvironment(double rotateDegrees = 0.0);

/// The material's index.
std::uint32_t addMaterial(Scene &scene, const Material &material);

void addBall(Scene &scene, const glm::dvec3 &centre, double radius, const Material &material,
             bool isInward = false);

/// A parallelogram of two triangles that faces the side from which its corners go counter-clockwise: corner, corner +
/// u, corner + u + v, corner + v. Its texture coordinates are 0 at the corner and grow to 1 along u and v.
TriangleMesh &addQuad(Scene &scene, const glm::vec3 &corner, const glm::vec3 &u, const glm::vec3 &v,
                      const Material &material);

[[nodiscard]] Material diffuse(const glm::vec3 &albedo);
[[nodiscard]] Material lamp(const glm::vec3 &emission);

/// An image of 8-bit levels, as red, green, blue and alpha, row by row from the top.
[[nodiscard]] Texture levelTexture(int width, int height,
                                   const std::vector<std::array<std::uint32_t, 4>> &pixels);

/// Gives the material the texture in this slot, of which it shows `scale` repetitions from `offset` on.
void wear(Scene &scene, Material &material, std::uint32_t slot, const Texture &texture,
          glm::vec2 scale = glm::vec2(1.0f), glm::vec2 offset = glm::vec2(0.0f));

} // namespace hyalite::core::testing
