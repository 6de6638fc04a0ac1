// Light that a surface is aimed at: lights without size, spheres and triangles that emit, an image around. Twin:
// shaders/lights/emitters.glsl.
#pragma once

#include "host/packing/packed_scene.h"
#include "host/reference/environment.h"
#include "host/reference/lights.h"
#include "host/reference/random.h"
#include "host/reference/sampling.h"
#include "host/reference/sphere.h"
#include "host/reference/surface.h"
#include "host/reference/texture.h"

#include <algorithm>

namespace hyalite::reference {

template <class Real> struct LightSample {
    Vec3<Real> direction; ///< unit length, from the surface to the light
    Real distance = 0;
    Vec3<Real> radiance{
        Real(0)};     ///< divided by the density; of a point light the intensity / squared distance /
                      ///< probability
    Real density = 0; ///< per solid angle, the choice of the emitter included; 0: a light without size
    std::uint32_t target = layout::noPrimitive; ///< the primitive at its end
};

/// Per solid angle, of a point chosen with `areaDensity` per unit of area; `cosine` > 0 is that at the light.
template <class Real> [[nodiscard]] Real solidAngleDensity(Real areaDensity, Real distance, Real cosine) {
    return areaDensity * (distance * distance) / cosine;
}

/// Seen from further away than this, in squared radii, a sphere is sampled by the cone of directions to it, else by area.
template <class Real> inline constexpr Real leastConeDistance = Real(1.0001);

/// The density with which a sphere is aimed at from `position` in a direction that meets it after `distance`; 0 where
/// that point is never chosen. `outward` is the sphere's outward normal there.
template <class Real>
[[nodiscard]] Real sphereLightDensity(const Vec3<Real> &position, const Vec3<Real> &direction, Real distance,
                                      const Vec3<Real> &centre, Real radius, const Vec3<Real> &outward,
                                      Real areaDensity) {
    const Real squaredRadius = radius * radius;
    const Vec3<Real> toCentre = centre - position;
    const Real squaredDistance = dotProduct(toCentre, toCentre);
    if (squaredDistance > squaredRadius * leastConeDistance<Real>)
        return areaDensity * (Real(12.566370614359173) * squaredRadius) *
               pdfCone(coneHeight(squaredRadius, squaredDistance));
    const Real cosine = dotProduct(direction, outward);
    return cosine > 0 ? solidAngleDensity(areaDensity, distance, cosine) : Real(0);
}

template <class Real>
[[nodiscard]] LightSample<Real> samplePoint(const layout::EmitterRecord &emitter,
                                            const Vec3<Real> &position) {
    const Vec3<Real> toLight = Vec3<Real>(emitter.position) - position;
    const Real distance = vectorLength(toLight);
    const Real share = distance * distance * static_cast<Real>(emitter.probability);
    return {toLight * (Real(1) / distance), distance, Vec3<Real>(emitter.emission) * (Real(1) / share),
            Real(0), layout::noPrimitive};
}

template <class Real>
[[nodiscard]] LightSample<Real> sampleSpot(const layout::EmitterRecord &emitter, const Vec3<Real> &position) {
    LightSample<Real> light = samplePoint(emitter, position);
    light.radiance *= spotFalloff(light.direction, Vec3<Real>(emitter.axis),
                                  static_cast<Real>(emitter.cosineOuter), static_cast<Real>(emitter.density));
    return light;
}

template <class Real>
[[nodiscard]] LightSample<Real> sampleDirectional(const layout::EmitterRecord &emitter) {
    return {-Vec3<Real>(emitter.axis), unboundedDistance<Real>,
            Vec3<Real>(emitter.emission) * (Real(1) / static_cast<Real>(emitter.probability)), Real(0),
            layout::noPrimitive};
}

template <class Real>
[[nodiscard]] LightSample<Real>
sampleSurroundings(const PackedScene &scene, const layout::EmitterRecord &emitter, const glm::uvec2 &bits) {
    const EnvironmentLight<Real> found = EnvironmentMap<Real>(scene).sample(bits);
    const Real density = found.density * static_cast<Real>(emitter.probability);
    return {found.direction, unboundedDistance<Real>,
            density > 0 ? found.radiance * (Real(1) / density) : Vec3<Real>(Real(0)), density,
            layout::noPrimitive};
}

/// What a triangle sends out at the point with these weights, of what its whole material does.
template <class Real>
[[nodiscard]] Vec3<Real> triangleEmission(const PackedScene &scene, const Vec3<Real> &emission,
                                          const layout::TriangleRecord &triangle, std::uint32_t record,
                                          const Vec2<Real> &weights) {
    const std::uint32_t textures = scene.materials[triangle.materialIndex].textures;
    if (textures == 0)
        return emission;
    if (isCutAway(scene, triangle, record, weights.x, weights.y))
        return Vec3<Real>(Real(0));
    if (!hasTexture(scene.textures, textures, layout::slotEmission))
        return emission;
    return emission *
           lookUpTexture(scene.textures, textureRow(textures, layout::slotEmission),
                         triangleUv(fetchCoordinates<Real>(scene.textures, record), weights.x, weights.y));
}

/// What a sphere sends out at the point `outward` from its centre, likewise.
template <class Real>
[[nodiscard]] Vec3<Real> sphereEmission(const PackedScene &scene, const Vec3<Real> &emission,
                                        const layout::SphereRecord &sphere, const Vec3<Real> &outward) {
    const std::uint32_t textures = scene.materials[materialIndexOf(sphere)].textures;
    if (textures == 0 || !hasTexture(scene.textures, textures, layout::slotEmission))
        return emission;
    return emission *
           lookUpTexture(scene.textures, textureRow(textures, layout::slotEmission), sphereUv(outward));
}

template <class Real>
[[nodiscard]] LightSample<Real> sampleTriangleLight(const PackedScene &scene,
                                                    const layout::EmitterRecord &emitter,
                                                    const Vec3<Real> &position, const Vec2<Real> &u) {
    const layout::TriangleRecord &triangle = scene.triangles[emitter.record];
    const Vec2<Real> weights = sampleTriangle(u);
    const Surface<Real> surface =
        triangleSurface(triangle, scene.normals[emitter.record], weights.x, weights.y);
    const Vec3<Real> toLight = surface.position - position;
    const Real distance = vectorLength(toLight);
    const Vec3<Real> direction = toLight * (Real(1) / distance);
    const Real facing = -dotProduct(direction, surface.geometricNormal);
    const Real cosine = emitter.isTwoSided != 0 ? std::abs(facing) : facing;
    const Real density = solidAngleDensity(static_cast<Real>(emitter.density), distance, cosine);
    const bool isSeen = cosine > 0 && distance > 0;
    const Vec3<Real> emission =
        triangleEmission(scene, Vec3<Real>(emitter.emission), triangle, emitter.record, weights);
    return {direction, distance, isSeen ? emission * (Real(1) / density) : Vec3<Real>(Real(0)), density,
            triangle.primitiveId};
}

template <class Real>
[[nodiscard]] LightSample<Real> sampleSphereLight(const PackedScene &scene,
                                                  const layout::EmitterRecord &emitter,
                                                  const Vec3<Real> &position, const Vec2<Real> &u) {
    const layout::SphereRecord &sphere = scene.spheres[emitter.record];
    const Vec3<Real> centre(sphere.centre);
    const Real radius = static_cast<Real>(sphere.radius);
    const Real squaredRadius = radius * radius;
    const Vec3<Real> toCentre = centre - position;
    const Real squaredDistance = dotProduct(toCentre, toCentre);
    LightSample<Real> light;
    bool isSeen;
    if (squaredDistance > squaredRadius * leastConeDistance<Real>) {
        const Real centreDistance = std::sqrt(squaredDistance);
        const Real height = coneHeight(squaredRadius, squaredDistance);
        light.direction = sampleCone<Real>(toCentre * (Real(1) / centreDistance), height, u);
        const Real meeting = intersectSphere(position, light.direction, centre, radius, false);
        light.distance = meeting > 0 ? meeting : centreDistance; // past the rim by rounding
        light.density = static_cast<Real>(emitter.probability) * pdfCone(height);
        isSeen = normalSignOf(sphere) > 0.0f || emitter.isTwoSided != 0;
    } else {
        const Vec3<Real> outward = sampleSphere(u);
        const Vec3<Real> toLight = toCentre + outward * radius;
        light.distance = vectorLength(toLight);
        light.direction = toLight * (Real(1) / light.distance);
        const Real cosine = dotProduct(light.direction, outward);
        light.density = solidAngleDensity(static_cast<Real>(emitter.density), light.distance, cosine);
        isSeen = cosine > 0 && light.distance > 0 && (normalSignOf(sphere) < 0.0f || emitter.isTwoSided != 0);
    }
    if (isSeen)
        light.radiance = sphereEmission(scene, Vec3<Real>(emitter.emission), sphere,
                                        position + light.direction * light.distance - centre) *
                         (Real(1) / light.density);
    light.target = emitter.record;
    return light;
}

/// Which emitter a number of 32 bits chooses; 0 where there is none.
[[nodiscard]] inline std::uint32_t chooseEmitter(const std::vector<layout::EmitterRecord> &emitters,
                                                 std::uint32_t bits) {
    if (emitters.empty())
        return 0;
    const auto chosen =
        std::partition_point(emitters.begin(), emitters.end() - 1, [&](const layout::EmitterRecord &emitter) {
            return emitter.cumulative <= bits;
        });
    return static_cast<std::uint32_t>(chosen - emitters.begin());
}

/// A point of an emitter as seen from `position`, chosen by two numbers of 32 bits.
template <class Real>
[[nodiscard]] LightSample<Real> sampleEmitter(const PackedScene &scene, std::uint32_t index,
                                              const Vec3<Real> &position, const glm::uvec2 &bits) {
    if (scene.emitters.empty())
        return {};
    const layout::EmitterRecord &emitter = scene.emitters[index];
    if (emitter.kind == layout::emitterPoint)
        return samplePoint(emitter, position);
    if (emitter.kind == layout::emitterSpot)
        return sampleSpot(emitter, position);
    if (emitter.kind == layout::emitterDirectional)
        return sampleDirectional<Real>(emitter);
    if (emitter.kind == layout::emitterEnvironment)
        return sampleSurroundings<Real>(scene, emitter, bits);
    const Vec2<Real> u = unitReals<Real>(bits);
    if (emitter.kind == layout::emitterTriangle)
        return sampleTriangleLight(scene, emitter, position, u);
    return sampleSphereLight(scene, emitter, position, u);
}

} // namespace hyalite::reference
