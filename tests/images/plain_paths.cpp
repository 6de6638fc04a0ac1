#include "tests/images/plain_paths.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

namespace hyalite::testing {

namespace {

using Vec = glm::dvec3;
using Generator = std::mt19937_64;

constexpr int chunkCount = 64; ///< of paths, each with a generator of its own

struct Facet {
    Vec corner;
    Vec side1;
    Vec side2;
    Vec normal; ///< unit length
    Vec albedo;
    Vec emission;
    bool isTwoSided;
};

struct Meeting {
    double distance;
    const Facet *facet;
};

std::vector<Facet> facetsOf(const Scene &scene) {
    std::vector<Facet> facets;
    for (const TriangleMesh &mesh : scene.meshes) {
        const Material &material = scene.materials[mesh.materialIndex];
        for (const MeshTriangle &triangle : mesh.triangles) {
            const Vec a = mesh.positions[triangle.positions.x];
            const Vec b = mesh.positions[triangle.positions.y];
            const Vec c = mesh.positions[triangle.positions.z];
            facets.push_back({a, b - a, c - a, glm::normalize(glm::cross(b - a, c - a)), material.albedo,
                              material.emission, material.twoSided});
        }
    }
    return facets;
}

/// Cramer's rule.
std::optional<Meeting> nearest(const std::vector<Facet> &facets, const Vec &origin, const Vec &direction,
                               const Facet *left) {
    Meeting best{std::numeric_limits<double>::infinity(), nullptr};
    for (const Facet &facet : facets) {
        const Vec p = glm::cross(direction, facet.side2);
        const double determinant = glm::dot(facet.side1, p);
        const Vec s = origin - facet.corner;
        const Vec q = glm::cross(s, facet.side1);
        const double u = glm::dot(s, p) / determinant;
        const double v = glm::dot(direction, q) / determinant;
        const double distance = glm::dot(facet.side2, q) / determinant;
        if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 1e-9 && distance < best.distance &&
            &facet != left)
            best = {distance, &facet};
    }
    return best.facet != nullptr ? std::optional(best) : std::nullopt;
}

/// Malley: a point of the disk, lifted to the hemisphere.
Vec cosineDirection(const Vec &normal, Generator &generator) {
    std::uniform_real_distribution<double> uniform;
    const double radius = std::sqrt(uniform(generator));
    const double turn = 2.0 * std::numbers::pi * uniform(generator);
    const Vec other = std::abs(normal.x) < 0.6 ? Vec(1.0, 0.0, 0.0) : Vec(0.0, 1.0, 0.0);
    const Vec right = glm::normalize(glm::cross(other, normal));
    return radius * std::cos(turn) * right + radius * std::sin(turn) * glm::cross(normal, right) +
           std::sqrt(std::max(0.0, 1.0 - radius * radius)) * normal;
}

/// The facets that shine, and where each ends on a line as long as all of them are large.
struct Lights {
    std::vector<const Facet *> facets;
    std::vector<double> ends;

    explicit Lights(const std::vector<Facet> &all) {
        double end = 0.0;
        for (const Facet &facet : all) {
            if (facet.emission == Vec(0.0))
                continue;
            end += glm::length(glm::cross(facet.side1, facet.side2)) / 2.0;
            facets.push_back(&facet);
            ends.push_back(end);
        }
    }
};

/// What a surface of albedo 1 sends back of the light of one point, evenly distributed over all lights.
Vec lightFromOnePoint(const std::vector<Facet> &facets, const Lights &lights, const Vec &origin,
                      const Vec &normal, const Facet *left, Generator &generator) {
    std::uniform_real_distribution<double> uniform;
    const double area = lights.ends.back();
    const auto end = std::upper_bound(lights.ends.begin(), lights.ends.end() - 1, area * uniform(generator));
    const Facet &light = *lights.facets[static_cast<std::size_t>(end - lights.ends.begin())];
    const double fold = std::sqrt(uniform(generator));
    const double v = uniform(generator) * fold;
    const Vec point = light.corner + (1.0 - fold) * light.side1 + v * light.side2;
    const double distance = glm::length(point - origin);
    const Vec direction = (point - origin) / distance;
    const double towards = -glm::dot(direction, light.normal);
    const double cosine = glm::dot(direction, normal);
    if (&light == left || cosine <= 0.0 || (towards <= 0.0 && !light.isTwoSided))
        return Vec(0.0);
    const std::optional<Meeting> meeting = nearest(facets, origin, direction, left);
    if (!meeting || meeting->facet != &light)
        return Vec(0.0);
    return light.emission * (cosine * std::abs(towards) * area / (distance * distance) / std::numbers::pi);
}

Vec followPath(const Scene &scene, const std::vector<Facet> &facets, const Lights &lights, Vec origin,
               Vec direction, Generator &generator) {
    Vec radiance(0.0);
    Vec throughput(1.0);
    const Facet *left = nullptr;
    for (int segment = 1;; ++segment) {
        const std::optional<Meeting> meeting = nearest(facets, origin, direction, left);
        if (!meeting)
            return radiance + throughput * Vec(scene.background);
        const Facet &facet = *meeting->facet;
        const bool isFront = glm::dot(direction, facet.normal) < 0.0;
        if (!isFront && !facet.isTwoSided)
            return radiance;
        if (segment == 1)
            radiance += facet.emission;
        if (segment == scene.settings.maxDepth)
            return radiance;
        const Vec normal = isFront ? facet.normal : -facet.normal;
        throughput *= facet.albedo;
        origin += meeting->distance * direction;
        left = &facet;
        radiance += throughput * lightFromOnePoint(facets, lights, origin, normal, left, generator);
        direction = cosineDirection(normal, generator);
    }
}

} // namespace

Estimate estimatePlainly(const Scene &scene, int x0, int x1, int y0, int y1, int pathCount,
                         std::uint64_t seed) {
    const std::vector<Facet> facets = facetsOf(scene);
    const Lights lights(facets);
    const Camera &camera = scene.camera;
    const Vec forward = glm::normalize(camera.direction);
    const Vec right = glm::normalize(glm::cross(forward, camera.up));
    const Vec up = glm::cross(right, forward);
    const double pixel = 2.0 * std::tan(glm::radians(camera.horizontalFovDegrees) / 2.0) / camera.width;
    std::vector<Vec> sums(chunkCount, Vec(0.0));
    std::vector<Vec> squares(chunkCount, Vec(0.0));
    const int perChunk = pathCount / chunkCount;
#pragma omp parallel for schedule(dynamic)
    for (int chunk = 0; chunk < chunkCount; ++chunk) {
        std::seed_seq seeds{static_cast<std::uint64_t>(chunk), seed};
        Generator generator(seeds);
        std::uniform_real_distribution<double> uniform;
        for (int i = 0; i < perChunk; ++i) {
            const double x = x0 + (x1 - x0) * uniform(generator) - camera.width / 2.0;
            const double y = camera.height / 2.0 - y0 - (y1 - y0) * uniform(generator);
            const Vec direction = glm::normalize(forward + pixel * x * right + pixel * y * up);
            const Vec radiance = followPath(scene, facets, lights, camera.position, direction, generator);
            sums[static_cast<std::size_t>(chunk)] += radiance;
            squares[static_cast<std::size_t>(chunk)] += radiance * radiance;
        }
    }
    Vec sum(0.0);
    Vec square(0.0);
    for (std::size_t chunk = 0; chunk < chunkCount; ++chunk) {
        sum += sums[chunk];
        square += squares[chunk];
    }
    const double count = static_cast<double>(perChunk) * chunkCount;
    Estimate estimate;
    estimate.mean = sum / count;
    estimate.variance = (square / count - estimate.mean * estimate.mean) / (count - 1.0);
    return estimate;
}

} // namespace hyalite::testing
