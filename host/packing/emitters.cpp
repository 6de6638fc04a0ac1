#include "host/packing/emitters.h"

#include "host/packing/texture_rows.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyalite {

namespace {

double mean(const glm::dvec3 &colour) { return (colour.x + colour.y + colour.z) / 3.0; }

/// Emitted power per unit of area, averaged over channels and texture: a diffuse emitter of radiance L emits pi L per
/// side.
double exitance(const PackedScene &packed, const layout::MaterialRecord &material) {
    if (material.emission == glm::vec3(0.0f))
        return 0.0;
    const glm::dvec3 radiance = glm::dvec3(material.emission) * meanEmissionFactor(packed, material);
    return std::numbers::pi * mean(radiance) * (isTwoSided(material) ? 2.0 : 1.0);
}

double areaOf(const layout::TriangleRecord &triangle) {
    const glm::dvec3 v0(triangle.v0);
    return 0.5 * glm::length(glm::cross(glm::dvec3(triangle.v1) - v0, glm::dvec3(triangle.v2) - v0));
}

layout::EmitterRecord surfaceEmitter(std::uint32_t kind, std::size_t record,
                                     const layout::MaterialRecord &material) {
    layout::EmitterRecord emitter{};
    emitter.kind = kind;
    emitter.record = static_cast<std::uint32_t>(record);
    emitter.emission = material.emission;
    emitter.isTwoSided = isTwoSided(material) ? 1u : 0u;
    return emitter;
}

struct Candidate {
    layout::EmitterRecord emitter;
    double power; ///< 0 for infinitely distant emitters
    double area;  ///< 0 for emitters without area
    bool isInfinite;
};

layout::EmitterRecord lightEmitter(const layout::LightRecord &light) {
    layout::EmitterRecord emitter{};
    emitter.kind = emitterKindOf(light);
    emitter.position = light.position;
    emitter.emission = light.intensity;
    emitter.axis = light.axis;
    emitter.cosineOuter = light.cosineOuter;
    if (light.kind == layout::lightSpot)
        emitter.pdf = light.falloffScale;
    return emitter;
}

/// Fraction of all directions inside the cone of a spot.
double coneShare(const layout::EmitterRecord &spot) { return 0.5 * (1.0 - double{spot.cosineOuter}); }

/// Indices of the records of emitting triangles, in the order of the input. Instances do not emit.
std::vector<std::uint32_t> emittingTriangles(const PackedScene &packed,
                                             const std::vector<double> &exitances) {
    const std::vector<layout::TriangleRecord> &triangles = packed.triangles;
    std::vector<std::uint32_t> records;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        if ((triangles[i].flags & layout::triangleIsSphere) == 0 &&
            exitances[triangles[i].materialIndex] > 0.0)
            records.push_back(static_cast<std::uint32_t>(i));
    std::ranges::sort(records, {}, [&](std::uint32_t record) { return triangles[record].primitiveId; });
    return records;
}

} // namespace

std::uint32_t emitterKindOf(const layout::LightRecord &light) {
    return light.kind == layout::lightSpot          ? layout::emitterSpot
           : light.kind == layout::lightDirectional ? layout::emitterDirectional
                                                    : layout::emitterPoint;
}

void packEmitters(const Scene &scene, bool isLitAround, PackedScene &packed) {
    std::vector<double> exitances; // of each material
    for (const layout::MaterialRecord &material : packed.materials)
        exitances.push_back(exitance(packed, material));
    std::vector<Candidate> found;
    const auto add = [&](const layout::EmitterRecord &emitter, double power, double area) {
        if (power > 0.0)
            found.push_back({emitter, power, area, false});
    };
    for (std::size_t i = 0; i < packed.lights.size(); ++i) {
        const double power = mean(scene.lights[i].power);
        const layout::EmitterRecord emitter = lightEmitter(packed.lights[i]);
        if (emitter.kind != layout::emitterDirectional)
            add(emitter, power * (emitter.kind == layout::emitterSpot ? coneShare(emitter) : 1.0), 0.0);
        else if (power > 0.0)
            found.push_back({emitter, 0.0, 0.0, true});
    }
    for (std::size_t i = 0; i < packed.spheres.size(); ++i) {
        const layout::SphereRecord &sphere = packed.spheres[i];
        const layout::MaterialRecord &material = packed.materials[materialIndexOf(sphere)];
        const double area = 4.0 * std::numbers::pi * sphere.radius * sphere.radius;
        add(surfaceEmitter(layout::emitterSphere, i, material), exitances[materialIndexOf(sphere)] * area,
            area);
    }
    if (packed.hasEmission)
        for (const std::uint32_t record : emittingTriangles(packed, exitances)) {
            const layout::TriangleRecord &triangle = packed.triangles[record];
            const layout::MaterialRecord &material = packed.materials[triangle.materialIndex];
            const double area = areaOf(triangle);
            add(surfaceEmitter(layout::emitterTriangle, record, material),
                exitances[triangle.materialIndex] * area, area);
        }

    if (isLitAround) {
        layout::EmitterRecord emitter{};
        emitter.kind = layout::emitterEnvironment;
        found.push_back({emitter, 0.0, 0.0, true});
    }

    double finiteTotal = 0.0;
    for (const Candidate &candidate : found) {
        finiteTotal += candidate.power;
        packed.lighting |= 1u << candidate.emitter.kind;
    }
    // Infinitely distant emitters have no comparable power: each counts as much as all finite ones together.
    double total = finiteTotal;
    for (Candidate &candidate : found)
        if (candidate.isInfinite) {
            candidate.power = finiteTotal > 0.0 ? finiteTotal : 1.0;
            total += candidate.power;
        }
    constexpr double all = 4294967296.0; // number of 32-bit values
    double powerBefore = 0.0;
    double numbersBefore = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        layout::EmitterRecord &emitter = found[i].emitter;
        const double area = found[i].area;
        powerBefore += found[i].power;
        const double numbers = i + 1 == found.size() ? all : std::floor(powerBefore / total * all);
        if (numbers <= numbersBefore)
            continue; // probability below 2^-32
        emitter.cumulative = static_cast<std::uint32_t>(std::fmin(numbers, all - 1.0));
        emitter.probability = static_cast<float>((numbers - numbersBefore) / all);
        if (area > 0.0)
            emitter.pdf = static_cast<float>((numbers - numbersBefore) / all / area);
        if (emitter.kind == layout::emitterEnvironment)
            packed.frame.environmentProbability = emitter.probability;
        numbersBefore = numbers;
        packed.emitters.push_back(emitter);
    }
    for (std::size_t i = 0; i < packed.materials.size(); ++i)
        packed.materials[i].emitterPdf = total > 0.0 ? static_cast<float>(exitances[i] / total) : 0.0f;
}

} // namespace hyalite
