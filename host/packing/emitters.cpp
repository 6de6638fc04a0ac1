#include "host/packing/emitters.h"

#include "host/base/error.h"
#include "host/packing/light_profiles.h"
#include "host/packing/light_tree.h"
#include "host/packing/texture_rows.h"
#include "host/scene/light_groups.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

namespace hyalite::core {

namespace {

double mean(const glm::dvec3 &colour) { return (colour.x + colour.y + colour.z) / 3.0; }

/// Emitted power per unit of area, averaged over channels and texture: a diffuse emitter of radiance L emits pi L per
/// side.
double exitance(const PackedScene &packed, const layout::MaterialRecord &material) {
    if (material.emission == glm::vec3(0.0f))
        return 0.0;
    const glm::dvec3 radiance = glm::dvec3(material.emission) * meanEmissionFactor(packed, material);
    return std::numbers::pi * mean(radiance) * (emitsBehind(material) ? 2.0 : 1.0);
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
    emitter.sidesAndGroup = (emitsBehind(material) ? 1u : 0u) | material.lightGroup << 1u;
    return emitter;
}

struct Candidate {
    layout::EmitterRecord emitter;
    double power; ///< 0 for infinitely distant emitters
    double area;  ///< 0 for emitters without area
    bool isInfinite;
    ProfiledLight profiled{}; ///< of a light with a profile
};

layout::EmitterRecord lightEmitter(const layout::LightRecord &light, std::uint32_t group) {
    layout::EmitterRecord emitter{};
    emitter.sidesAndGroup = group << 1u;
    emitter.kind = emitterKindOf(light);
    emitter.position = light.position;
    emitter.emission = light.intensity;
    emitter.axis = light.axis;
    emitter.cosineOuter = light.cosineOuter;
    if (light.kind == layout::lightSpot || lightKindOf(light) == layout::lightProfiled)
        emitter.pdf = light.falloffScale;
    if (lightKindOf(light) == layout::lightProfiled)
        emitter.record = profileOf(light);
    return emitter;
}

/// Fraction of all directions inside a cone.
double coneShare(float cosine) { return 0.5 * (1.0 - double{cosine}); }

/// Indices of the records of emitting triangles, in the order of the input. Instances do not emit.
std::vector<std::uint32_t> emittingTriangles(const PackedScene &packed,
                                             const std::vector<double> &exitances) {
    const std::span<const layout::TriangleRecord> triangles = packed.triangles;
    std::vector<std::uint32_t> records;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        if ((triangles[i].flags & layout::triangleIsSphere) == 0 &&
            exitances[triangles[i].materialIndex] > 0.0)
            records.push_back(static_cast<std::uint32_t>(i));
    std::ranges::sort(records, {}, [&](std::uint32_t record) { return triangles[record].primitiveId; });
    return records;
}

/// Emitters are chosen with a probability in proportion to their power. Returns the power of all.
double chooseByPower(std::vector<Candidate> candidates, PackedScene &packed) {
    double finiteTotal = 0.0;
    for (const Candidate &candidate : candidates)
        finiteTotal += candidate.power;
    // Infinitely distant emitters have no comparable power: each counts as much as all finite ones together.
    double total = finiteTotal;
    for (Candidate &candidate : candidates)
        if (candidate.isInfinite) {
            candidate.power = finiteTotal > 0.0 ? finiteTotal : 1.0;
            total += candidate.power;
        }
    constexpr double all = 4294967296.0; // number of 32-bit values
    double powerBefore = 0.0;
    double numbersBefore = 0.0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        layout::EmitterRecord &emitter = candidates[i].emitter;
        const double area = candidates[i].area;
        powerBefore += candidates[i].power;
        const double numbers = i + 1 == candidates.size() ? all : std::floor(powerBefore / total * all);
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
    return total;
}

/// The side to which a triangle emits: that of its shading normals, as shaders/geometry/surface.glsl has it.
void setNormals(const PackedScene &packed, std::uint32_t record, TreeLight &light) {
    const layout::TriangleRecord &triangle = packed.triangles[record];
    const layout::NormalRecord &normals = packed.normals[record];
    const glm::dvec3 v0(triangle.v0);
    const glm::dvec3 normal =
        glm::normalize(glm::cross(glm::dvec3(triangle.v1) - v0, glm::dvec3(triangle.v2) - v0));
    bool isAbove = false;
    bool isBelow = false;
    for (const glm::vec3 &shading : {normals.n0, normals.n1, normals.n2}) {
        isAbove = isAbove || glm::dot(normal, glm::dvec3(shading)) > 0.0;
        isBelow = isBelow || glm::dot(normal, glm::dvec3(shading)) < 0.0;
    }
    light.axis = glm::vec3(isBelow && !isAbove ? -normal : normal);
    light.cosineNormals = 1.0f;
    light.isTwoSided = light.isTwoSided || (isAbove && isBelow);
}

/// `intensity` is set to the radiant intensity along a normal.
TreeLight treeLight(const Candidate &candidate, const PackedScene &packed, double &intensity) {
    const layout::EmitterRecord &emitter = candidate.emitter;
    TreeLight light;
    light.lower = emitter.position;
    light.upper = emitter.position;
    light.isTwoSided = isTwoSided(emitter);
    const double sides = light.isTwoSided ? 2.0 : 1.0;
    if (emitter.kind == layout::emitterTriangle) {
        const layout::TriangleRecord &triangle = packed.triangles[emitter.record];
        light.lower = glm::min(glm::min(triangle.v0, triangle.v1), triangle.v2);
        light.upper = glm::max(glm::max(triangle.v0, triangle.v1), triangle.v2);
        setNormals(packed, emitter.record, light);
        intensity = candidate.power / (std::numbers::pi * sides);
    } else if (emitter.kind == layout::emitterSphere) {
        const layout::SphereRecord &sphere = packed.spheres[emitter.record];
        light.lower = sphere.centre - sphere.radius;
        light.upper = sphere.centre + sphere.radius;
        light.isTwoSided = false; // it emits to all sides anyway
        intensity = candidate.power / (4.0 * std::numbers::pi * sides);
    } else {
        intensity = mean(emitter.emission);
    }
    if (emitter.kind == layout::emitterSpot) {
        light.axis = emitter.axis;
        light.cosineNormals = 1.0f;
        light.cosineEmission = emitter.cosineOuter;
    }
    if (emitter.kind == layout::emitterProfiled) {
        const ProfiledLight &profiled = candidate.profiled;
        intensity *= profiled.meanShare / std::max(coneShare(profiled.cosine), 1e-6);
        if (profiled.cosine > 0.0f) { // else it counts as one that shines everywhere
            light.axis = profiled.axis;
            light.cosineNormals = 1.0f;
            light.cosineEmission = profiled.cosine;
        }
    }
    return light;
}

/// Emitters with a place go into the light tree. Each of the others is chosen as often as all of them together.
void chooseByTree(std::vector<Candidate> candidates, PackedScene &packed) {
    if (candidates.size() >= layout::noEmitter)
        throw Error(
            ErrorKind::LimitExceeded,
            fmt::format("the scene has {} lights and emitting primitives; a light tree holds at most {}",
                        candidates.size(), layout::noEmitter - 1));
    const auto infiniteEnd =
        std::stable_partition(candidates.begin(), candidates.end(),
                              [](const Candidate &candidate) { return candidate.isInfinite; });
    const std::span<const Candidate> finite(infiniteEnd, candidates.end());
    packed.infiniteEmitterCount = static_cast<std::uint32_t>(candidates.size() - finite.size());
    const std::uint32_t numbers = 0xFFFFFFFFu / (packed.infiniteEmitterCount + 1); // as in emitters.glsl
    const float infiniteChance = static_cast<float>(numbers) * 0x1p-32f;
    if (packed.lighting & layout::lightsByEnvironment)
        packed.frame.environmentProbability = infiniteChance;
    std::vector<double> intensities(finite.size());
    std::vector<TreeLight> lights(finite.size());
    const auto count = static_cast<std::int64_t>(finite.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < count; ++i) {
        const auto index = static_cast<std::size_t>(i);
        lights[index] = treeLight(finite[index], packed, intensities[index]);
        lights[index].emitter = static_cast<std::uint32_t>(packed.infiniteEmitterCount + index);
    }
    const double total = std::accumulate(intensities.begin(), intensities.end(), 0.0);
    for (std::size_t i = 0; i < lights.size(); ++i)
        lights[i].intensity = static_cast<float>(std::max(intensities[i] / total, 1e-30));
    LightTree tree = buildLightTree(lights);
    packed.lightNodes = std::move(tree.nodes);

    for (layout::SphereRecord &sphere : packed.spheres)
        sphere.emitter = layout::noEmitter;
    for (layout::TriangleRecord &triangle : packed.triangles)
        triangle.flags |= layout::noEmitter << layout::triangleEmitterShift;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        layout::EmitterRecord &emitter = candidates[i].emitter;
        if (candidates[i].isInfinite)
            emitter.probability = infiniteChance;
        else
            emitter.cumulative = tree.turns[i - packed.infiniteEmitterCount];
        if (candidates[i].area > 0.0)
            emitter.pdf = static_cast<float>(1.0 / candidates[i].area);
        if (emitter.kind == layout::emitterSphere)
            packed.spheres[emitter.record].emitter = static_cast<std::uint32_t>(i);
        if (emitter.kind == layout::emitterTriangle) {
            layout::TriangleRecord &triangle = packed.triangles[emitter.record];
            triangle.flags &= (1u << layout::triangleEmitterShift) - 1;
            triangle.flags |= static_cast<std::uint32_t>(i) << layout::triangleEmitterShift;
        }
        packed.emitters.push_back(emitter);
    }
}

/// Whether lights stand so far apart that it pays to know where they are: a tree of 38 lamps (many-lights), and one of
/// a small lamp of many triangles (still-life), have 0.96 of the variance of a choice by power, in 1.1 of the time.
bool areApart(const std::vector<Candidate> &found, const PackedScene &packed) {
    constexpr std::ptrdiff_t few = 64;
    constexpr double near = 0.25; // of the size of the scene's tree
    if (std::ranges::count(found, false, &Candidate::isInfinite) <= few)
        return false;
    Box box;
    double intensity = 0.0;
    for (const Candidate &candidate : found)
        if (!candidate.isInfinite) {
            const TreeLight light = treeLight(candidate, packed, intensity);
            box.extend(Box{light.lower, light.upper});
        }
    const Box &scene = packed.trees.front().box;
    return scene.isEmpty() || glm::distance(glm::dvec3(box.lower), glm::dvec3(box.upper)) >=
                                  near * glm::distance(glm::dvec3(scene.lower), glm::dvec3(scene.upper));
}

bool isChosenByTree(LightChoice choice, const std::vector<Candidate> &found, const PackedScene &packed) {
    if (choice == LightChoice::Auto)
        return areApart(found, packed);
    return choice == LightChoice::Tree && std::ranges::count(found, false, &Candidate::isInfinite) > 1;
}

} // namespace

std::uint32_t emitterKindOf(const layout::LightRecord &light) {
    switch (lightKindOf(light)) {
    case layout::lightSpot:
        return layout::emitterSpot;
    case layout::lightDirectional:
        return layout::emitterDirectional;
    case layout::lightProfiled:
        return layout::emitterProfiled;
    default:
        return layout::emitterPoint;
    }
}

void packEmitters(const Scene &scene, bool isLitAround, LightChoice choice, PackedScene &packed) {
    std::vector<double> exitances; // of each material
    for (const layout::MaterialRecord &material : packed.materials)
        exitances.push_back(exitance(packed, material));
    std::vector<Candidate> candidates;
    const auto add = [&](const layout::EmitterRecord &emitter, double power, double area) {
        if (power > 0.0)
            candidates.push_back({emitter, power, area, false});
    };
    for (std::size_t i = 0; i < packed.lights.size(); ++i) {
        const double power = mean(scene.lights[i].power);
        const layout::EmitterRecord emitter =
            lightEmitter(packed.lights[i], numberOfGroup(packed.lightGroups, scene.lights[i].lightGroup));
        if (emitter.kind == layout::emitterProfiled) {
            const ProfiledLight profiled = profiledLight(scene, scene.lights[i]);
            if (power * profiled.meanShare > 0.0)
                candidates.push_back({emitter, power * profiled.meanShare, 0.0, false, profiled});
        } else if (emitter.kind != layout::emitterDirectional)
            add(emitter, power * (emitter.kind == layout::emitterSpot ? coneShare(emitter.cosineOuter) : 1.0),
                0.0);
        else if (power > 0.0)
            candidates.push_back({emitter, 0.0, 0.0, true});
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
        emitter.sidesAndGroup = packed.frame.environmentGroup << 1u;
        candidates.push_back({emitter, 0.0, 0.0, true});
    }

    for (const Candidate &candidate : candidates)
        packed.lighting |= 1u << candidate.emitter.kind;
    double total = 1.0; // of the light tree: emitterPdf > 0 marks what emits
    if (isChosenByTree(choice, candidates, packed))
        chooseByTree(std::move(candidates), packed);
    else
        total = chooseByPower(std::move(candidates), packed);
    for (std::size_t i = 0; i < packed.materials.size(); ++i)
        packed.materials[i].emitterPdf = total > 0.0 ? static_cast<float>(exitances[i] / total) : 0.0f;
}

} // namespace hyalite::core
