// The scene file: what it says is what is loaded, and what it may not say is refused with its place.
#include "host/scene/validate.h"
#include "tests/fixtures/png_fixture.h"
#include "tests/fixtures/scene_json_fixture.h"
#include "tests/fixtures/test_scene.h"

#include <sys/stat.h>

#include <ostream>
#include <vector>

namespace hyalite::core {
namespace {

using nlohmann::json;

using SceneJson = SceneFolder;

// ---- What a file says is what is loaded

TEST_F(SceneJson, NumbersBeyondTheirRangeByRoundingAreItsEnds) {
    json scene = completeScene();
    scene["materials"]["varnish"]["baseColour"] = {1.0000002, -1e-8, 0.5};
    const Scene loaded = load(scene.dump());
    EXPECT_EQ(loaded.materials[4].albedo, glm::vec3(1.0f, 0.0f, 0.5f));
    for (const double beyond : {1.000001, -1e-6, 1.1}) {
        scene["materials"]["varnish"]["baseColour"] = beyond;
        EXPECT_THROW(static_cast<void>(load(scene.dump())), Error) << beyond;
    }
}

TEST_F(SceneJson, EveryValueReachesTheScene) {
    TestScene scene = load(completeScene().dump());
    EXPECT_EQ(scene.camera.position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(scene.camera.direction, glm::dvec3(0, 0, -7));
    EXPECT_EQ(scene.camera.up, glm::dvec3(0, 2, 0));
    EXPECT_EQ(scene.camera.horizontalFovDegrees, 45.5);
    EXPECT_EQ(scene.camera.width, 333);
    EXPECT_EQ(scene.camera.height, 217);
    EXPECT_EQ(scene.background, glm::vec3(0.1f, 0.2f, 0.3f));

    EXPECT_EQ(scene.camera.kind, CameraKind::Perspective);
    EXPECT_EQ(scene.camera.aperture, 0.25);
    EXPECT_EQ(scene.camera.focusDistance, 8.5);
    EXPECT_EQ(scene.camera.viewWidth, 12.0);
    EXPECT_EQ(scene.environment.radiance.width(), 2);
    EXPECT_EQ(scene.environment.scale, 0.5f);
    EXPECT_EQ(scene.environment.rotateDegrees, 30.0);

    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[1].kind, LightKind::Spot);
    EXPECT_EQ(scene.lights[1].direction, glm::dvec3(0, 0, 2));
    EXPECT_EQ(scene.lights[1].angleDegrees, 40.0);
    EXPECT_EQ(scene.lights[1].blend, 0.5);
    EXPECT_EQ(scene.lights[1].fade, SpotFade::Square);
    EXPECT_EQ(scene.lights[2].kind, LightKind::Directional);
    EXPECT_EQ(scene.lights[2].direction, glm::dvec3(1, -1, 0));
    EXPECT_EQ(scene.lights[2].power, glm::dvec3(3, 2, 1));
    EXPECT_EQ(scene.lights[0].position, glm::dvec3(-10, 20, 40));
    EXPECT_EQ(scene.lights[0].power, glm::dvec3(1, 2, 3));
    EXPECT_EQ(scene.lights[0].profile, 0u);
    EXPECT_EQ(scene.lights[0].direction, glm::dvec3(0, -2, 0));
    EXPECT_EQ(scene.lights[0].c0, glm::dvec3(0, 0, 1));
    EXPECT_EQ(scene.lights[1].profile, 0u) << "each file is read once";
    EXPECT_EQ(scene.lights[1].c0, glm::dvec3(1, 0, 0));
    EXPECT_FALSE(scene.lights[2].profile);
    ASSERT_EQ(scene.profiles.size(), 1u);
    EXPECT_EQ(scene.profiles[0].shares, (std::vector<float>{1.0f, 0.5f}));

    ASSERT_EQ(scene.materials.size(), 6u);
    const Material &brass = scene.materials[0]; // in the order of the alphabet
    EXPECT_EQ(brass.kind, MaterialKind::Conductor);
    EXPECT_EQ(brass.conductorIndex, glm::vec3(0.4f, 0.5f, 0.6f));
    EXPECT_EQ(brass.conductorExtinction, glm::vec3(2.0f));
    EXPECT_EQ(brass.roughness, 0.25f);
    const Material &varnish = scene.materials[4];
    EXPECT_EQ(varnish.kind, MaterialKind::Principled);
    EXPECT_EQ(varnish.albedo, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(varnish.metallic, 0.125f);
    EXPECT_EQ(varnish.roughness, 0.375f);
    EXPECT_EQ(varnish.specular, 0.625f);
    EXPECT_EQ(varnish.refractiveIndex, 1.25f);
    EXPECT_EQ(varnish.absorption, glm::vec3(0.75f));
    EXPECT_EQ(varnish.priority, 4);
    EXPECT_EQ(varnish.clearcoat, 0.875f);
    EXPECT_EQ(varnish.clearcoatRoughness, 0.0625f);
    EXPECT_TRUE(varnish.twoSided);
    EXPECT_EQ(varnish.emission, glm::vec3(5.0f));
    const Material &velvet = scene.materials[5];
    EXPECT_EQ(velvet.kind, MaterialKind::Gltf);
    EXPECT_EQ(velvet.dielectricColour, glm::vec3(2.0f, 1.0f, 0.5f));
    EXPECT_EQ(velvet.sheenRoughness, 0.625f);
    EXPECT_EQ(velvet.anisotropyRotation, -1.5f);
    EXPECT_EQ(velvet.clearcoatNormalStrength, 3.0f);
    EXPECT_TRUE(velvet.isThin && velvet.isUnlit && velvet.twoSided);
    EXPECT_EQ(velvet.alphaCutoff, 0.25f);
    EXPECT_EQ(velvet.iridescence, 0.375f);
    EXPECT_EQ(velvet.iridescenceIndex, 1.75f);
    EXPECT_EQ(velvet.iridescenceThickness, 250.0f);
    EXPECT_EQ(velvet.iridescenceThicknessMinimum, 700.0f);
    EXPECT_EQ(velvet.dispersion, 0.5625f);
    EXPECT_EQ(velvet.diffuseTransmission, 0.1875f);
    EXPECT_EQ(velvet.diffuseTransmissionColour, glm::vec3(0.5f, 0.25f, 1.0f));
    EXPECT_TRUE(velvet.textures[layout::slotAnisotropy] && velvet.textures[layout::slotClearcoatNormal]);
    ASSERT_EQ(scene.spheres.size(), 1u);
    EXPECT_EQ(scene.spheres[0].centre, glm::dvec3(4, 5, 6));
    EXPECT_EQ(scene.spheres[0].radius, 7.0);
    EXPECT_TRUE(scene.spheres[0].inwardNormal);
    const Material &ice = scene.materials.at(scene.spheres[0].materialIndex);
    EXPECT_EQ(ice.name, "ice");
    EXPECT_EQ(ice.kind, MaterialKind::Dielectric);
    EXPECT_EQ(ice.refractiveIndex, 1.31f);
    EXPECT_EQ(ice.dispersion, 0.4375f);
    EXPECT_EQ(ice.segmentTint, glm::vec3(0.75f));
    EXPECT_EQ(ice.absorption, glm::vec3(0.5f, 0.25f, 0.0f));
    EXPECT_EQ(ice.priority, -2);
    EXPECT_EQ(ice.roughness, 0.3f);

    ASSERT_EQ(scene.prototypes.size(), 2u); // shapes come first
    EXPECT_TRUE(scene.meshes.empty());
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.instances[1].toWorld.rows[0], glm::vec3(3, 0, 0));
    const TriangleMesh &disk = scene.prototypes[0];
    EXPECT_EQ(disk.triangles.size(), 5u);
    EXPECT_EQ(disk.positions.at(0), glm::vec3(0, 0, 2));
    EXPECT_EQ(scene.materials.at(disk.materialIndex).name, "chrome");
    const TriangleMesh &mesh = scene.prototypes[1];
    ASSERT_EQ(mesh.triangles.size(), 1u);
    const Material &paper = scene.materials.at(mesh.materialIndex);
    EXPECT_EQ(paper.name, "paper");
    EXPECT_EQ(paper.kind, MaterialKind::Diffuse);
    EXPECT_EQ(paper.albedo, glm::vec3(0.25f, 0.5f, 1.0f));
    EXPECT_TRUE(paper.twoSided);
    EXPECT_EQ(paper.emission, glm::vec3(1.0f, 2.0f, 3.0f));
    // The corner (1, 0, 0): scaled to (2, 0, 0), turned about z to (0, 2, 0), moved to (0, 2, -5), stretched to -15.
    const glm::vec3 corner = mesh.positions.at(mesh.triangles[0].positions[1]);
    EXPECT_NEAR(corner.x, 0.0, 1e-6);
    EXPECT_NEAR(corner.y, 2.0, 1e-6);
    EXPECT_NEAR(corner.z, -15.0, 1e-6);

    EXPECT_EQ(scene.settings.samplesPerPixel, 32);
    EXPECT_EQ(scene.settings.maxDepth, 12);
    EXPECT_EQ(scene.settings.occlusionDistance, 7.5);
    EXPECT_EQ(scene.settings.tree, TreeKind::Sah);
    EXPECT_EQ(scene.settings.leafSize, 4);
    EXPECT_EQ(scene.settings.sampler, SamplerKind::Centre);
    EXPECT_EQ(scene.settings.filter, FilterKind::BlackmanHarris);
    EXPECT_EQ(scene.settings.seed, 4294967295u);
    EXPECT_EQ(scene.settings.radianceLimit, 9.0);
    EXPECT_EQ(scene.settings.exposureStops, -1.5);
    EXPECT_EQ(scene.shadowThroughGlass, 0.5f);
    EXPECT_NO_THROW(validateScene(scene, "complete"));
    EXPECT_THROW(validateSettings(scene.settings, scene, "complete"), Error)
        << "a filter is for samples beside the centre";
    scene.settings.sampler = SamplerKind::Sobol;
    EXPECT_NO_THROW(validateSettings(scene.settings, scene, "complete"));
}

TEST_F(SceneJson, AnEmptyObjectIsAnEmptyBlackScene) {
    const LoadedScene loaded = loadSceneFile(write("scene.json", "{}"));
    EXPECT_TRUE(loaded.scene.spheres.empty() && loaded.scene.meshes.empty() && loaded.scene.lights.empty());
    EXPECT_EQ(loaded.scene.background, glm::vec3(0.0f));
    EXPECT_TRUE(loaded.meshReports.empty());
    EXPECT_FALSE(loaded.autoFramed);
    EXPECT_EQ(loaded.file, folder / "scene.json");
    EXPECT_NO_THROW(validateScene(loaded.scene, "empty"));
}

TEST_F(SceneJson, ANumberForAColourIsGrey) {
    EXPECT_EQ(load(R"({"background": 0.5})").background, glm::vec3(0.5f));
    const Scene scene = load(R"({"lights": [{"type": "point", "position": [0, 0, 0], "power": 1e5}]})");
    EXPECT_EQ(scene.lights.at(0).power, glm::dvec3(1e5));
}

TEST_F(SceneJson, AMetalHasItsIndexByName) {
    const Scene scene =
        load(R"({"materials": {"ring": {"type": "conductor", "metal": "gold", "extinction": 9}}})");
    EXPECT_EQ(scene.materials.at(0).conductorIndex, metalNames[2].second.index);
    EXPECT_EQ(scene.materials.at(0).conductorExtinction, glm::vec3(9.0f)) << "what is given beside it wins";
    // Gold is yellow, and they all reflect most of red light.
    const glm::vec3 gold = normalReflectance(metalNames[2].second.index, metalNames[2].second.extinction);
    EXPECT_GT(gold.x, gold.y + 0.1f);
    EXPECT_GT(gold.y, gold.z + 0.2f);
    for (const auto &[name, metal] : metalNames)
        EXPECT_GT(normalReflectance(metal.index, metal.extinction).x, 0.85f) << name;
}

TEST_F(SceneJson, ACameraIsFocusedOnItsTarget) {
    const Scene scene = load(R"({"camera": {"position": [0, 3, 4], "target": [0, 0, 0], "aperture": 1}})");
    EXPECT_EQ(scene.camera.focusDistance, 5.0);
}

TEST_F(SceneJson, AnEnvironmentIsLinear) {
    EXPECT_TRUE(refusal(R"({"environment": {"file": "missing.hdr"}})").starts_with(" /environment/file: "));
    static_cast<void>(write("sky.txt", "no image"));
    EXPECT_NE(refusalOf(write("scene.json", R"({"environment": {"file": "sky.pfm", "scale": -1}})"))
                  .find("allowed"),
              std::string::npos);
    EXPECT_THROW(static_cast<void>(load(R"({"environment": {"file": "sky.txt"}})")), Error);
}

TEST_F(SceneJson, AWholeNumberMayBeWrittenAsAFloat) {
    EXPECT_EQ(load(R"({"camera": {"width": 6.4e1}})").camera.width, 64);
}

TEST_F(SceneJson, MeshesAreFoundFromTheFolderOfTheSceneFile) {
    std::filesystem::create_directories(folder / "below");
    const std::filesystem::path file = write(
        "below/scene.json",
        R"({"materials": {"m": {"type": "mirror"}}, "meshes": [{"file": "../triangle.obj", "material": "m"}]})");
    EXPECT_TRUE(refusalOf(file).starts_with(" /meshes/0/file: ")) << "what is out of reach is not read";
    const LoadedScene loaded = loadSceneFile(file, {.allowedPaths = {folder}});
    EXPECT_EQ(triangleCount(loaded.scene), 1u);
    EXPECT_EQ(loaded.meshReports.size(), 1u);
}

// ---- What a file may not say is refused, with its place

struct Refusal {
    const char *text;
    const char *place; ///< right after the file's name
    const char *reason;
};

void PrintTo(const Refusal &refusal, std::ostream *stream) { *stream << refusal.text; }

class SceneJsonRefusal : public SceneFolder, public ::testing::WithParamInterface<Refusal> {};

TEST_P(SceneJsonRefusal, NamesPlaceAndReason) {
    const std::string message = refusal(GetParam().text);
    EXPECT_TRUE(message.starts_with(GetParam().place)) << message;
    EXPECT_NE(message.find(GetParam().reason), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Table, SceneJsonRefusal,
    ::testing::Values(
        // syntax: line and column
        Refusal{"", "1:1: ", "input"}, //
        Refusal{"{\n  \"spheres\": [,]\n}", "2:15: ", "unexpected ','"},
        Refusal{"{\"background\": NaN}", "1:16: ", "invalid literal"},
        Refusal{"{\"background\": 1e999}", "1:20: ", "number overflow"},
        Refusal{"{} {}", "1:4: ", "unexpected '{'"}, //
        Refusal{"{\"\xFF\": 1}", "1:3: ", "ill-formed UTF-8"},
        Refusal{"version https://git-lfs.github.com/spec/v1\n", " this is not JSON; ",
                "a pointer of Git LFS"},
        // keys
        Refusal{"[]", " the top level: ", "found an array of 0; allowed: an object"},
        Refusal{R"({"sphere": []})", " /sphere: ", "did you mean \"spheres\"?"},
        Refusal{R"({"camera": {"positon": 1}})", " /camera/positon: ", "did you mean \"position\"?"},
        Refusal{R"({"spheres": [{"center": 1}]})", " /spheres/0/center: ", "did you mean \"centre\"?"},
        Refusal{R"({"settings": {"SPP": 1}})", " /settings/SPP: ", "did you mean \"spp\"?"},
        Refusal{R"({"materials": {"m": {"type": "mirror", "albedo": 1}}})",
                " /materials/m/albedo: ", "unknown key; allowed: \"type\""},
        Refusal{R"({"materials": {"a/b": {"type": "mirror", "x": 1}}})", " /materials/a~1b/x: ", "unknown"},
        Refusal{R"({"materials": {"\u001b[31m": {"type": 1}}})", " /materials/\uFFFD[31m/type: ", "found 1"},
        Refusal{R"({"camera": {"width": 1, "width": 2}})", " /camera/width: ", "given twice"},
        Refusal{R"({"lights": [{}, [{"a": 1, "b": {}, "a": 2}]]})", " /lights/1/0/a: ", "given twice"},
        Refusal{R"({"spheres": [{"centre": [0, 0, 0], "material": "m"}]})",
                " /spheres/0/radius: ", "missing"},
        Refusal{R"({"materials": {"m": {}}})", " /materials/m/type: ", "missing"},
        // types
        Refusal{R"({"$schema": 1})", " /$schema: ", "allowed: a text"},
        Refusal{R"({"camera": []})", " /camera: ", "allowed: an object"},
        Refusal{R"({"camera": {"position": [1, 2]}})", " /camera/position: ", "found an array of 2"},
        Refusal{R"({"camera": {"position": [1, "2", 3]}})", " /camera/position/1: ", "found \"2\""},
        Refusal{R"({"camera": {"width": 1.5}})", " /camera/width: ", "a whole number from 1 to 32768"},
        Refusal{R"({"camera": {"width": true}})", " /camera/width: ", "found true"},
        Refusal{R"({"background": "black"})", " /background: ", "[red, green, blue] or one number"},
        Refusal{R"({"background": true})", " /background: ", "found true"},
        Refusal{R"({"spheres": {}})", " /spheres: ", "found an object; allowed: an array"},
        Refusal{R"({"spheres": [7]})", " /spheres/0: ", "allowed: an object"},
        Refusal{R"({"materials": {"m": {"type": "diffuse", "twoSided": 1}}})",
                " /materials/m/twoSided: ", "true or false"},
        Refusal{R"({"materials": {"m": {"type": "miror"}}})",
                " /materials/m/type: ", "did you mean \"mirror\"?"},
        Refusal{R"({"settings": {"bvh": "kd"}})", " /settings/bvh: ", "\"midpoint\", \"sah\", \"none\""},
        // ranges
        Refusal{R"({"camera": {"horizontalFov": 180}})",
                " /camera/horizontalFov: ", "found 180; allowed: a number more than 0 and less than 180"},
        Refusal{R"({"camera": {"height": 0}})", " /camera/height: ", "found 0"},
        Refusal{R"({"camera": {"position": [0, 2e15, 0]}})", " /camera/position/1: ", "1e+15"},
        Refusal{R"({"camera": {"direction": [0, 0, 0]}})", " /camera/direction: ", "length"},
        Refusal{R"({"camera": {"up": [0, 0, 1e-300]}})", " /camera/up: ", "length"},
        Refusal{R"({"camera": {"target": [0, 0, 55]}})", " /camera/target: ", "own position"},
        Refusal{R"({"camera": {"path": {}}})", " /camera/path", "missing"},
        Refusal{R"({"camera": {"path": {"keys": []}}})", " /camera/path/keys: ", "at least one key"},
        Refusal{R"({"camera": {"path": {"keys": [{"frame": 1.5}]}}})",
                " /camera/path/keys/0/frame: ", "whole"},
        Refusal{R"({"camera": {"path": {"keys": [{"frame": 4}, {"frame": 4}]}}})",
                " /camera/path/keys/1/frame: ", "a frame behind 4"},
        Refusal{
            R"({"camera": {"target": [0, 0, 0], "path": {"keys": [{"frame": 0, "position": [0, 0, 0]}]}}})",
            " /camera/path/keys/0/position: ", "the camera's target"},
        Refusal{R"({"camera": {"target": [0, 0, 0], "direction": [0, 0, -1]}})",
                " /camera/target: ", "one of the two"},
        Refusal{R"({"background": [0, 0, -1]})", " /background/2: ", "found -1"},
        Refusal{R"({"materials": {"m": {"type": "diffuse", "albedo": 1.5}}})",
                " /materials/m/albedo: ", "from 0 to 1"},
        Refusal{R"({"materials": {"m": {"type": "dielectric", "index": 0.5}}})",
                " /materials/m/index: ", "from 1 to 10"},
        Refusal{R"({"spheres": [{"centre": [0, 0, 0], "radius": 0, "material": "m"}]})",
                " /spheres/0/radius: ", "found 0; allowed: a number more than 0"},
        Refusal{R"({"settings": {"seed": 4294967296}})", " /settings/seed: ", "from 0 to 4294967295"},
        Refusal{R"({"settings": {"shadowThroughGlass": 2}})", " /settings/shadowThroughGlass: ", "found 2"},
        Refusal{R"({"meshes": [{"file": "triangle.obj", "scale": 0, "material": "m"}]})",
                " /meshes/0/scale: ", "not 0"},
        Refusal{R"({"materials": {"m": {"type": "mirror"}},
                    "shapes": [{"type": "disk", "material": "m", "segments": 2}]})",
                " /shapes/0/segments: ", "from 3 to 4096"},
        Refusal{R"({"materials": {"m": {"type": "mirror"}},
                    "shapes": [{"type": "box", "material": "m", "segments": 8}]})",
                " /shapes/0/segments: ", "found with \"box\""},
        Refusal{R"({"materials": {"m": {"type": "mirror"}},
                    "shapes": [{"type": "box", "material": "m", "transform": [{"scale": [1, 0, 1]}]}]})",
                " /shapes/0/transform: ", "with a volume"},
        Refusal{R"({"materials": {"m": {"type": "mirror"}},
                    "shapes": [{"type": "box", "material": "m", "transform": [{"scale": 1e10}, {"scale": 1e10}]}]})",
                " /shapes/0/transform: ", "moves a vertex to"},
        Refusal{R"({"materials": {"m": {"type": "mirror"}},
                    "shapes": [{"type": "box", "material": "m"}, {"type": "quad", "material": "n"}]})",
                " /shapes/1/material: ", "\"m\""},
        Refusal{R"({"materials": {"m": {"type": "mirror"}},
                    "meshes": [{"file": "triangle.obj", "material": "m", "materialOverrides": {}}]})",
                " /meshes/0/materialOverrides: ", "one of the two"},
        Refusal{R"({"materials": {"m": {"type": "mirror"}},
                    "meshes": [{"file": "triangle.obj", "materialOverrides": {"red": "m"}}]})",
                " /meshes/0/materialOverrides/red: ", "this mesh has none"},
        // names
        Refusal{R"({"spheres": [{"centre": [0, 0, 0], "radius": 1, "material": "m"}]})",
                " /spheres/0/material: ", "defines none"},
        Refusal{R"({"materials": {"glass": {"type": "mirror"}},
                    "spheres": [{"centre": [0, 0, 0], "radius": 1, "material": "glas"}]})",
                " /spheres/0/material: ", "did you mean \"glass\"?"},
        Refusal{R"({"materials": {"\u001b[31m": {"type": "mirror"}},
                    "spheres": [{"centre": [0, 0, 0], "radius": 1, "material": "[31m"}]})",
                " /spheres/0/material: ", "in /materials: \"\uFFFD[31m\"; did you mean \"\uFFFD[31m\"?"},
        Refusal{
            R"({"materials": {"m": {"type": "mirror"}}, "meshes": [{"file": "no.obj", "material": "m"}]})",
            " /meshes/0/file: ", "no.obj"},
        Refusal{
            R"({"materials": {"m": {"type": "mirror"}}, "meshes": [{"file": "\u001b[31m", "material": "m"}]})",
            " /meshes/0/file: ", "/\uFFFD[31m: there is no such file"},
        Refusal{R"({"materials": {"m": {"type": "mirror"}},
                    "meshes": [{"file": "triangle.obj\u0000x", "material": "m"}]})",
                " /meshes/0/file: ", "NUL"}));

TEST_F(SceneJson, TooManyMeshesAreRefusedWithTheNumber) {
    for (const char *list : {"meshes", "shapes"}) {
        json scene = completeScene();
        scene[list] = json(std::vector<json>(limits::meshCount + 1, json::object()));
        EXPECT_EQ(refusal(scene.dump()),
                  fmt::format(" /{}: found an array of 1048577; allowed: an array of at most 1048576 objects",
                              list));
    }
}

TEST_F(SceneJson, NestingIsBounded) {
    const auto nested = [](std::size_t arrayCount) {
        return "{\"a\": " + std::string(arrayCount, '[') + std::string(arrayCount, ']') + "}";
    };
    EXPECT_NE(refusal(nested(31)).find("unknown key"), std::string::npos);
    EXPECT_NE(refusal(nested(32)).find("nested deeper than 32 levels"), std::string::npos);
    EXPECT_NE(refusal(std::string(10'000'000, '[')).find("nested deeper"), std::string::npos);
}

TEST_F(SceneJson, ALongListOfMaterialsIsCutInTheMessage) {
    json scene = completeScene();
    for (int i = 0; i < 1000; ++i)
        scene["materials"]["m" + std::to_string(i)] = {{"type", "mirror"}};
    scene["spheres"][0]["material"] = "nothing like it";
    const std::string message = refusal(scene.dump());
    EXPECT_LT(message.size(), 500u);
    EXPECT_TRUE(message.ends_with(", ...")) << message;
}

// A camera with a target looks at it from each key, unless the key says otherwise.
TEST_F(SceneJson, TheKeysOfACameraKeepItsTarget) {
    const CameraPath path =
        loadSceneFile(write("scene.json", R"({"camera": {"target": [0, 0, 5], "path": {"keys": [
            {"frame": 0}, {"frame": 1, "position": [4, 0, 5]},
            {"frame": 2, "position": [4, 0, 5], "direction": [0, 1, 0], "horizontalFov": 30},
            {"frame": 3, "target": [1, 1, 1]}]}}})"))
            .cameraPath;
    ASSERT_EQ(path.size(), 4u);
    EXPECT_EQ(path[0].direction, glm::dvec3(0.0, 0.0, -50.0));
    EXPECT_EQ(path[1].direction, glm::dvec3(-4.0, 0.0, 0.0));
    EXPECT_EQ(path[1].focusDistance, 4.0);
    EXPECT_EQ(path[1].horizontalFovDegrees, 60.0);
    EXPECT_EQ(path[2].direction, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(path[2].horizontalFovDegrees, 30.0);
    EXPECT_EQ(path[3].direction, glm::dvec3(1.0, 1.0, -54.0));
}

TEST_F(SceneJson, ALongValueIsCutInTheMessage) {
    const std::string message = refusal("{\"background\": \"" + std::string(100'000, 'x') + "\"}");
    EXPECT_LT(message.size(), 300u);
    EXPECT_LT(refusal("{\"" + std::string(100'000, 'x') + "\": 1}").size(), 500u);
    EXPECT_LT(refusal("{\"" + std::string(100'000, 'x')).size(), 500u);
}

TEST_F(SceneJson, OnlyRegularFilesOfAModestSizeAreRead) {
    EXPECT_EQ(refusalOf(folder / "missing.json"), " No such file or directory");
    EXPECT_EQ(refusalOf(folder), " is a folder, not a regular file; name a file");

    const std::filesystem::path pipe = folder / "pipe.json";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_EQ(refusalOf(pipe), " is a pipe, not a regular file; name a file, or - for standard input");

    const std::filesystem::path large = write("large.json", "{}");
    std::filesystem::resize_file(large, (512u << 20) + 1); // sparse
    EXPECT_NE(refusalOf(large).find("512 MiB"), std::string::npos);
}

TEST_F(SceneJson, TexturesAreFactors) {
    const Scene scene = load(R"({"materials": {
        "a": {"type": "diffuse", "textures": {"baseColour": {"file": "image.png", "scale": [2, 3], "offset": 0.25},
                                              "emission": {"file": "image.png"}}},
        "b": {"type": "principled", "roughness": 0.25, "baseColour": 0.75,
              "textures": {"roughness": {"file": "image.png"}, "metallic": {"file": "image.png"},
                           "normal": {"file": "image.png", "strength": 0.5}}}}})");
    EXPECT_EQ(scene.textures.size(), 1u) << "one file is one texture";
    const Material &a = scene.materials.at(0);
    ASSERT_TRUE(a.textures[layout::slotBaseColour]);
    EXPECT_EQ(a.textures[layout::slotBaseColour]->scale, glm::vec2(2, 3));
    EXPECT_EQ(a.textures[layout::slotBaseColour]->offset, glm::vec2(0.25f));
    EXPECT_EQ(a.albedo, glm::vec3(1.0f));
    EXPECT_EQ(a.emission, glm::vec3(1.0f));
    const Material &b = scene.materials.at(1);
    EXPECT_EQ(b.albedo, glm::vec3(0.75f));
    EXPECT_EQ(b.roughness, 0.25f);
    EXPECT_EQ(b.metallic, 1.0f);
    EXPECT_EQ(b.normalStrength, 0.5f);
}

TEST_F(SceneJson, TexturesComeFromWhereTheSceneMayRead) {
    const auto refusalOfTexture = [&](const std::string &slot, const std::string &file) {
        return refusal(R"({"materials": {"m": {"type": "diffuse", "textures": {")" + slot +
                       R"(": {"file": ")" + file + R"("}}}}})");
    };
    EXPECT_EQ(refusalOfTexture("baseColour", "image.png"), "");
    EXPECT_NE(refusalOfTexture("baseColour", "/etc/passwd").find("leads to /etc/passwd"), std::string::npos);
    EXPECT_NE(refusalOfTexture("baseColour", "none.png").find("there is no such file"), std::string::npos);
    EXPECT_NE(refusalOfTexture("roughness", "image.png").find("unknown key"), std::string::npos);
    static_cast<void>(write("glow.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n" +
                                            std::string("\x80\x40\x00\x88", 4)));
    EXPECT_EQ(refusalOfTexture("emission", "glow.hdr"), "");
    EXPECT_NE(refusalOfTexture("baseColour", "glow.hdr").find("found an image of floats"), std::string::npos);
    static_cast<void>(write("grey.png", onePixelPng(9, 9, 9)));
    EXPECT_NE(refusalOfTexture("normal", "grey.png").find("found a grey image"), std::string::npos);
}

TEST_F(SceneJson, AMeshWithoutAMaterialHasItsOwn) {
    static_cast<void>(write("own.mtl", "newmtl red\nKd 1 0 0\nmap_Ke image.png\n"));
    static_cast<void>(write("own.obj", "mtllib own.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
                                       "f 1/1 2/1 3/1\nusemtl red\nf 1/1 3/1 2/1\n"));
    const Scene scene = load(R"({"materials": {"m": {"type": "mirror"}},
        "meshes": [{"file": "triangle.obj", "material": "m"}, {"file": "own.obj"}]})");
    ASSERT_EQ(scene.materials.size(), 3u);
    EXPECT_EQ(scene.materials[1].name, "neutral");
    EXPECT_EQ(scene.materials[2].albedo, glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.meshes.at(0).materialIndex, 0u);
    EXPECT_EQ(scene.meshes.at(1).triangleMaterials, (std::vector<std::uint32_t>{1, 2}));
    EXPECT_EQ(scene.textures.size(), 1u);
    EXPECT_NE(refusal(R"({"meshes": [{"file": "own.obj"}, {"file": "triangle.obj", "material": "red"}]})")
                  .find("/meshes/1/material"),
              std::string::npos)
        << "names are those of the scene file";
}

TEST_F(SceneJson, MaterialsOfAMeshAreOverriddenByName) {
    static_cast<void>(write("own.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n"));
    static_cast<void>(write("own.obj", "mtllib own.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 4\n"
                                       "usemtl red\nf 1 2 3\nusemtl blue\nf 1 3 2\nusemtl red\nf 1 4 2\n"));
    const Scene scene = load(R"({"materials": {"a": {"type": "mirror"}, "red": {"type": "dielectric"}},
        "meshes": [{"file": "own.obj", "materialOverrides": {"red": "red"}}]})");
    const TriangleMesh &mesh = scene.meshes.at(0);
    std::vector<std::string> names;
    for (const std::uint32_t material : mesh.triangleMaterials)
        names.push_back(scene.materials.at(material).name);
    EXPECT_EQ(names, (std::vector<std::string>{"neutral", "red", "blue", "red"}));
    EXPECT_EQ(scene.materials.at(mesh.triangleMaterials[1]).kind, MaterialKind::Dielectric);
    EXPECT_EQ(scene.materials.at(mesh.triangleMaterials[3]).kind, MaterialKind::Dielectric);
    const std::string message = refusal(R"({"materials": {"a": {"type": "mirror"}},
        "meshes": [{"file": "own.obj", "materialOverrides": {"bleu": "a"}}]})");
    EXPECT_NE(message.find("/meshes/0/materialOverrides/bleu"), std::string::npos) << message;
    EXPECT_NE(message.find("did you mean \"blue\"?"), std::string::npos) << message;
}

TEST_F(SceneJson, TransformOfAMeshComesAfterItsOwnSteps) {
    const Scene scene = load(R"({"materials": {"m": {"type": "mirror"}},
        "meshes": [{"file": "triangle.obj", "material": "m", "translate": [1, 0, 0],
                    "transform": [-2, 0, 0, 0,  0, 1, 0, 5,  0, 0, 1, 0]}]})");
    const TriangleMesh &mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{-2, 5, 0}, {-4, 5, 0}, {-2, 6, 0}}));
    EXPECT_EQ(mesh.triangles.at(0).positions, glm::uvec3(0, 2, 1)) << "it faces +z still";
}

TEST_F(SceneJson, EveryObjectMayHaveADescription) {
    const auto described = [](const std::string &words) {
        return R"({"camera": {"description": )" + words +
               R"(}, "materials": {"m": {"type": "mirror", "description": )" + words +
               R"(}}, "spheres": [{"centre": [0, 0, 0], "radius": 1, "material": "m", "description": )" +
               words + R"(}], "settings": {"description": )" + words + "}}";
    };
    EXPECT_EQ(refusal(described("\"words\"")), "");
    EXPECT_NE(refusal(described("7")).find("/description: found 7"), std::string::npos);
}

TEST_F(SceneJson, AllFaultsAreToldAtOnceWithTheirLines) {
    const std::string message = refusal(R"({
  "settings": {"spp": 0, "colr": 1,
    "seed": -1},
  "background": [0,
    1,
    -2
  ],
  "camera": {"fov": 30},
  "lights": [{"type": "point", "color": 1, "position": [0, 0, 0], "power": 1}, {"type": "area"}],
  "materials": {
    "a": {"type": "diffuse",
          "color": 1,
          "emission": "x"},
    "b": {"type": "difuse"}},
  "spheres": [{"centre": [0, 0, 0], "radius": 1, "material": "b"},
              {"centre": [0, 0, 0], "radius": -1, "material": "a"}],
  "meshes": [{"file": "none.obj", "material": "a"}]
})");
    const std::vector<std::pair<std::string, std::string>> faults{
        {" /settings/colr: ", "(line 2)"},
        {" /settings/spp: found 0", "(line 2)"},
        {" /settings/seed: found -1", "(line 3)"},
        {" /background/2: found -2", "(line 6)"},
        {" /camera/fov: unknown", "did you mean \"horizontalFov\"? (line 8)"},
        {" /lights/0/color: ", "did you mean \"power\"? (line 9)"},
        {" /lights/1/type: found \"area\"", "whose material has \"emission\" (line 9)"},
        {" /materials/a/color: ", "did you mean \"albedo\"? (line 12)"},
        {" /materials/a/emission: ", "(line 13)"},
        {" /materials/b/type: ", "did you mean \"diffuse\"? (line 14)"},
        {" /spheres/1/radius: ", "(line 16)"},
        {" /meshes/0/file: ", "no such file (line 17)"}};
    std::istringstream lines(message);
    for (const auto &[place, end] : faults) {
        std::string line;
        ASSERT_TRUE(std::getline(lines, line)) << place;
        EXPECT_NE(line.find(place), std::string::npos) << line;
        EXPECT_TRUE(line.ends_with(end)) << line;
    }
    EXPECT_TRUE(lines.eof()) << message;
    json many = {{"spheres", std::vector<json>(100, json::object())}};
    const std::string bounded = refusal(many.dump());
    EXPECT_EQ(std::ranges::count(bounded, '\n'), 19) << bounded;
}

TEST_F(SceneJson, HasNoComments) {
    for (const std::string text : {"{\n// two\n}", "{\n# two\n}", "{\n/* two */}"}) {
        const std::string message = refusal(text);
        EXPECT_TRUE(message.starts_with("2:1: ")) << message;
        EXPECT_NE(message.find("JSON has no comments"), std::string::npos) << message;
    }
}

} // namespace
} // namespace hyalite::core
