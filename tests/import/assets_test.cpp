// A SCENE argument means the file it should, and the shipped scenes hold the numbers of the report.
#include "host/import/assets.h"
#include "host/import/scene_json.h"

#include "host/base/error.h"
#include "host/import/load.h"
#include "host/scene/validate.h"
#include "tests/fixtures/temporary_folder.h"
#include "tests/fixtures/test_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {
namespace {

const std::filesystem::path sourceDir = HYALITE_SOURCE_DIR;

/// A folder of its own, which $HYALITE_ASSETS names while the test runs.
class Assets : public ::testing::Test {
  protected:
    void SetUp() override {
        if (const char *set = std::getenv("HYALITE_ASSETS"))
            setBefore_ = set;
        std::filesystem::create_directories(folder / "scenes");
        setenv("HYALITE_ASSETS", folder.c_str(), 1);
    }
    void TearDown() override {
        if (setBefore_)
            setenv("HYALITE_ASSETS", setBefore_->c_str(), 1);
        else
            unsetenv("HYALITE_ASSETS");
    }

    void add(const std::string &name, const std::string &text = "{}") const {
        std::ofstream(folder / "scenes" / name) << text;
    }

    const testing::TemporaryFolder temporary_;
    const std::filesystem::path &folder = temporary_.path;

  private:
    std::optional<std::string> setBefore_;
};

std::string refusal(const std::string &argument) {
    try {
        static_cast<void>(resolveScene(argument));
    } catch (const Error &error) {
        EXPECT_EQ(error.kind, ErrorKind::BadInput);
        return error.what();
    }
    return {};
}

bool contains(const std::string &text, const std::string &part) {
    return text.find(part) != std::string::npos;
}

TEST_F(Assets, TheVariableComesBeforeTheFolderBesideTheProgram) {
    const std::filesystem::path beside =
        std::filesystem::canonical("/proc/self/exe").parent_path().parent_path() / "share" / "hyalite";
    EXPECT_EQ(assetFolders(), (std::vector<std::filesystem::path>{folder, beside}));
    unsetenv("HYALITE_ASSETS");
    EXPECT_EQ(assetFolders(), (std::vector<std::filesystem::path>{beside}));
    setenv("HYALITE_ASSETS", "", 1);
    EXPECT_EQ(assetFolders(), (std::vector<std::filesystem::path>{beside}));
}

TEST_F(Assets, ABareWordIsAShippedScene) {
    add("zebra-crossing.json");
    EXPECT_EQ(resolveScene("zebra-crossing"), folder / "scenes" / "zebra-crossing.json");
}

TEST_F(Assets, AShippedSceneMayBeABinaryGltfFile) {
    add("yak.glb");
    EXPECT_EQ(resolveScene("yak"), folder / "scenes" / "yak.glb");
    const std::vector<std::string> names = availableScenes();
    EXPECT_EQ(std::count(names.begin(), names.end(), "yak"), 1);
    add("yak.json");
    EXPECT_EQ(resolveScene("yak"), folder / "scenes" / "yak.json");
    const std::vector<std::string> namesOnce = availableScenes();
    EXPECT_EQ(std::count(namesOnce.begin(), namesOnce.end(), "yak"), 1);
}

TEST_F(Assets, AnArgumentWithAnExtensionIsAPathAsItStands) {
    for (const char *path : {"a.json", "no/such/b.obj", "/c.JSON", "../d.Obj"})
        EXPECT_EQ(resolveScene(path), std::filesystem::path(path));
}

TEST_F(Assets, AnUnknownNameListsThePlacesAndTheNames) {
    add("zebra.json");
    add("ant.json");
    add("ant.obj");
    const std::string message = refusal("gnu");
    EXPECT_TRUE(contains(message, "\"gnu\"")) << message;
    for (const std::filesystem::path &place : assetFolders())
        EXPECT_TRUE(contains(message, (place / "scenes" / "gnu.json").string())) << message;
    EXPECT_TRUE(contains(message, "ant, ")) << message;
    EXPECT_TRUE(contains(message, "zebra")) << message;
}

TEST_F(Assets, NamesAreSortedAndOnlyOfSceneFiles) {
    add("zebra.json");
    add("ant.json");
    add("bee.obj");
    const std::vector<std::string> names = availableScenes();
    EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
    EXPECT_EQ(std::count(names.begin(), names.end(), "ant"), 1);
    EXPECT_EQ(std::count(names.begin(), names.end(), "zebra"), 1);
    EXPECT_EQ(std::count(names.begin(), names.end(), "bee"), 0);
}

TEST_F(Assets, MissingFoldersHoldNoScenes) {
    setenv("HYALITE_ASSETS", (folder / "nowhere").c_str(), 1);
    EXPECT_TRUE(contains(refusal("gnu"), (folder / "nowhere" / "scenes" / "gnu.json").string()));
}

TEST_F(Assets, AnythingElseIsRefused) {
    for (const char *argument : {"", "foo.txt", "a/b", ".", "..", "../scenes/spheres", "spheres.json.gz"})
        EXPECT_TRUE(contains(refusal(argument), "ends in .json, .gltf, ")) << argument;
}

TEST_F(Assets, ASceneIsLoadedByItsName) {
    add("ant.json", R"({"camera": {"width": 7}})");
    const LoadedScene loaded = loadScene("ant");
    EXPECT_EQ(loaded.file, folder / "scenes" / "ant.json");
    EXPECT_EQ(loaded.scene.camera.width, 7);
}

TEST_F(Assets, ASceneIsValidatedWhenLoaded) {
    add("ant.json", R"({"camera": {"direction": [0, 1, 0]}})");
    EXPECT_THROW(static_cast<void>(loadScene("ant")), Error);
}

// ---- The shipped scenes

struct ExpectedSphere {
    glm::dvec3 centre;
    double radius;
    const char *material;
    bool inwardNormal = false;
};

const std::vector<ExpectedSphere> roomSpheres = {
    {{0, 0, -1000}, 940, "back wall"}, {{0, 0, 1000}, 940, "front wall"}, {{0, -1000, 0}, 990, "floor"},
    {{-1000, 0, 0}, 940, "left wall"}, {{1000, 0, 0}, 940, "right wall"}, {{0, 1000, 0}, 940, "ceiling"},
};
const std::vector<ExpectedSphere> ballSpheres = {{{-20, 0, 0}, 10, "mirror"},
                                                 {{0, 0, 0}, 10, "glass"},
                                                 {{20, 0, 0}, 10, "glass"},
                                                 {{20, 0, 0}, 9.9, "glass", true}};
const std::vector<ExpectedSphere> nestedSpheres = {
    {{20, 0, 0}, 9.8, "glass"}, {{20, 0, 0}, 9.7, "glass", true}, {{20, 0, 0}, 9.6, "glass"}};

const Material &materialNamed(const Scene &scene, const std::string &name) {
    for (const Material &material : scene.materials)
        if (material.name == name)
            return material;
    throw std::runtime_error("no material " + name);
}

void expectSpheres(const Scene &scene, const std::vector<std::vector<ExpectedSphere>> &groups) {
    std::size_t index = 0;
    for (const std::vector<ExpectedSphere> &group : groups)
        for (const ExpectedSphere &expected : group) {
            ASSERT_LT(index, scene.spheres.size());
            const Sphere &sphere = scene.spheres[index++];
            EXPECT_EQ(sphere.centre, expected.centre) << index;
            EXPECT_EQ(sphere.radius, expected.radius) << index;
            EXPECT_EQ(scene.materials.at(sphere.materialIndex).name, expected.material) << index;
            EXPECT_EQ(sphere.inwardNormal, expected.inwardNormal) << index;
        }
    EXPECT_EQ(index, scene.spheres.size());
}

/// What the three scenes share: the room, the camera and the light.
void expectRoom(const TestScene &scene, int spp, int maxDepth) {
    EXPECT_EQ(scene.camera.position, glm::dvec3(0, 0, 55));
    EXPECT_EQ(scene.camera.direction, glm::dvec3(0, 0, -1));
    EXPECT_EQ(scene.camera.up, glm::dvec3(0, 1, 0));
    EXPECT_EQ(scene.camera.horizontalFovDegrees, 60.0);
    EXPECT_EQ(scene.camera.width, 512);
    EXPECT_EQ(scene.camera.height, 512);
    EXPECT_EQ(scene.background, glm::vec3(0.0f));
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].position, glm::dvec3(-10, 20, 40));
    EXPECT_EQ(scene.lights[0].power, glm::dvec3(1e5));

    const std::pair<const char *, glm::vec3> walls[] = {
        {"back wall", {.4f, .8f, .7f}}, {"front wall", {.9f, .4f, .3f}}, {"floor", {.3f, .4f, .7f}},
        {"left wall", {.5f, .5f, .6f}}, {"right wall", {.6f, .5f, .1f}}, {"ceiling", {.2f, .5f, .9f}}};
    for (const auto &[name, albedo] : walls) {
        EXPECT_EQ(materialNamed(scene, name).kind, MaterialKind::Diffuse) << name;
        EXPECT_EQ(materialNamed(scene, name).albedo, albedo) << name;
    }
    EXPECT_EQ(scene.settings.integrator, Integrator::Whitted);
    EXPECT_EQ(scene.settings.sampler, SamplerKind::Sobol);
    EXPECT_EQ(scene.settings.samplesPerPixel, spp);
    EXPECT_EQ(scene.settings.maxDepth, maxDepth);
    EXPECT_EQ(scene.settings.exposureStops, 0.0);
    EXPECT_EQ(scene.shadowThroughGlass, 0.8f);
    EXPECT_NO_THROW(validateScene(scene, "shipped"));
}

void expectMirrorAndGlass(const Scene &scene) {
    EXPECT_EQ(materialNamed(scene, "mirror").kind, MaterialKind::Mirror);
    EXPECT_EQ(materialNamed(scene, "glass").kind, MaterialKind::Dielectric);
    EXPECT_EQ(materialNamed(scene, "glass").refractiveIndex, 1.8f);
    EXPECT_EQ(materialNamed(scene, "glass").segmentTint, glm::vec3(.95f, .95f, .98f));
}

TEST(ShippedScenes, SpheresHoldTheNumbersOfTheReport) {
    const TestScene scene = testSceneOf(loadSceneFile(sourceDir / "assets/scenes/spheres.json"));
    expectRoom(scene, 10, 7);
    expectSpheres(scene, {roomSpheres, ballSpheres});
    expectMirrorAndGlass(scene);
    EXPECT_TRUE(scene.meshes.empty());
}

TEST(ShippedScenes, NestedSpheresHaveFourShellsOfAlternatingNormals) {
    const TestScene scene = testSceneOf(loadSceneFile(sourceDir / "assets/scenes/spheres-nested.json"));
    expectRoom(scene, 10, 12);
    expectSpheres(scene, {roomSpheres, ballSpheres, nestedSpheres});
    expectMirrorAndGlass(scene);
}

TEST_F(Assets, TheCatStandsInTheRoomOfTheSpheres) {
    // The mesh is generated by the build: a triangle takes its place here.
    std::filesystem::copy_file(sourceDir / "assets/scenes/cat.json", folder / "scenes/cat.json");
    add("cat.obj", "v 0 0 0\nv 10 0 0\nv 0 20 0\nf 1 2 3\n");
    const TestScene scene = loadTestScene("cat");
    expectRoom(scene, 32, 5);
    expectSpheres(scene, {roomSpheres});
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Material &cat = scene.materials.at(scene.meshes[0].materialIndex);
    EXPECT_EQ(cat.kind, MaterialKind::Diffuse);
    EXPECT_EQ(cat.albedo, glm::vec3(.95f, .95f, .98f));
    const glm::uvec3 corners = scene.meshes[0].triangles.at(0).positions;
    EXPECT_EQ(scene.meshes[0].positions.at(corners.x), glm::vec3(0, -10, 0));
    EXPECT_EQ(scene.meshes[0].positions.at(corners.y), glm::vec3(6, -10, 0));
    EXPECT_EQ(scene.meshes[0].positions.at(corners.z), glm::vec3(0, 2, 0));
}

} // namespace
} // namespace hyalite::core
