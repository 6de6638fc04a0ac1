// Meshes for comparisons with Embree: smooth, rough, closed, far from the origin, and needles.
#pragma once

#include "host/scene/scene.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>

namespace hyalite::core::testing {

/// Closed; 2 * around * across triangles; the radii are 1 and 0.375.
inline TriangleMesh torus(int around, int across, const glm::dvec3 &centre) {
    TriangleMesh mesh;
    const double turn = 2.0 * std::numbers::pi;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double longitude = turn * i / around;
            const double latitude = turn * j / across;
            const double distance = 1.0 + 0.375 * std::cos(latitude);
            mesh.positions.emplace_back(centre + glm::dvec3(distance * std::cos(longitude),
                                                            0.375 * std::sin(latitude),
                                                            -distance * std::sin(longitude)));
        }
    }
    const auto vertex = [&](int i, int j) {
        return static_cast<std::uint32_t>(i % around * across + j % across);
    };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            mesh.triangles.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)}});
            mesh.triangles.push_back({{vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)}});
        }
    }
    return mesh;
}

/// Closed; 20 * 4^subdivisions triangles around the origin, at distances of 1 +- roughness.
inline TriangleMesh icosphere(int subdivisions, double roughness) {
    const double golden = std::numbers::phi;
    std::vector<glm::dvec3> points;
    for (const double a : {-1.0, 1.0}) {
        for (const double b : {-golden, golden}) {
            points.emplace_back(0.0, a, b);
            points.emplace_back(a, b, 0.0);
            points.emplace_back(b, 0.0, a);
        }
    }
    // The faces are the triples of neighbours: points at a distance of 2.
    const auto areNeighbours = [&](std::size_t i, std::size_t j) {
        return std::abs(glm::distance(points[i], points[j]) - 2.0) < 1e-9;
    };
    std::vector<glm::uvec3> faces;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size(); ++j)
            for (std::size_t k = j + 1; k < points.size(); ++k)
                if (areNeighbours(i, j) && areNeighbours(j, k) && areNeighbours(i, k)) {
                    const bool isOutward = glm::dot(glm::cross(points[i], points[j]), points[k]) > 0.0;
                    faces.emplace_back(i, isOutward ? j : k, isOutward ? k : j);
                }
    for (int level = 0; level < subdivisions; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [found, isNew] = middles.try_emplace(std::minmax(a, b), points.size());
            if (isNew)
                points.push_back((glm::normalize(points[a]) + glm::normalize(points[b])) / 2.0);
            return found->second;
        };
        std::vector<glm::uvec3> finer;
        for (const glm::uvec3 &face : faces) {
            const std::uint32_t a = middle(face.x, face.y);
            const std::uint32_t b = middle(face.y, face.z);
            const std::uint32_t c = middle(face.z, face.x);
            finer.insert(finer.end(), {{face.x, a, c}, {a, face.y, b}, {c, b, face.z}, {a, b, c}});
        }
        faces = std::move(finer);
    }
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(1.0 - roughness, 1.0 + roughness);
    TriangleMesh mesh;
    for (const glm::dvec3 &point : points)
        mesh.positions.emplace_back(glm::normalize(point) * noise(random));
    for (const glm::uvec3 &face : faces)
        mesh.triangles.push_back({face});
    return mesh;
}

/// Triangles of length 0.25 and of widths from 1e-2 to 1e-5, every which way in a cube.
inline TriangleMesh needles(int count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto vector = [&] { return glm::dvec3(uniform(random), uniform(random), uniform(random)); };
    TriangleMesh mesh;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 base = vector();
        const double width = std::pow(10.0, -3.5 + 1.5 * uniform(random));
        const std::uint32_t first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.emplace_back(base);
        mesh.positions.emplace_back(base + width * glm::normalize(vector()));
        mesh.positions.emplace_back(base + 0.25 * glm::normalize(vector()));
        mesh.triangles.push_back({{first, first + 1, first + 2}});
    }
    return mesh;
}

} // namespace hyalite::core::testing
