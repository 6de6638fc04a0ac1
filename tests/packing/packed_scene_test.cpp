#include "host/packing/packed_scene.h"

#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/leaves.h"

#include <functional>
#include <optional>
#include <tuple>

namespace hyalite::core {
namespace {

using testing::packed;
using testing::Random;
using testing::Tally;

/// Walks the packed tree as a kernel does, checks the boxes, and returns the ids of each leaf in turn.
struct Walk {
    std::vector<std::vector<std::uint32_t>> leaves;
    std::vector<int> visits; ///< of each node
    int depth = 0;           ///< inner nodes on the longest way down
    bool areBoxesRight = true;

    explicit Walk(const PackedScene &scene) : visits(scene.nodes.size(), 0) { visitNode(scene, 0, 1); }

  private:
    static Box boxOf(const layout::TriangleRecord &triangle) {
        Box box;
        box.extend(triangle.v0);
        box.extend(triangle.v1);
        box.extend(triangle.v2);
        return box;
    }

    Box visitChild(const PackedScene &scene, std::uint32_t child, const Box &box, int level) {
        Box content;
        if (child == layout::noNode)
            return content;
        if ((child & layout::leafFlag) == 0) {
            content = visitNode(scene, child, level + 1);
        } else {
            leaves.emplace_back();
            for (std::size_t record = child & ~layout::leafFlag;; ++record) {
                content.extend(boxOf(scene.triangles.at(record)));
                leaves.back().push_back(scene.triangles.at(record).primitiveId);
                if ((scene.triangles.at(record).flags & layout::triangleEndsLeaf) != 0)
                    break;
            }
        }
        areBoxesRight = areBoxesRight && box.lower == content.lower && box.upper == content.upper;
        return content;
    }

    Box visitNode(const PackedScene &scene, std::uint32_t index, int level) {
        ++visits.at(index);
        const layout::NodePair &node = scene.nodes.at(index);
        if (node.right != layout::noNode) // else the root of a single leaf
            depth = std::max(depth, level);
        Box box = visitChild(scene, node.left, {node.leftLower, node.leftUpper}, level);
        box.extend(visitChild(scene, node.right, {node.rightLower, node.rightUpper}, level));
        return box;
    }
};

TEST(PackedScene, WalksBackToTheSameTrianglesWithTightBoxes) {
    Random random(701);
    for (const std::size_t count : {2, 3, 9, 100, 1000}) {
        const Scene scene = testing::sceneOf(testing::triangleSoup(random, count, 1.0, 0.1));
        for (const TreeKind kind : {TreeKind::None, TreeKind::Midpoint, TreeKind::Sah}) {
            for (const int leafSize : {1, 4, 64}) {
                SCOPED_TRACE(fmt::format("{} triangles, kind {}, leaf size {}", count, static_cast<int>(kind),
                                         leafSize));
                const Bvh bvh = buildBvh(kind, buildTriangles(scene), leafSize);
                const PackedScene result = packScene(scene, bvh);
                const Walk walk(result);
                EXPECT_TRUE(walk.areBoxesRight);
                EXPECT_TRUE(std::ranges::all_of(walk.visits, [](int visits) { return visits == 1; }));
                EXPECT_EQ(result.treeDepth, bvh.depth);
                EXPECT_EQ(walk.depth, bvh.depth);
                std::vector<std::uint32_t> ids;
                for (const std::vector<std::uint32_t> &leaf : walk.leaves) {
                    EXPECT_TRUE(kind == TreeKind::None || leaf.size() <= static_cast<std::size_t>(leafSize));
                    ids.insert(ids.end(), leaf.begin(), leaf.end());
                }
                std::sort(ids.begin(), ids.end());
                ASSERT_EQ(ids.size(), count);
                for (std::uint32_t i = 0; i < count; ++i)
                    EXPECT_EQ(ids[i], layout::minFirstTriangleId + i);
                EXPECT_EQ(result.nodes.size(), std::max<std::size_t>(1, walk.leaves.size() - 1));
            }
        }
    }
}

TEST(PackedScene, ARecordHasItsCornersNormalsMaterialAndFlags) {
    Scene scene;
    scene.materials.resize(3);
    scene.materials[1].kind = MaterialKind::Dielectric;
    scene.materials[2].kind = MaterialKind::Mirror;
    for (std::uint32_t m = 0; m < 3; ++m) {
        TriangleMesh mesh;
        mesh.materialIndex = m;
        const float x = 10.0f * static_cast<float>(m);
        mesh.positions = {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}, {x, 0, 1}};
        mesh.normals = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
        mesh.triangles = {{{0, 1, 2}, {0, 1, 2}}, {{3, 1, 0}}};
        scene.meshes.push_back(mesh);
    }
    const PackedScene result = packed(scene, TreeKind::Midpoint, 1);
    ASSERT_EQ(result.triangles.size(), 6u);
    ASSERT_EQ(result.normals.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        const layout::TriangleRecord &triangle = result.triangles[i];
        const std::uint32_t input = triangle.primitiveId - layout::minFirstTriangleId;
        const TriangleMesh &mesh = scene.meshes[input / 2];
        const MeshTriangle &corner = mesh.triangles[input % 2];
        EXPECT_EQ(triangle.v0, mesh.positions[corner.positions.x]);
        EXPECT_EQ(triangle.v1, mesh.positions[corner.positions.y]);
        EXPECT_EQ(triangle.v2, mesh.positions[corner.positions.z]);
        const std::uint32_t glassFirst[] = {1, 0, 2};
        EXPECT_EQ(triangle.materialIndex, glassFirst[input / 2]);
        EXPECT_EQ(triangle.flags & layout::triangleIsTransmissive,
                  input / 2 == 1 ? layout::triangleIsTransmissive : 0u);
        EXPECT_EQ(triangle.flags & layout::triangleEndsLeaf, layout::triangleEndsLeaf) << "leaves of one";
        const bool hasNormals = input % 2 == 0;
        EXPECT_EQ(result.normals[i].n0, hasNormals ? glm::vec3(0, 0, 1) : glm::vec3(0));
        EXPECT_EQ(result.normals[i].n1, hasNormals ? glm::vec3(0, 1, 0) : glm::vec3(0));
        EXPECT_EQ(result.normals[i].n2, hasNormals ? glm::vec3(1, 0, 0) : glm::vec3(0));
    }
    EXPECT_EQ(result.frame.boundsLower, glm::vec3(0, 0, 0));
    EXPECT_EQ(result.frame.boundsUpper, glm::vec3(21, 1, 1));
    EXPECT_EQ(result.frame.triangleCount, 6u);
}

TEST(PackedScene, TheHashIsOfWhatThereIsToSee) {
    Random random(702);
    Scene scene = testing::sceneOf(testing::triangleSoup(random, 50, 1.0, 0.1));
    scene.spheres.push_back({{1, 2, 3}, 0.5, 0, false});
    const std::uint64_t hash = packed(scene).contentHash();
    for (const TreeKind kind : {TreeKind::None, TreeKind::Midpoint, TreeKind::Sah})
        for (const int leafSize : {1, 4, 64})
            EXPECT_EQ(packed(scene, kind, leafSize).contentHash(), hash);
    const auto changed = [&](const std::function<void(Scene &)> &change) {
        Scene other = scene;
        change(other);
        return packed(other).contentHash();
    };
    EXPECT_NE(changed([](Scene &other) { other.camera.position.x += 1.0; }), hash);
    EXPECT_NE(changed([](Scene &other) { other.camera.width += 1; }), hash);
    EXPECT_NE(changed([](Scene &other) { other.background.x = 0.5f; }), hash);
    EXPECT_NE(changed([](Scene &other) { other.shadowThroughGlass = 0.5f; }), hash);
    EXPECT_NE(changed([](Scene &other) { other.lights.push_back({}); }), hash);
    EXPECT_NE(changed([](Scene &other) { other.materials[0].albedo.x *= 0.5f; }), hash);
    EXPECT_NE(changed([](Scene &other) { other.spheres[0].radius *= 2.0; }), hash);
    EXPECT_NE(changed([](Scene &other) { other.spheres.push_back(other.spheres[0]); }), hash);
    EXPECT_NE(changed([](Scene &other) { other.meshes[0].positions[4].y += 0.001f; }), hash);
    EXPECT_NE(
        changed([](Scene &other) { std::swap(other.meshes[0].triangles[3], other.meshes[0].triangles[4]); }),
        hash);
}

TEST(PackedScene, AnEmptySceneHasARootWithoutChildren) {
    Scene scene;
    scene.background = {1, 2, 3};
    scene.shadowThroughGlass = 0.25f;
    const PackedScene result = packed(scene);
    ASSERT_EQ(result.nodes.size(), 1u);
    EXPECT_EQ(result.nodes[0].left, layout::noNode);
    EXPECT_EQ(result.nodes[0].right, layout::noNode);
    EXPECT_FALSE(result.hasTriangles);
    EXPECT_FALSE(result.hasSpecular);
    EXPECT_FALSE(result.hasDielectric);
    EXPECT_EQ(result.treeDepth, 0);
    EXPECT_EQ(result.frame.triangleCount, 0u);
    EXPECT_EQ(result.frame.lightCount, 0u);
    EXPECT_EQ(result.frame.background, glm::vec3(1, 2, 3));
    EXPECT_EQ(result.frame.shadowThroughGlass, 0.25f);
    EXPECT_EQ(result.sizeBytes(), sizeof(layout::FrameRecord) + sizeof(layout::NodePair) +
                                      layout::filterCellCount * sizeof(layout::LookupRow));
}

TEST(PackedScene, ASingleTriangleIsTheRootsLeftLeaf) {
    Scene scene = testing::sceneOf({});
    testing::addTriangle(scene.meshes[0], {1, 2, 3}, {4, 2, 3}, {1, 5, 6});
    for (const TreeKind kind : {TreeKind::None, TreeKind::Midpoint, TreeKind::Sah}) {
        const PackedScene result = packed(scene, kind, 1);
        ASSERT_EQ(result.nodes.size(), 1u);
        EXPECT_EQ(result.nodes[0].left, layout::leafFlag);
        EXPECT_EQ(result.nodes[0].right, layout::noNode);
        EXPECT_EQ(result.nodes[0].leftLower, glm::vec3(1, 2, 3));
        EXPECT_EQ(result.nodes[0].leftUpper, glm::vec3(4, 5, 6));
        EXPECT_EQ(result.triangles[0].flags, layout::triangleEndsLeaf);
        EXPECT_EQ(result.triangles[0].primitiveId, layout::minFirstTriangleId);
        EXPECT_TRUE(result.hasTriangles);
        EXPECT_EQ(result.sizeBytes(), sizeof(layout::FrameRecord) + sizeof(layout::NodePair) +
                                          sizeof(layout::TriangleRecord) + sizeof(layout::NormalRecord) +
                                          sizeof(layout::MaterialRecord) + sizeof(layout::PlaceRecord) +
                                          layout::filterCellCount * sizeof(layout::LookupRow));
    }
}

TEST(PackedScene, FeaturesAreThoseOfTheMaterialsInUse) {
    Scene scene;
    scene.materials.resize(3);
    scene.materials[1].kind = MaterialKind::Mirror;
    scene.materials[2].kind = MaterialKind::Dielectric;
    const auto features = [&](std::uint32_t sphereMaterial, std::optional<std::uint32_t> meshMaterial) {
        Scene used = scene;
        used.spheres.push_back({{0, 0, 0}, 1.0, sphereMaterial, false});
        if (meshMaterial) {
            used.meshes.emplace_back();
            used.meshes[0].materialIndex = *meshMaterial;
            testing::addTriangle(used.meshes[0], {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
        }
        const PackedScene result = packed(used);
        return std::tuple(result.hasTriangles, result.hasSpecular, result.hasDielectric);
    };
    EXPECT_EQ(features(0, {}), std::tuple(false, false, false)) << "unused materials do not count";
    EXPECT_EQ(features(1, {}), std::tuple(false, true, false));
    EXPECT_EQ(features(2, {}), std::tuple(false, true, true));
    EXPECT_EQ(features(0, 0), std::tuple(true, false, false));
    EXPECT_EQ(features(0, 1), std::tuple(true, true, false));
    EXPECT_EQ(features(0, 2), std::tuple(true, true, true));
    EXPECT_EQ(features(2, 0), std::tuple(true, true, true));
}

TEST(PackedScene, SpheresLightsAndMaterialsAreCopied) {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[1].kind = MaterialKind::Dielectric;
    scene.materials[1].albedo = {0.1f, 0.2f, 0.3f};
    scene.materials[1].twoSided = true;
    scene.materials[1].refractiveIndex = 1.7f;
    scene.materials[1].segmentTint = {0.4f, 0.5f, 0.6f};
    scene.spheres.push_back({{1, 2, 3}, 4.0, 1, true});
    scene.spheres.push_back({{5, 6, 7}, 8.0, 0, false});
    scene.lights.push_back({{1, 1, 1}, glm::dvec3(4.0 * std::numbers::pi, 0.0, 8.0 * std::numbers::pi)});
    const PackedScene result = packed(scene);
    ASSERT_EQ(result.spheres.size(), 2u);
    EXPECT_EQ(result.spheres[0].centre, glm::vec3(1, 2, 3));
    EXPECT_EQ(result.spheres[0].radius, 4.0f);
    EXPECT_EQ(materialIndexOf(result.spheres[0]), 0u) << "glass comes first";
    EXPECT_EQ(materialIndexOf(result.spheres[1]), 1u);
    EXPECT_EQ(normalSignOf(result.spheres[0]), -1.0f);
    EXPECT_EQ(normalSignOf(result.spheres[1]), 1.0f);
    ASSERT_EQ(result.lights.size(), 1u);
    EXPECT_EQ(result.frame.lightCount, 1u);
    EXPECT_EQ(result.lights[0].position, glm::vec3(1));
    EXPECT_EQ(result.lights[0].intensity, glm::vec3(1, 0, 2)) << "power / 4 pi";
    ASSERT_EQ(result.materials.size(), 2u);
    EXPECT_EQ(kindOf(result.materials[0]), layout::materialDielectric);
    EXPECT_EQ(result.materials[0].albedo, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(result.materials[0].segmentTint, glm::vec3(0.4f, 0.5f, 0.6f));
    EXPECT_EQ(result.materials[0].refractiveIndex, 1.7f);
    EXPECT_TRUE(isTwoSided(result.materials[0]));
    EXPECT_FALSE(isTwoSided(result.materials[1]));
}

TEST(PackedScene, LightsAreReplacedAsIfAllWerePackedAnew) {
    for (const LightChoice choice : {LightChoice::Power, LightChoice::Tree}) {
        Scene scene;
        scene.materials.resize(2);
        scene.materials[1].emission = glm::vec3(2.0f);
        scene.spheres.push_back({{0, 0, 0}, 1.0, 1, false});
        scene.meshes.emplace_back();
        hyalite::core::testing::addTriangle(scene.meshes[0], {0, 0, 0}, {4, 0, 0}, {0, 2, 0});
        scene.meshes[0].materialIndex = 1;
        scene.lights = {{{1, 1, 1}, glm::dvec3(8.0)}, {{2, 1, 1}, glm::dvec3(3.0)}};
        const Bvh bvh = buildBvh(TreeKind::Sah, buildTriangles(scene), 1);
        PackedScene result = packScene(scene, bvh, {.lightChoice = choice});
        const std::uint64_t serial = result.serial;
        scene.lights = {{{-9, 1, 1}, glm::dvec3(1.0)},
                        {{5, 5, 5}, glm::dvec3(2.0), LightKind::Directional},
                        {{0, 8, 1}, glm::dvec3(4.0), LightKind::Spot}};
        packLights(scene, choice, result);
        const PackedScene expected = packScene(scene, bvh, {.lightChoice = choice});
        EXPECT_NE(result.serial, serial) << "a device must not take it for the scene before";
        EXPECT_NE(result.serial, expected.serial);
        for (std::size_t i = 0; i < expected.arrays().size(); ++i)
            EXPECT_TRUE(std::ranges::equal(result.arrays()[i].bytes, expected.arrays()[i].bytes))
                << expected.arrays()[i].name;
        EXPECT_EQ(result.contentHash(), expected.contentHash());
        EXPECT_EQ(result.lighting, expected.lighting);
        EXPECT_EQ(result.infiniteEmitterCount, expected.infiniteEmitterCount);
    }
}

TEST(PackedScene, DielectricsComeFirstByPriority) {
    Scene scene;
    scene.materials.resize(5);
    for (const std::size_t i : {1u, 3u, 4u})
        scene.materials[i].kind = MaterialKind::Dielectric;
    scene.materials[3].priority = 2;
    for (std::size_t i = 0; i < 5; ++i)
        scene.materials[i].albedo.x = 0.1f * static_cast<float>(i);
    for (std::uint32_t i = 0; i < 5; ++i)
        scene.spheres.push_back({{0, 0, 0}, 1.0, i, false});
    const PackedScene result = packed(scene);
    for (std::uint32_t i = 0; i < 5; ++i)
        EXPECT_EQ(result.materials[materialIndexOf(result.spheres[i])].albedo, scene.materials[i].albedo)
            << i;
    EXPECT_EQ(materialIndexOf(result.spheres[3]), 0u);
    EXPECT_EQ(materialIndexOf(result.spheres[1]), 1u);
    EXPECT_EQ(materialIndexOf(result.spheres[4]), 2u);
}

// ---- Emitters

TEST(Emitters, AreChosenByPowerInTheOrderOfTheInput) {
    Scene scene;
    scene.materials.resize(3);
    scene.materials[1].emission = glm::vec3(2.0f);
    scene.materials[2].emission = glm::vec3(1.0f);
    scene.materials[2].twoSided = true;
    scene.lights.push_back({{1, 1, 1}, glm::dvec3(8.0 * std::numbers::pi)});
    scene.lights.push_back({{2, 1, 1}, glm::dvec3(0.0)});
    scene.spheres.push_back({{0, 0, 0}, 1.0, 0, false}); // dark
    scene.spheres.push_back({{0, 0, 0}, 1.0, 1, false}); // pi * 2 * 4 pi
    scene.meshes.emplace_back();
    hyalite::core::testing::addTriangle(scene.meshes[0], {0, 0, 0}, {4, 0, 0},
                                        {0, 2, 0}); // pi * 1 * 4 on each side
    hyalite::core::testing::addTriangle(scene.meshes[0], {0, 0, 0}, {1, 0, 0}, {2, 0, 0}); // without area
    scene.meshes[0].materialIndex = 2;
    const PackedScene result = packed(scene, TreeKind::Sah, 1);
    const double total =
        8.0 * std::numbers::pi + 8.0 * std::numbers::pi * std::numbers::pi + 8.0 * std::numbers::pi;
    ASSERT_EQ(result.emitters.size(), 3u);
    EXPECT_EQ(result.lighting, layout::lightsByPoints | layout::lightsBySpheres | layout::lightsByTriangles);
    EXPECT_EQ(result.emitters[0].kind, layout::emitterPoint);
    EXPECT_EQ(result.emitters[1].kind, layout::emitterSphere);
    EXPECT_EQ(result.emitters[1].record, 1u);
    EXPECT_EQ(result.emitters[2].kind, layout::emitterTriangle);
    EXPECT_EQ(result.triangles[result.emitters[2].record].primitiveId, layout::minFirstTriangleId);
    EXPECT_NEAR(result.emitters[0].probability, 8.0 * std::numbers::pi / total, 1e-7);
    EXPECT_NEAR(result.emitters[1].probability, 8.0 * std::numbers::pi * std::numbers::pi / total, 1e-7);
    EXPECT_NEAR(result.emitters[2].probability, 8.0 * std::numbers::pi / total, 1e-7);
    EXPECT_NEAR(result.emitters[2].pdf, result.emitters[2].probability / 4.0, 1e-7);
    EXPECT_NEAR(result.materials[2].emitterPdf, result.emitters[2].pdf, 1e-7);
    EXPECT_NEAR(result.materials[1].emitterPdf, result.emitters[1].pdf, 1e-7);
    EXPECT_EQ(result.emitters[2].cumulative, 0xFFFFFFFFu);
    EXPECT_TRUE(result.hasEmission);
}

// ---- The camera

/// The closed form: a pinhole whose image plane at distance 1 is 2 tan(fov/2) wide.
glm::dvec3 expectedDirection(const Camera &camera, double x, double y) {
    const glm::dvec3 forward = glm::normalize(camera.direction);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::dvec3 up = glm::cross(right, forward);
    const double halfWidth = std::tan(camera.horizontalFovDegrees * std::numbers::pi / 360.0);
    const double halfHeight = halfWidth * camera.height / camera.width;
    return glm::normalize(forward + right * (halfWidth * (2.0 * x / camera.width - 1.0)) +
                          up * (halfHeight * (1.0 - 2.0 * y / camera.height)));
}

TEST(Camera, PrimaryDirectionsFollowTheClosedForm) {
    Random random(702);
    Tally wrong("primary directions unlike the closed form", random.seed());
    Tally wrongInDouble("the same in double, up to the frame's float vectors", random.seed());
    for (const auto &[width, height] :
         {std::pair(1, 1), {2, 1}, {333, 217}, {217, 333}, {1, 200}, {512, 512}, {7, 5}}) {
        for (int trial = 0; trial < 20; ++trial) {
            Scene scene;
            scene.camera.width = width;
            scene.camera.height = height;
            scene.camera.horizontalFovDegrees = random.uniform(1.0, 150.0);
            scene.camera.position = random.inCube(100.0);
            scene.camera.direction = random.direction() * random.logUniform(1e-3, 1e3);
            do
                scene.camera.up = random.direction() * random.logUniform(1e-3, 1e3);
            while (std::abs(glm::dot(glm::normalize(scene.camera.up),
                                     glm::normalize(scene.camera.direction))) > 0.99);
            const PackedScene result = packed(scene);
            // A few roundings of the unit vector, and of the position in the image: u times its size in pixels.
            const double pixelSize =
                2.0 * std::tan(scene.camera.horizontalFovDegrees * std::numbers::pi / 360.0) / width;
            const double tolerance = 1e-6 + 0x1p-23 * (width + height) * pixelSize;
            EXPECT_EQ(result.frame.eye, glm::vec3(scene.camera.position));
            EXPECT_EQ(result.frame.imageWidth, static_cast<std::uint32_t>(width));
            EXPECT_EQ(result.frame.imageHeight, static_cast<std::uint32_t>(height));
            for (int i = 0; i < 200; ++i) {
                const glm::uvec2 pixel(random.below(static_cast<std::size_t>(width)),
                                       random.below(static_cast<std::size_t>(height)));
                const glm::vec2 offset(static_cast<float>(random.uniform()),
                                       static_cast<float>(random.uniform()));
                const glm::dvec3 expected =
                    expectedDirection(scene.camera, pixel.x + static_cast<double>(offset.x),
                                      pixel.y + static_cast<double>(offset.y));
                const glm::vec3 direction = reference::primaryDirection<float>(result.frame, pixel, offset);
                const glm::dvec3 wide =
                    reference::primaryDirection<double>(result.frame, pixel, glm::dvec2(offset));
                wrong.check(glm::distance(glm::dvec3(direction), expected) < tolerance &&
                            std::abs(glm::length(glm::dvec3(direction)) - 1.0) < 3e-7);
                wrongInDouble.check(glm::distance(wide, expected) < 3e-7);
            }
        }
    }
    wrong.expectNone();
    wrongInDouble.expectNone();
}

TEST(Camera, TheHorizontalFieldOfViewEndsAtTheImagesEdges) {
    for (const double fov : {10.0, 60.0, 90.0, 120.0}) {
        for (const auto &[width, height] : {std::pair(101, 33), {33, 101}}) {
            Scene scene;
            scene.camera.horizontalFovDegrees = fov;
            scene.camera.width = width;
            scene.camera.height = height;
            const PackedScene result = packed(scene);
            const auto at = [&](double x, double y) {
                return reference::primaryDirection<double>(result.frame, {0, 0}, {x, y});
            };
            const double middle = height / 2.0;
            const double half = std::tan(fov * std::numbers::pi / 360.0);
            EXPECT_NEAR(at(0, middle).x / -at(0, middle).z, -half, 1e-6 * half);
            EXPECT_NEAR(at(width, middle).x / -at(width, middle).z, half, 1e-6 * half);
            const double between = std::acos(glm::dot(at(0, middle), at(width, middle)));
            EXPECT_NEAR(between * 180.0 / std::numbers::pi, fov, 1e-4);
            // Square pixels: the vertical one follows from the aspect.
            EXPECT_NEAR(at(width / 2.0, 0).y / -at(width / 2.0, 0).z, half * height / width, 1e-6 * half);
        }
    }
}

TEST(Camera, TopLeftIsUpAndLeft) {
    Scene scene; // looks down -z with +y up
    scene.camera.width = 3;
    scene.camera.height = 3;
    const layout::FrameRecord frame = packed(scene).frame;
    const auto centreOf = [&](std::uint32_t x, std::uint32_t y) {
        return reference::primaryDirection<float>(frame, {x, y}, {0.5f, 0.5f});
    };
    EXPECT_EQ(centreOf(1, 1), glm::vec3(0, 0, -1));
    EXPECT_LT(centreOf(0, 1).x, 0.0f);
    EXPECT_EQ(centreOf(0, 1).y, 0.0f);
    EXPECT_GT(centreOf(1, 0).y, 0.0f);
    EXPECT_LT(centreOf(1, 2).y, 0.0f);
    EXPECT_GT(centreOf(2, 1).x, 0.0f);
    EXPECT_EQ(centreOf(0, 0).x, -centreOf(2, 2).x);
    // A tilted up vector turns the picture: with +x up, the top is at +x and the left at +y.
    scene.camera.up = {1, 0, 0};
    const layout::FrameRecord turned = packed(scene).frame;
    EXPECT_GT(reference::primaryDirection<float>(turned, {1, 0}, {0.5f, 0.5f}).x, 0.0f);
    EXPECT_GT(reference::primaryDirection<float>(turned, {0, 1}, {0.5f, 0.5f}).y, 0.0f);
}

} // namespace
} // namespace hyalite::core
