// The report's pictures against an independent double-precision program, at the true pixel centres.
#include "host/image/tone_map.h"
#include "tests/images/rendering.h"
#include "tests/images/report_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyalite {
namespace {

using testing::renderOnDevice;
using testing::shippedScene;

struct Agreement {
    int worst = 0;              ///< difference of 8-bit values in stable pixels
    double unstableShare = 0.0; ///< of all pixels
};

Agreement compare(const Image &image, const oracle::Image &expected) {
    const std::vector<std::uint8_t> bytes = toneMap(image, 0.0);
    Agreement agreement;
    std::size_t unstableCount = 0;
    for (std::size_t i = 0; i < expected.radiance.size(); ++i) {
        if (expected.unstable[i] != 0) {
            ++unstableCount;
            continue;
        }
        const oracle::Rgb &truth = expected.radiance[i];
        const double channels[3] = {truth.x, truth.y, truth.z};
        for (std::size_t c = 0; c < 3; ++c) {
            const int difference = std::abs(int{bytes[3 * i + c]} - int{oracle::toEightBit(channels[c])});
            agreement.worst = std::max(agreement.worst, difference);
        }
    }
    agreement.unstableShare =
        static_cast<double>(unstableCount) / static_cast<double>(expected.radiance.size());
    return agreement;
}

oracle::Image renderOracle(const oracle::Scene &scene, int width, int height) {
    const oracle::Camera camera;
    oracle::Image image = oracle::render(scene, camera, width, height);
    oracle::markUnstable(scene, camera, image);
    return image;
}

void expectAgreement(Scene scene, const oracle::Scene &same) {
    scene.settings.sampler = SamplerKind::Centre;
    scene.settings.samplesPerPixel = 1;
    const oracle::Image expected = renderOracle(same, scene.camera.width, scene.camera.height);
    const Agreement agreement = compare(renderOnDevice(scene).film.toImage(), expected);
    EXPECT_LE(agreement.worst, 2);
    EXPECT_LE(agreement.unstableShare, 0.002);
    ::testing::Test::RecordProperty("unstableShare", std::to_string(agreement.unstableShare));
}

oracle::Vec3 toOracle(const glm::vec3 &v) { return {v.x, v.y, v.z}; }

/// The report's room with the triangles of a scene's meshes in it.
oracle::Scene roomWith(const Scene &scene) {
    oracle::Scene room = oracle::catRoom();
    for (const TriangleMesh &mesh : scene.meshes) {
        for (const MeshTriangle &corners : mesh.triangles) {
            oracle::Triangle triangle;
            triangle.material = oracle::catMaterial();
            std::array<oracle::Vec3, 3> normals;
            for (int k = 0; k < 3; ++k) {
                const std::size_t corner = static_cast<std::size_t>(k);
                triangle.vertices[corner] = toOracle(mesh.positions[corners.positions[k]]);
                normals[corner] = toOracle(mesh.normals[corners.normals[k]]);
            }
            triangle.normals = normals;
            room.triangles.push_back(triangle);
        }
    }
    return room;
}

TEST(Oracle, AgreesOnTheSpheres) {
    expectAgreement(shippedScene("spheres", 512, 512, 1), oracle::spheresScene());
}

TEST(Oracle, AgreesOnTheNestedSpheres) {
    expectAgreement(shippedScene("spheres-nested", 256, 256, 1), oracle::spheresNestedScene());
}

TEST(Oracle, AgreesOnTheCat) {
    const Scene scene = shippedScene("cat", 512, 512, 1);
    expectAgreement(scene, roomWith(scene));
}

// Direct light on the back wall in closed form, straight ahead and off the axis.
TEST(ClosedForm, LightOnTheBackWall) {
    Scene scene = shippedScene("cat", 101, 101, 1);
    scene.meshes.clear();
    scene.settings.sampler = SamplerKind::Centre;
    const Image image = renderOnDevice(scene).film.toImage();
    const glm::dvec3 eye(0.0, 0.0, 55.0);
    const glm::dvec3 centre(0.0, 0.0, -1000.0);
    const glm::dvec3 light(-10.0, 20.0, 40.0);
    const double radius = 940.0;
    for (const auto &[x, y] : {std::pair(50, 50), std::pair(30, 40), std::pair(70, 20), std::pair(50, 15)}) {
        const double focal = 101.0 / (2.0 * std::tan(std::numbers::pi / 6.0));
        glm::dvec3 d(x + 0.5 - 50.5, 50.5 - (y + 0.5), -focal);
        d /= std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
        const auto dot = [](const glm::dvec3 &a, const glm::dvec3 &b) {
            return a.x * b.x + a.y * b.y + a.z * b.z;
        };
        const glm::dvec3 f = eye - centre;
        const double b = dot(f, d);
        const double t = -b - std::sqrt(b * b - dot(f, f) + radius * radius);
        const glm::dvec3 point = eye + t * d;
        const glm::dvec3 normal = (point - centre) / radius;
        const glm::dvec3 toLight = light - point;
        const double squared = dot(toLight, toLight);
        const double cosine = dot(normal, toLight) / std::sqrt(squared);
        const double factor = 1e5 / (4.0 * std::numbers::pi * squared) / std::numbers::pi * cosine;
        const glm::dvec3 expected = glm::dvec3(0.4, 0.8, 0.7) * factor;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(image.at(x, y)[c] / expected[c], 1.0, 1e-5) << x << ", " << y;
    }
}

} // namespace
} // namespace hyalite
