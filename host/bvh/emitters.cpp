#include "host/bvh/emitters.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <utility>

namespace hyalite {

namespace {

double mean(const glm::dvec3 &colour) { return (colour.x + colour.y + colour.z) / 3.0; }

/// Power that leaves a unit of area: a diffuse emitter of radiance L sends out pi L.
double exitance(const layout::MaterialRecord &material) {
    return std::numbers::pi * mean(material.emission) * (material.isTwoSided != 0 ? 2.0 : 1.0);
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
    emitter.isTwoSided = material.isTwoSided;
    return emitter;
}

/// Triangle records in the order of the input.
std::vector<std::uint32_t> inInputOrder(const std::vector<layout::TriangleRecord> &triangles) {
    std::vector<std::uint32_t> records(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i)
        records[triangles[i].primitiveId - layout::firstTriangleId] = static_cast<std::uint32_t>(i);
    return records;
}

} // namespace

void packEmitters(const Scene &scene, PackedScene &packed) {
    std::vector<std::pair<layout::EmitterRecord, double>> found; // with power and area
    std::vector<double> areas;
    const auto add = [&](const layout::EmitterRecord &emitter, double power, double area) {
        if (power > 0.0) {
            found.emplace_back(emitter, power);
            areas.push_back(area);
        }
    };
    for (std::size_t i = 0; i < packed.lights.size(); ++i) {
        layout::EmitterRecord emitter{};
        emitter.kind = layout::emitterPoint;
        emitter.position = packed.lights[i].position;
        emitter.emission = packed.lights[i].intensity;
        add(emitter, mean(scene.lights[i].power), 0.0);
    }
    for (std::size_t i = 0; i < packed.spheres.size(); ++i) {
        const layout::SphereRecord &sphere = packed.spheres[i];
        const layout::MaterialRecord &material = packed.materials[sphere.materialIndex];
        const double area = 4.0 * std::numbers::pi * sphere.radius * sphere.radius;
        add(surfaceEmitter(layout::emitterSphere, i, material), exitance(material) * area, area);
    }
    if (packed.hasEmission)
        for (const std::uint32_t record : inInputOrder(packed.triangles)) {
            const layout::TriangleRecord &triangle = packed.triangles[record];
            const layout::MaterialRecord &material = packed.materials[triangle.materialIndex];
            const double area = areaOf(triangle);
            add(surfaceEmitter(layout::emitterTriangle, record, material), exitance(material) * area, area);
        }

    double total = 0.0;
    for (const auto &[emitter, power] : found)
        total += power;
    constexpr double all = 4294967296.0; // numbers of 32 bits
    double powerBefore = 0.0;
    double numbersBefore = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        auto &[emitter, power] = found[i];
        powerBefore += power;
        const double numbers = i + 1 == found.size() ? all : std::floor(powerBefore / total * all);
        if (numbers <= numbersBefore)
            continue; // chosen less than once in 2^32
        emitter.cumulative = static_cast<std::uint32_t>(std::fmin(numbers, all - 1.0));
        emitter.probability = static_cast<float>((numbers - numbersBefore) / all);
        emitter.density =
            areas[i] > 0.0 ? static_cast<float>((numbers - numbersBefore) / all / areas[i]) : 0.0f;
        numbersBefore = numbers;
        packed.emitters.push_back(emitter);
    }
    for (layout::MaterialRecord &material : packed.materials)
        material.emitterDensity = total > 0.0 ? static_cast<float>(exitance(material) / total) : 0.0f;
}

} // namespace hyalite
