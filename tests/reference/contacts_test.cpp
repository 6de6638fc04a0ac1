// Glass that touches other surfaces: under an even sky it is invisible, and nothing leaks through what it stands on.
#include "host/scene/contacts.h"

#include "host/reference/renderer.h"
#include "host/scene/instances.h"
#include "host/scene/shapes.h"
#include "host/scene/solids.h"
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/radiance_fixture.h"
#include "tests/fixtures/test_scene.h"

#include <glm/gtc/matrix_transform.hpp>

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::estimate;
using hyalite::core::testing::expectRadiance;

Material glassOf(float index, int priority = 0, float roughness = 0.0f) {
    Material material;
    material.kind = MaterialKind::Dielectric;
    material.refractiveIndex = index;
    material.priority = priority;
    material.roughness = roughness;
    return material;
}

TriangleMesh box(std::uint32_t material, const glm::dvec3 &centre, const glm::dvec3 &halfSize) {
    const glm::dmat4 map = glm::scale(glm::translate(glm::dmat4(1.0), centre), halfSize);
    TriangleMesh mesh = transformed(makeShape(ShapeKind::Box, 3), glm::dmat4x3(map));
    mesh.materialIndex = material;
    return mesh;
}

/// An even sky, seen from an eye at +z through what is at the origin.
TestScene furnace(std::vector<Material> materials, double size) {
    TestScene scene;
    scene.materials = std::move(materials);
    scene.background = glm::vec3(1.0f);
    scene.camera.position = glm::dvec3(0.1, 0.2, 5.0) * size;
    scene.camera.direction = {0.3, 0.05, -1.0};
    scene.camera.horizontalFovDegrees = 10.0;
    scene.camera.width = 8;
    scene.camera.height = 8;
    scene.settings.integrator = Integrator::Path;
    scene.settings.samplesPerPixel = 64;
    scene.settings.maxDepth = layout::maxPathDepth;
    return scene;
}

/// Two boxes, the first on top of the second.
TestScene twoBoxes(std::vector<Material> materials, double size, double gap, bool isTurnedRound = false) {
    TestScene scene = furnace(std::move(materials), size);
    const auto last = static_cast<std::uint32_t>(scene.materials.size() - 1);
    scene.meshes = {box(0, glm::dvec3(0.0, 0.0, 0.5 * size + gap), size * glm::dvec3(4.0, 4.0, 0.5)),
                    box(last, glm::dvec3(0.0, 0.0, -0.5 * size), size * glm::dvec3(4.0, 4.0, 0.5))};
    if (isTurnedRound)
        std::swap(scene.meshes[0], scene.meshes[1]);
    return scene;
}

TEST(Contacts, OfGlassAreInvisible) {
    const std::vector<std::vector<Material>> kinds = {
        {glassOf(1.5f)}, {glassOf(1.5f), glassOf(1.33f)}, {glassOf(1.33f, -1), glassOf(1.5f, 1)}};
    for (const std::vector<Material> &materials : kinds)
        for (const double size : {1.0, 1000.0})
            for (const double gap : {0.0, 1e-7, 1e-6, 3e-6, 1e-5, 1e-4, -1e-6})
                for (const bool isTurnedRound : {false, true}) {
                    TestScene scene = twoBoxes(materials, size, gap, isTurnedRound);
                    partContacts(scene);
                    SCOPED_TRACE(::testing::Message()
                                 << materials.size() << " glasses, size " << size << ", gap " << gap
                                 << (isTurnedRound ? ", turned round" : ""));
                    expectRadiance(scene, 1.0);
                }
}

TEST(Contacts, OfRoughGlassAreInvisible) {
    TestScene scene = twoBoxes({glassOf(1.5f, 0, 0.3f), glassOf(1.33f, 0, 0.2f)}, 1.0, 0.0);
    scene.settings.samplesPerPixel = 2000;
    partContacts(scene);
    EXPECT_NEAR(estimate(scene).mean, 1.0, 0.01);
}

TEST(Contacts, OfCurvedSurfacesAreInvisible) {
    // Water in a hollow ball: of spheres, and of meshes.
    for (const bool isOfMeshes : {false, true}) {
        TestScene scene = furnace({glassOf(1.5f, 1), glassOf(1.33f)}, 1.0);
        scene.camera.direction = -scene.camera.position;
        for (const auto &[radius, material, isInward] :
             {std::tuple(1.0f, 0u, false), std::tuple(0.9f, 0u, true), std::tuple(0.9f, 1u, false)}) {
            if (!isOfMeshes) {
                scene.spheres.push_back({glm::dvec3(0.0), static_cast<double>(radius), material, isInward});
                continue;
            }
            TriangleMesh mesh = hyalite::core::testing::icosphere(2);
            mesh.normals.clear();
            for (MeshTriangle &triangle : mesh.triangles)
                triangle.normals = glm::uvec3(MeshTriangle::noNormal);
            for (glm::vec3 &position : mesh.positions)
                position *= radius;
            mesh.materialIndex = material;
            scene.meshes.push_back(isInward ? mirrored(std::move(mesh)) : std::move(mesh));
        }
        partContacts(scene);
        expectRadiance(scene, 1.0, 2e-3); // of light that total reflection keeps, depth 32 loses some
    }
}

TEST(Contacts, OfGlassInstancesAreInvisible) {
    TestScene scene = furnace({glassOf(1.5f)}, 1.0);
    Placement above;
    above.offset.z = 1.0f;
    Placement below;
    below.offset.z = -1.0f;
    Placement apart;
    apart.offset.x = 100.0f;
    addInstances(scene, box(0, glm::dvec3(0.0), glm::dvec3(4.0, 4.0, 1.0)), std::array{above, below, apart});
    partContacts(scene);
    EXPECT_EQ(scene.meshes.size(), 1u); // the one that moves
    EXPECT_EQ(scene.instances.size(), 2u);
    expectRadiance(scene, 1.0);
}

TEST(Contacts, WithATableLeakNothing) {
    // Of a white sky, a black table under glass lets nothing through that does not leave by the sides or the top.
    std::vector<double> means;
    for (const double height : {0.0, 1e-7, -1e-3}) {
        TestScene scene = furnace({glassOf(1.5f), Material{}}, 1.0);
        scene.materials[1].albedo = glm::vec3(0.0f);
        scene.meshes = {box(0, {0.0, 0.0, 0.5 + height}, {1.0, 1.0, 0.5}),
                        box(1, {0.0, 0.0, -1.0}, {20.0, 20.0, 1.0})};
        scene.camera.direction = {0.0, 0.0, -1.0};
        partContacts(scene);
        means.push_back(estimate(scene).mean);
    }
    EXPECT_NEAR(means[0], means[2], 1e-4);
    EXPECT_NEAR(means[1], means[2], 1e-4);
    EXPECT_LT(means[2], 0.2);
}

TEST(Contacts, MoveNothingElse) {
    const auto keepsItsPlace = [](TestScene scene) {
        const TestScene before = scene;
        partContacts(scene);
        for (std::size_t i = 0; i < scene.meshes.size(); ++i)
            for (std::size_t k = 0; k < scene.meshes[i].triangles.size(); ++k)
                for (int corner = 0; corner < 3; ++corner)
                    if (scene.meshes[i].positions[scene.meshes[i].triangles[k].positions[corner]] !=
                        before.meshes[i].positions[before.meshes[i].triangles[k].positions[corner]])
                        return false;
        return true;
    };
    EXPECT_TRUE(keepsItsPlace(twoBoxes({glassOf(1.5f)}, 1.0, 1e-4)));
    TestScene overlapping = twoBoxes({glassOf(1.5f)}, 1.0, 0.0);
    overlapping.meshes[0] = box(0, {0.0, 0.0, 0.5}, {3.0, 3.0, 0.6});
    EXPECT_TRUE(keepsItsPlace(overlapping));
    EXPECT_TRUE(keepsItsPlace(twoBoxes({Material{}}, 1.0, 0.0))); // opaque
    TestScene beside = twoBoxes({glassOf(1.5f)}, 1.0, 0.0);       // with an edge in common
    beside.meshes[0] = box(0, {8.0, 0.0, 0.5}, {4.0, 4.0, 0.5});
    EXPECT_TRUE(keepsItsPlace(beside));
    EXPECT_FALSE(keepsItsPlace(twoBoxes({glassOf(1.5f)}, 1.0, 0.0)));
}

TEST(Contacts, MoveTheGlassOfLowerPriority) {
    TestScene scene = twoBoxes({glassOf(1.33f, 0), glassOf(1.5f, 1)}, 1.0, 0.0);
    const std::vector<glm::vec3> before = scene.meshes[1].positions;
    partContacts(scene);
    EXPECT_EQ(scene.meshes[1].positions, before);
    float lowest = 1.0f;
    for (const MeshTriangle &triangle : scene.meshes[0].triangles)
        lowest = std::min(lowest, scene.meshes[0].positions[triangle.positions.x].z);
    EXPECT_NEAR(lowest, -64.0 / 16777216.0 * 4.0, 1e-6); // 4 is the largest coordinate
}

TEST(Solids, AreClosedByIndexOrByPosition) {
    const std::vector<Material> materials = {glassOf(1.5f)};
    TriangleMesh two = hyalite::core::testing::tetrahedron();
    const auto corners = static_cast<std::uint32_t>(two.positions.size());
    const std::size_t count = two.triangles.size();
    for (std::size_t i = 0; i < count; ++i) {
        MeshTriangle triangle = two.triangles[i];
        triangle.positions += corners;
        two.triangles.push_back(triangle);
    }
    for (std::uint32_t i = 0; i < corners; ++i) // the first corner of one is at the second of the other
        two.positions.push_back(two.positions[i] + (two.positions[1] - two.positions[0]));
    EXPECT_EQ(solidsOf(hyalite::core::testing::icosphere(1), materials).count, 1u);
    EXPECT_EQ(solidsOf(box(0, glm::dvec3(0.0), glm::dvec3(1.0)), materials).count, 1u);
    EXPECT_EQ(solidsOf(two, materials).count, 2u);
    EXPECT_EQ(solidsOf(two, {Material{}}).count, 0u);
}

} // namespace
} // namespace hyalite::core::reference
