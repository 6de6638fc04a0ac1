// The report's pictures against an independent double-precision program, at the true pixel centres.
#include "host/image/tone_map.h"
#include "tests/images/rendering.h"
#include "tests/images/report_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

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

} // namespace
} // namespace hyalite
