// Random numbers, tallies, meshes and scenes for the tests of trees, intersections and renders.
#pragma once

#include "host/bvh/bvh.h"
#include "host/bvh/packed_scene.h"
#include "host/scene/scene.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace hyalite::testing {

/// SplitMix64 (Steele, Lea and Flood, 2014): the same numbers with every standard library.
class Random {
  public:
    explicit Random(std::uint64_t seed) : seed_(seed), state_(seed) {}

    [[nodiscard]] std::uint64_t seed() const { return seed_; }
    [[nodiscard]] std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    [[nodiscard]] std::size_t below(std::size_t count) { return static_cast<std::size_t>(bits() % count); }
    [[nodiscard]] bool coin() { return (bits() & 1u) != 0; }
    [[nodiscard]] double uniform(double low = 0.0, double high = 1.0) {
        return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
    }
    [[nodiscard]] double logUniform(double low, double high) {
        return std::exp(uniform(std::log(low), std::log(high)));
    }
    /// In the cube [-half, half]^3.
    [[nodiscard]] glm::dvec3 inCube(double half) {
        const double x = uniform(-half, half);
        const double y = uniform(-half, half);
        return {x, y, uniform(-half, half)};
    }
    [[nodiscard]] glm::dvec3 inBall(double radius) {
        for (;;) {
            const glm::dvec3 point = inCube(1.0);
            if (glm::dot(point, point) <= 1.0)
                return point * radius;
        }
    }
    /// Of unit length.
    [[nodiscard]] glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 point = inBall(1.0);
            if (glm::dot(point, point) > 1e-4)
                return glm::normalize(point);
        }
    }

  private:
    std::uint64_t seed_;
    std::uint64_t state_;
};

/// Counts how often a property holds, keeps the first counterexample in words, and prints the rate.
class Tally {
  public:
    Tally(std::string property, std::uint64_t seed) : property_(std::move(property)), seed_(seed) {}

    /// `describe()` is called for the first counterexample only.
    template <class Describe> void check(bool isFine, Describe &&describe) {
        ++count_;
        if (isFine)
            return;
        if (failureCount_++ == 0)
            example_ = describe();
    }
    void check(bool isFine) {
        check(isFine, [] { return std::string(); });
    }
    void print() const {
        fmt::print("    {}: {} of {}\n", property_, failureCount_, count_);
        std::fflush(stdout);
    }
    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] std::uint64_t failureCount() const { return failureCount_; }

    /// Prints the rate and fails the test unless it is 0.
    void expectNone() const {
        print();
        EXPECT_GT(count_, 0u) << property_ << ": nothing was checked";
        EXPECT_EQ(failureCount_, 0u) << property_ << ", seed " << seed_ << ", first: " << example_;
    }

  private:
    std::string property_;
    std::uint64_t seed_;
    std::uint64_t count_ = 0;
    std::uint64_t failureCount_ = 0;
    std::string example_;
};

/// Exact, for messages.
template <class Real> [[nodiscard]] std::string text(const glm::vec<3, Real> &v) {
    return fmt::format("({:a} {:a} {:a})", v.x, v.y, v.z);
}

[[nodiscard]] inline bool sameBits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

// ---- Meshes

inline void addTriangle(TriangleMesh &mesh, const glm::vec3 &a, const glm::vec3 &b, const glm::vec3 &c) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.triangles.push_back({{first, first + 1, first + 2}});
}

/// The parallelogram corner, corner + a, corner + a + b, corner + b; its normal is along a x b.
inline void addQuad(TriangleMesh &mesh, const glm::vec3 &corner, const glm::vec3 &a, const glm::vec3 &b) {
    addTriangle(mesh, corner, corner + a, corner + a + b);
    addTriangle(mesh, corner, corner + a + b, corner + b);
}

[[nodiscard]] inline TriangleMesh tetrahedron() {
    TriangleMesh mesh;
    mesh.positions = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    mesh.triangles = {{{0, 1, 2}}, {{0, 3, 1}}, {{0, 2, 3}}, {{1, 3, 2}}};
    return mesh;
}

/// The surface of the cube [-1, 1]^3, each face cut into cells x cells squares: all boxes are flat, and share the planes
/// of their faces with their neighbours.
[[nodiscard]] inline TriangleMesh gridCube(int cells) {
    TriangleMesh mesh;
    const auto coordinate = [&](int i) {
        return static_cast<float>(2 * i - cells) / static_cast<float>(cells);
    };
    const auto corner = [&](int axis, float side, int i, int j) {
        glm::vec3 point(side);
        point[(axis + 1) % 3] = coordinate(i);
        point[(axis + 2) % 3] = coordinate(j);
        return point;
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f})
            for (int i = 0; i < cells; ++i)
                for (int j = 0; j < cells; ++j) {
                    const glm::vec3 a = corner(axis, side, i, j);
                    const glm::vec3 c = corner(axis, side, i + 1, j + 1);
                    addTriangle(mesh, a, corner(axis, side, i + 1, j), c);
                    addTriangle(mesh, a, c, corner(axis, side, i, j + 1));
                }
    return mesh;
}

/// 20 * 4^levels triangles around the unit ball.
[[nodiscard]] inline TriangleMesh icosphere(int levels) {
    TriangleMesh mesh;
    const float g = static_cast<float>(std::numbers::phi);
    mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (const glm::uvec3 &corner : std::initializer_list<glm::uvec3>{
             {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}})
        mesh.triangles.push_back({corner});
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middleOf = [&](std::uint32_t a, std::uint32_t b) {
            const auto [entry, isNew] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
            if (isNew)
                mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]) / 2.0f);
            return entry->second;
        };
        std::vector<MeshTriangle> finer;
        for (const MeshTriangle &triangle : mesh.triangles) {
            const glm::uvec3 v = triangle.positions;
            const std::uint32_t a = middleOf(v.x, v.y);
            const std::uint32_t b = middleOf(v.y, v.z);
            const std::uint32_t c = middleOf(v.z, v.x);
            for (const glm::uvec3 &corner : {glm::uvec3(v.x, a, c), {v.y, b, a}, {v.z, c, b}, {a, b, c}})
                finer.push_back({corner});
        }
        mesh.triangles = std::move(finer);
    }
    for (glm::vec3 &position : mesh.positions)
        position = glm::vec3(glm::normalize(glm::dvec3(position)));
    return mesh;
}

/// A closed star of slivers: 96 meridians whose rings are near and far in turn, so that faces are up to 60 times as long
/// as wide. Every ray from the centre leaves it once.
[[nodiscard]] inline TriangleMesh spikyStar() {
    constexpr std::uint32_t meridians = 96;
    constexpr std::uint32_t rings = 5;
    TriangleMesh mesh;
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        for (std::uint32_t i = 0; i < meridians; ++i) {
            const double polar = std::numbers::pi * (ring + 1.0) / (rings + 1.0);
            const double azimuth = 2.0 * std::numbers::pi * i / meridians;
            const double radius = (ring % 2 == 0 ? 0.5 : 2.0) * (i % 3 == 0 ? 1.5 : 1.0);
            mesh.positions.push_back(
                glm::vec3(radius * glm::dvec3(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                              -std::sin(polar) * std::sin(azimuth))));
        }
    }
    const auto north = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back({0.0f, 3.0f, 0.0f});
    mesh.positions.push_back({0.0f, -3.0f, 0.0f});
    for (std::uint32_t i = 0; i < meridians; ++i) {
        const std::uint32_t next = (i + 1) % meridians;
        mesh.triangles.push_back({{north, i, next}});
        for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
            const std::uint32_t upper = ring * meridians;
            const std::uint32_t lower = upper + meridians;
            mesh.triangles.push_back({{upper + i, lower + i, lower + next}});
            mesh.triangles.push_back({{upper + i, lower + next, upper + next}});
        }
        const std::uint32_t last = (rings - 1) * meridians;
        mesh.triangles.push_back({{last + i, north + 1, last + next}});
    }
    return mesh;
}

/// Scaled first, then moved; rounded to float once.
[[nodiscard]] inline TriangleMesh placed(TriangleMesh mesh, double scale, const glm::dvec3 &offset) {
    for (glm::vec3 &position : mesh.positions)
        position = glm::vec3(glm::dvec3(position) * scale + offset);
    return mesh;
}

/// Triangles whose corners lie within `size` of points in the cube [-half, half]^3 around `centre`.
[[nodiscard]] inline TriangleMesh triangleSoup(Random &random, std::size_t count, double half, double size,
                                               const glm::dvec3 &centre = glm::dvec3(0.0)) {
    TriangleMesh mesh;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 middle = centre + random.inCube(half);
        const glm::vec3 a(middle + random.inCube(size));
        const glm::vec3 b(middle + random.inCube(size));
        const glm::vec3 c(middle + random.inCube(size));
        addTriangle(mesh, a, b, c);
    }
    return mesh;
}

// ---- Scenes

/// One grey diffuse material.
[[nodiscard]] inline Scene sceneOf(TriangleMesh mesh) {
    Scene scene;
    scene.materials.push_back({});
    scene.meshes.push_back(std::move(mesh));
    return scene;
}

[[nodiscard]] inline PackedScene packed(const Scene &scene, TreeKind kind = TreeKind::Midpoint,
                                        int leafSize = 8) {
    return packScene(scene, buildBvh(kind, buildTriangles(scene), leafSize));
}

} // namespace hyalite::testing
