// A scene with instances has the picture of the same scene with a mesh for each instance, bit for bit, by the kernels
// in turn.
#include "host/scene/instances.h"
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/test_scene.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <array>

namespace hyalite::core {
namespace {

using testing::differingPixels;
using testing::renderOnCpu;
using testing::renderOnDevice;

/// A map that turns and shears, mirrors half of the time, with singular values up to `condition` apart.
Placement randomPlacement(testing::Random &random, double scale, double condition, const glm::dvec3 &offset) {
    const glm::dvec3 x = random.direction();
    const glm::dvec3 y = glm::normalize(glm::cross(x, random.direction()));
    const glm::dvec3 z = glm::cross(x, y) * (random.coin() ? 1.0 : -1.0);
    const std::array<glm::dvec3, 3> from{random.direction(), random.direction(), random.direction()};
    Placement placement;
    for (glm::length_t row = 0; row < 3; ++row)
        placement.rows[static_cast<std::size_t>(row)] =
            glm::vec3(scale * (x[row] * from[0] + y[row] * from[1] + z[row] * from[2] / condition +
                               0.3 * x[row] * from[2]));
    placement.offset = glm::vec3(offset);
    return placement;
}

/// A ball with normals and texture coordinates on its upper half.
TriangleMesh ball() {
    TriangleMesh mesh = testing::icosphere(2);
    mesh.normals = mesh.positions;
    for (MeshTriangle &triangle : mesh.triangles) {
        const glm::uvec3 corners = triangle.positions;
        if (mesh.positions[corners.x].y > 0.0f)
            triangle.normals = corners;
        mesh.triangleUvs.push_back(corners);
    }
    for (const glm::vec3 &position : mesh.positions)
        mesh.uvs.emplace_back(position.x + 0.3f, position.z * 2.0f);
    return mesh;
}

/// Instances of a ball with several materials and of a needle soup, between meshes and a sphere. Looked at from
/// outside, around `offset`.
TestScene crowd(std::uint64_t seed, double condition = 3.0, const glm::dvec3 &offset = {}) {
    testing::Random random(seed);
    TestScene scene;
    scene.materials.resize(4);
    scene.materials[0].twoSided = true;
    scene.materials[1].kind = MaterialKind::Dielectric;
    scene.materials[1].refractiveIndex = 1.5f;
    scene.materials[2].kind = MaterialKind::Mirror;
    scene.materials[3].kind = MaterialKind::Conductor;
    scene.materials[3].roughness = 0.3f;
    scene.materials[3].twoSided = true;
    TriangleMesh mixed = ball();
    for (std::size_t i = 0; i < mixed.triangles.size(); ++i)
        mixed.triangleMaterials.push_back(static_cast<std::uint32_t>(i / 80 % 4));
    const auto placements = [&](std::size_t count, double scale) {
        std::vector<Placement> all;
        for (std::size_t i = 0; i < count; ++i)
            all.push_back(randomPlacement(random, scale * random.uniform(0.5, 1.5), condition,
                                          offset + random.inCube(6.0)));
        return all;
    };
    addInstances(scene, mixed, placements(15, 1.2));
    scene.meshes.push_back(testing::placed(testing::gridCube(3), 1.5, offset));
    TriangleMesh soup = testing::triangleSoup(random, 60, 1.0, 0.5);
    soup.materialIndex = 3;
    addInstances(scene, std::move(soup), placements(20, 1.0));
    scene.meshes.push_back(testing::placed(testing::tetrahedron(), 1.0, offset + glm::dvec3(0, 4, 0)));
    addInstances(scene, ball(), placements(2, 1.5));
    scene.spheres.push_back({offset + glm::dvec3(3, 0, 3), 1.5, 1, false});
    scene.camera.position = offset + glm::dvec3(4, 6, 22);
    scene.camera.direction = offset - scene.camera.position;
    scene.camera.horizontalFovDegrees = 40.0;
    scene.camera.width = 48;
    scene.camera.height = 40;
    scene.settings.samplesPerPixel = 2;
    scene.settings.maxDepth = 5;
    scene.background = {0.2f, 0.3f, 0.4f};
    scene.lights.push_back({offset + glm::dvec3(10, 20, 10), glm::dvec3(8000.0)});
    return scene;
}

TestScene flattened(TestScene scene) {
    arrangeInstances(scene, Flattening::All);
    EXPECT_TRUE(scene.instances.empty() && scene.prototypes.empty());
    return scene;
}

/// On both renderers, of the scene as it is and with a mesh for each instance; by the kernels of a turn for each tree.
void expectOnePicture(TestScene scene, std::size_t turn,
                      std::initializer_list<TreeKind> trees = {TreeKind::Midpoint, TreeKind::Sah}) {
    for (const TreeKind tree : trees) {
        scene.settings.tree = tree;
        const reference::Result wanted = renderOnCpu(flattened(scene));
        const reference::Result cpu = renderOnCpu(scene);
        EXPECT_EQ(differingPixels(cpu.film, wanted.film), 0u);
        EXPECT_EQ(cpu.rays, wanted.rays);
        for (const gpu::RenderConfig &config : testing::kernelsInTurn(turn++)) {
            const gpu::Result device = renderOnDevice(scene, config);
            EXPECT_EQ(differingPixels(device.film, wanted.film), 0u) << gpu::kernelName(config);
            EXPECT_EQ(device.rays, wanted.rays);
        }
    }
}

/// A picture that shows something.
void expectManyHits(const TestScene &scene) {
    const reference::Result result = renderOnCpu(scene);
    EXPECT_GE(result.rays.shadow, 400u);
}

TEST(InstanceTwins, AgreeWithMeshesForWhitted) {
    expectManyHits(crowd(1));
    expectOnePicture(crowd(1), 2);
}

TEST(InstanceTwins, AgreeWithMeshesForPaths) {
    TestScene scene = crowd(2);
    scene.settings.integrator = Integrator::Path;
    expectOnePicture(scene, 0);
}

TEST(InstanceTwins, AgreeWithMeshesFarFromTheOrigin) {
    expectManyHits(crowd(3, 3.0, {1e6, -1e6, 1e6}));
    expectOnePicture(crowd(3, 3.0, {1e6, -1e6, 1e6}), 0);
}

TEST(InstanceTwins, AgreeWithMeshesThatAreNearlyFlat) { expectOnePicture(crowd(4, 1e6), 2); }

TEST(InstanceTwins, AgreeWithMeshesInEveryView) {
    std::size_t turn = 1;
    for (const Integrator view : {Integrator::Normal, Integrator::Uv, Integrator::AmbientOcclusion}) {
        TestScene scene = crowd(5);
        scene.settings.integrator = view;
        expectOnePicture(scene, turn++, {TreeKind::Sah});
    }
}

TEST(InstanceTwins, AgreeWithMeshesThatAreLights) {
    TestScene scene = crowd(6);
    scene.settings.integrator = Integrator::Path;
    scene.materials[0].emission = {2.0f, 1.5f, 1.0f};
    arrangeInstances(scene, Flattening::Needed);
    EXPECT_FALSE(scene.instances.empty()); // those without emission
    expectOnePicture(scene, 0);
    TestScene other = crowd(6);
    other.settings.integrator = Integrator::Path;
    other.materials[0].emission = {2.0f, 1.5f, 1.0f};
    EXPECT_EQ(differingPixels(renderOnCpu(flattened(other)).film, renderOnCpu(scene).film), 0u);
}

// A dispatch that ends inside of an instance goes on there.
TEST(InstanceTwins, AgreeWhenEveryFewStepsEndADispatch) {
    TestScene scene = crowd(7);
    const reference::Result wanted = renderOnCpu(flattened(scene));
    for (const std::size_t turn : {0, 2}) // a stack, and a skip list
        for (gpu::RenderConfig config : testing::kernelsInTurn(turn)) {
            config.steps = 37;
            EXPECT_EQ(differingPixels(renderOnDevice(scene, config).film, wanted.film), 0u);
        }
}

TEST(InstanceTwins, AgreeOnTheWorkOfAStack) {
    TestScene scene = crowd(8);
    scene.settings.integrator = Integrator::Cost;
    const gpu::RenderConfig config{.kernel = gpu::findKernel("stack")};
    EXPECT_EQ(differingPixels(renderOnDevice(scene, config).film, renderOnCpu(scene).film), 0u);
}

} // namespace
} // namespace hyalite::core
