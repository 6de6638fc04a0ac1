// Names and numbers of what a scene has.
#include "host/scene/scene_names.h"

#include "host/scene/instances.h"
#include "tests/fixtures/geometry_fixture.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

using Names = std::vector<std::string>;

constexpr std::uint32_t firstTriangleId = 64;

TriangleMesh meshOf(std::uint32_t node, std::size_t triangleCount = 2) {
    TriangleMesh mesh;
    mesh.name = "a file";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles.assign(triangleCount, {{0, 1, 2}});
    mesh.node = node;
    return mesh;
}

TEST(SceneNames, AreThoseOfTheInputOrOfTheirPlaceInIt) {
    Scene scene;
    scene.spheres.resize(2);
    scene.materials.resize(3);
    scene.materials[0].name = "steel";
    scene.materials[2].name = "steel";
    scene.nodes = {{.name = "cat.obj", .kind = NodeKind::Mesh},
                   {.name = "box", .kind = NodeKind::Shape, .index = 4},
                   {.name = "car.glb", .kind = NodeKind::Mesh, .index = 1},
                   {.name = "wheel", .mesh = "round", .index = 7, .parent = 2},
                   {.mesh = "bolt", .index = 8, .parent = 3},
                   {.index = 9, .parent = 2},
                   {.name = "unused"}};
    for (const std::uint32_t node : {0u, 1u, 3u, 4u, 5u})
        scene.meshes.push_back(meshOf(node));
    const NumberedScene numbered = numberScene(scene, firstTriangleId);
    EXPECT_EQ(numbered.names.withSpheres(numbered.names.objects),
              (Names{"sphere 0", "sphere 1", "cat.obj", "box 4", "wheel", "bolt", "node 9"}));
    EXPECT_EQ(numbered.names.withSpheres(numbered.names.assets),
              (Names{"sphere 0", "sphere 1", "cat.obj", "box 4", "car.glb"}));
    EXPECT_EQ(numbered.names.materials, (Names{"steel", "material 1"}));
    EXPECT_EQ(numbered.materials, (std::vector<std::uint32_t>{1, 2, 1}))
        << "things of one name are one thing";
    ASSERT_EQ(numbered.places.size(), 7u);
    EXPECT_EQ(numbered.places[4].object, 5u);
    EXPECT_EQ(numbered.places[4].asset, 5u);
    EXPECT_EQ(numbered.places[6].asset, 5u);
}

TEST(SceneNames, AreCleanAndNameOneThing) {
    Scene scene;
    scene.spheres.resize(3);
    scene.nodes = {{.name = "a\n\x01\xff"},
                   {.name = "same"},
                   {.name = "same"},
                   {.name = "sphere 1"},
                   {.name = "sphere 01"}};
    for (std::uint32_t node = 0; node < scene.nodes.size(); ++node)
        scene.meshes.push_back(meshOf(node));
    scene.meshes.push_back(meshOf(noNode));
    const NumberedScene numbered = numberScene(scene, firstTriangleId);
    EXPECT_EQ(numbered.names.objects, (Names{"a\n\uFFFD\uFFFD", "same", "sphere 01", "a file"}));
    EXPECT_EQ(numbered.places[4].object, numbered.places[5].object);
    EXPECT_EQ(numbered.places[6].object, 2u) << "the second sphere has that name, too";
}

// Their first ids are those that packed triangles have.
TEST(SceneNames, PlacesBeginWhereTheirTrianglesDo) {
    Scene scene;
    scene.spheres.resize(1);
    scene.nodes = {{.name = "first"}, {.name = "many"}, {.name = "last"}};
    scene.meshes.push_back(meshOf(0, 5));
    const std::vector<Placement> placements(3);
    const std::vector<std::uint32_t> nodes(3, 1);
    addInstances(scene, meshOf(1, 4), placements, nodes);
    scene.meshes.push_back(meshOf(2, 0));
    scene.meshes.push_back(meshOf(2, 1));
    const NumberedScene numbered = numberScene(scene, firstTriangleId);
    std::vector<std::uint32_t> firsts;
    for (const layout::PlaceRecord &place : numbered.places)
        firsts.push_back(place.firstPrimitive);
    EXPECT_EQ(firsts, (std::vector<std::uint32_t>{0, 64, 69, 73, 77, 81, 81}));
    const InputOrder order = inputOrder(scene);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(firsts[2 + i], firstTriangleId + order.instances[i]);
    EXPECT_EQ(firsts[6], firstTriangleId + order.meshes[2]);
}

} // namespace
} // namespace hyalite::core
