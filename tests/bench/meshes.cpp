#include "tests/bench/meshes.h"

#include "host/base/error.h"
#include "host/import/obj.h"

#include <cmath>
#include <numbers>
#include <random>

namespace hyalite::core::bench {

namespace {

constexpr const char *noisySphereName = "noise_144k";

} // namespace

const std::vector<std::string> &meshNames() {
    static const std::vector<std::string> names{"cat_4k", "cat_144k", noisySphereName, "cat_1m"};
    return names;
}

std::filesystem::path meshFile(const std::string &name) {
    if (name == "cat_4k")
        return HYALITE_CAT_4K;
    if (name == "cat_144k")
        return HYALITE_CAT_144K;
    if (name == "cat_1m")
        return HYALITE_CAT_1M;
    throw Error(ErrorKind::Usage, "no file holds a mesh called " + name);
}

TriangleMesh loadMesh(const std::string &name) {
    return name == noisySphereName ? noisySphere(379, 191) : loadObj(meshFile(name)).mesh;
}

TriangleMesh noisySphere(int around, int down) {
    constexpr double bumps = 0.05;
    constexpr double roughness = 0.01;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-roughness, roughness);
    TriangleMesh mesh;
    mesh.name = "a noisy sphere";
    for (int row = 0; row <= down; ++row) {
        const double polar = std::numbers::pi * row / down;
        for (int column = 0; column < around; ++column) {
            const double azimuth = 2.0 * std::numbers::pi * column / around;
            const glm::dvec3 direction(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                       -std::sin(polar) * std::sin(azimuth));
            const double bump = std::sin(9.0 * direction.x) * std::sin(11.0 * direction.y + 1.0) *
                                std::sin(7.0 * direction.z + 2.0);
            mesh.positions.emplace_back(direction * (1.0 + bumps * bump + noise(random)));
        }
    }
    const auto vertex = [&](int row, int column) {
        return static_cast<std::uint32_t>(row * around + column % around);
    };
    for (int row = 0; row < down; ++row) {
        for (int column = 0; column < around; ++column) {
            const std::uint32_t a = vertex(row, column);
            const std::uint32_t b = vertex(row + 1, column);
            const std::uint32_t c = vertex(row + 1, column + 1);
            const std::uint32_t d = vertex(row, column + 1);
            if (row + 1 < down)
                mesh.triangles.push_back({{a, b, c}});
            if (row > 0)
                mesh.triangles.push_back({{a, c, d}});
        }
    }
    return mesh;
}

} // namespace hyalite::core::bench
