// Names in the input: what they enclose, and which of them a user means.
#include "host/scene/scene_nodes.h"

#include "host/base/error.h"

#include <gtest/gtest.h>

#include <string>

namespace hyalite::core {
namespace {

TriangleMesh triangleAt(const glm::vec3 &corner, std::uint32_t node) {
    TriangleMesh mesh;
    mesh.positions = {corner, corner + glm::vec3(1, 0, 0), corner + glm::vec3(0, 1, 0), glm::vec3(1e6f)};
    mesh.triangles = {{{0, 1, 2}}}; // none uses the last position
    mesh.node = node;
    return mesh;
}

/// models/car.glb with the node "Body", and below it "Wheel", whose mesh "Disk" has two places; a box without a name; a
/// sphere.
Scene car() {
    Scene scene;
    scene.nodes = {{.name = "models/car.glb", .kind = NodeKind::Mesh},
                   {.name = "Body", .index = 4, .parent = 0},
                   {.name = "Wheel", .mesh = "Disk", .index = 7, .parent = 1},
                   {.name = "box", .kind = NodeKind::Shape},
                   {.name = "Empty", .index = 9, .parent = 0}};
    scene.meshes = {triangleAt({0, 0, 0}, 1)};
    Placement near;
    near.offset = {10, 0, 0};
    Placement far;
    far.offset = {20, 0, 0};
    const std::vector<std::uint32_t> nodes{2, 2};
    addInstances(scene, triangleAt({0, 0, 5}, noNode), std::vector{near, far}, nodes);
    scene.meshes.push_back(triangleAt({0, -50, 0}, 3));
    scene.spheres = {{.centre = {0, 0, -100}, .radius = 2.0}};
    return scene;
}

void expectBox(const Bounds &box, const glm::dvec3 &low, const glm::dvec3 &high) {
    EXPECT_EQ(box.low, low);
    EXPECT_EQ(box.high, high);
}

TEST(SceneNodes, EncloseWhatIsBelowThem) {
    const SceneBounds bounds = sceneBounds(car());
    expectBox(bounds.all, {-2, -50, -102}, {21, 2, 5});
    ASSERT_EQ(bounds.nodes.size(), 5u);
    expectBox(bounds.nodes[0], {0, 0, 0}, {21, 1, 5});
    expectBox(bounds.nodes[1], {0, 0, 0}, {21, 1, 5});
    expectBox(bounds.nodes[2], {10, 0, 5}, {21, 1, 5});
    expectBox(bounds.nodes[3], {0, -50, 0}, {1, -49, 0});
    EXPECT_GT(bounds.nodes[4].low.x, bounds.nodes[4].high.x) << "nothing";
}

TEST(SceneNodes, KeepTheirInstancesWhereTheseBecomeMeshes) {
    Scene scene = car();
    arrangeInstances(scene, Flattening::All);
    ASSERT_EQ(scene.meshes.size(), 4u);
    EXPECT_EQ(scene.meshes[1].node, 2u);
    EXPECT_EQ(scene.meshes[3].node, 3u);
    expectBox(sceneBounds(scene).nodes[2], {10, 0, 5}, {21, 1, 5});
}

TEST(SceneNodes, AreVisitedInTheOrderOfTheInput) {
    std::vector<std::uint32_t> nodes;
    visitObjects(car(), [&](const PlacedObject &object) { nodes.push_back(object.node); });
    EXPECT_EQ(nodes, (std::vector<std::uint32_t>{1, 2, 2, 3}));
}

TEST(SceneNodes, AreFoundByNodeMeshFileAndIndex) {
    const Scene scene = car();
    const SceneBounds bounds = sceneBounds(scene);
    for (const char *name : {"Wheel", "Disk", "7"})
        expectBox(boundsNamed(scene, bounds, name), {10, 0, 5}, {21, 1, 5});
    for (const char *name : {"models/car.glb", "car.glb", "models/car", "car", "Body", "4"})
        expectBox(boundsNamed(scene, bounds, name), {0, 0, 0}, {21, 1, 5});
    expectBox(boundsNamed(scene, bounds, "box"), {0, -50, 0}, {1, -49, 0});
}

TEST(SceneNodes, OfOtherNamesAreRefusedWithAList) {
    const Scene scene = car();
    for (const std::string name : {"wheel", "Empty", "9", "", "3"})
        try {
            static_cast<void>(boundsNamed(scene, sceneBounds(scene), name));
            ADD_FAILURE() << name;
        } catch (const Error &error) {
            EXPECT_EQ(error.kind, ErrorKind::Usage);
            const std::string message = error.what();
            EXPECT_NE(message.find("\"Body\", \"Disk\", \"Wheel\", \"box\", \"models/car.glb\""),
                      std::string::npos)
                << message;
            EXPECT_EQ(message.find("did you mean \"Wheel\"") != std::string::npos, name == "wheel")
                << message;
        }
    const Scene nothing;
    EXPECT_THROW(static_cast<void>(boundsNamed(nothing, sceneBounds(nothing), "a")), Error);
}

} // namespace
} // namespace hyalite::core
