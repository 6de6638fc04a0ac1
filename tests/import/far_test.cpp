// Scenes far from zero are read as the same scenes near it, whatever the format.
#include "host/import/load.h"
#include "host/scene/instances.h"
#include "tests/fixtures/gltf_fixture.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cstring>

namespace hyalite::core {
namespace {

using nlohmann::json;

const glm::dvec3 utm(500'000.0, 100.0, 5'400'000.0);
const std::vector<glm::dvec3> places{utm, {-4'194'304.0, 0.0, 1'048'576.0}, {0.0, 12'742'016.0, 0.0}};

/// A tetrahedron whose coordinates are eighths, so that they are exact wherever it is.
const std::vector<glm::dvec3> corners{{0, 0, 0}, {1.125, 0, 0.25}, {0.375, 1.5, 0}, {0.5, 0.625, 1.75}};
constexpr int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

std::string objAt(const glm::dvec3 &place) {
    std::string text;
    for (const glm::dvec3 &corner : corners)
        text += fmt::format("v {:.3f} {:.3f} {:.3f}\n", corner.x + place.x, corner.y + place.y,
                            corner.z + place.z);
    for (const auto &face : faces)
        text += fmt::format("f {} {} {}\n", face[0] + 1, face[1] + 1, face[2] + 1);
    return text;
}

std::string plyAt(const glm::dvec3 &place, bool isText) {
    std::string text = fmt::format(
        "ply\nformat {} 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
        "element face 4\nproperty list uchar int vertex_indices\nend_header\n",
        isText ? "ascii" : "binary_little_endian");
    const auto append = [&](const auto &value) {
        if (isText)
            text += fmt::format("{} ", +value);
        else
            text.append(reinterpret_cast<const char *>(&value), sizeof(value));
    };
    const auto endRow = [&] { text += isText ? "\n" : ""; };
    for (const glm::dvec3 &corner : corners) {
        for (glm::length_t axis = 0; axis < 3; ++axis)
            append(corner[axis] + place[axis]);
        endRow();
    }
    for (const auto &face : faces) {
        append(static_cast<unsigned char>(3));
        for (const int corner : face)
            append(corner);
        endRow();
    }
    return text;
}

std::string stlAt(const glm::dvec3 &place) {
    std::string text = "solid far\n";
    for (const auto &face : faces) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const int i : face) {
            const glm::dvec3 corner = corners[static_cast<std::size_t>(i)] + place;
            text += fmt::format("vertex {:.3f} {:.3f} {:.3f}\n", corner.x, corner.y, corner.z);
        }
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid far\n";
}

class Far : public GltfFolder {
  protected:
    [[nodiscard]] LoadedScene loadAt(const std::string &name, const std::string &text,
                                     const LoadOptions &options = {}) const {
        return loadScene(write(name, text).string(), options);
    }

    /// Expects the same scene, except for its place.
    static void expectNear(const LoadedScene &far, const LoadedScene &near, const glm::dvec3 &place) {
        EXPECT_EQ(near.scene.origin, glm::dvec3(0.0));
        EXPECT_EQ(far.scene.origin, place);
        ASSERT_EQ(far.scene.meshes.size(), near.scene.meshes.size());
        for (std::size_t i = 0; i < near.scene.meshes.size(); ++i) {
            EXPECT_EQ(far.scene.meshes[i].positions, near.scene.meshes[i].positions) << i;
            EXPECT_EQ(far.scene.meshes[i].triangles.size(), near.scene.meshes[i].triangles.size()) << i;
        }
        ASSERT_EQ(far.scene.instances.size(), near.scene.instances.size());
        for (std::size_t i = 0; i < near.scene.instances.size(); ++i) {
            EXPECT_EQ(far.scene.instances[i].toWorld.offset, near.scene.instances[i].toWorld.offset) << i;
            EXPECT_EQ(far.scene.prototypes[far.scene.instances[i].prototype].positions,
                      near.scene.prototypes[near.scene.instances[i].prototype].positions)
                << i;
        }
        ASSERT_EQ(far.scene.lights.size(), near.scene.lights.size());
        for (std::size_t i = 0; i < near.scene.lights.size(); ++i)
            EXPECT_EQ(far.scene.lights[i].position, near.scene.lights[i].position) << i;
        for (std::size_t i = 0; i < near.scene.spheres.size(); ++i)
            EXPECT_EQ(far.scene.spheres[i].centre, near.scene.spheres[i].centre) << i;
        EXPECT_EQ(far.scene.camera.position, near.scene.camera.position);
        EXPECT_EQ(far.scene.camera.direction, near.scene.camera.direction);
    }
};

TEST_F(Far, MeshesOfAllFormatsAreReadNear) {
    for (const glm::dvec3 &place : places) {
        expectNear(loadAt("far.obj", objAt(place)), loadAt("near.obj", objAt(glm::dvec3(0.0))), place);
        expectNear(loadAt("far.stl", stlAt(place)), loadAt("near.stl", stlAt(glm::dvec3(0.0))), place);
        for (const bool isText : {true, false})
            expectNear(loadAt("far.ply", plyAt(place, isText)),
                       loadAt("near.ply", plyAt(glm::dvec3(0.0), isText)), place);
    }
}

TEST_F(Far, MeshesThatVanishInStepsOfFloatsAreRead) {
    const std::string text = "v 6378137.001 0 0\nv 6378137.002 0 0\nv 6378137.001 0.001 0\nf 1 2 3\n";
    const LoadedScene loaded = loadAt("small.obj", text);
    EXPECT_EQ(loaded.scene.meshes.at(0).triangles.size(), 1u);
    EXPECT_EQ(loaded.meshReports.at(0).degenerateTriangleCount, 0u);
    EXPECT_THROW(static_cast<void>(loadAt("point.obj", "v 9e6 0 0\nv 9e6 0 0\nv 9e6 0 0\nf 1 2 3\n")), Error);
}

json pointAt(const glm::dvec3 &place, const glm::dvec3 &offset) {
    const glm::dvec3 point = place + offset;
    return {point.x, point.y, point.z};
}

/// All that has a place, there.
json sceneAt(const glm::dvec3 &place) {
    const json translate = pointAt(place, {0.5, 0.25, 0.125});
    const json rows = {1, 0, 0, translate[0], 0, 2, 0, translate[1], 0, 0, 1, translate[2]};
    return {
        {"camera",
         {{"position", pointAt(place, {0.5, 1, 5})},
          {"target", pointAt(place, {0.5, 0.5, 0.5})},
          {"path", {{"keys", {{{"frame", 0}}, {{"frame", 2}, {"position", pointAt(place, {3, 1, 4})}}}}}}}},
        {"materials", {{"grey", {{"type", "diffuse"}}}}},
        {"lights",
         {{{"type", "point"}, {"position", pointAt(place, {1, 4, 1})}, {"power", 100}},
          {{"type", "spot"}, {"position", pointAt(place, {-1, 4, 1})}, {"power", 100}},
          {{"type", "directional"}, {"irradiance", 1}}}},
        {"spheres", {{{"centre", pointAt(place, {1, 1, 1})}, {"radius", 0.5}, {"material", "grey"}}}},
        {"shapes",
         {{{"type", "box"},
           {"material", "grey"},
           {"transform", {{{"scale", 0.5}}, {{"translate", translate}}}}},
          {{"type", "quad"}, {"material", "grey"}, {"instances", {rows, {{{"translate", translate}}}}}}}},
        {"meshes",
         {{{"file", "near.obj"}, {"translate", translate}, {"material", "grey"}},
          {{"file", "near.obj"}, {"transform", rows}, {"material", "grey"}},
          {{"file", "near.obj"}, {"scale", 0.5}, {"instances", {rows, {{{"translate", translate}}}}}}}}};
}

TEST_F(Far, ScenesAreMovedWithAllThatTheyHave) {
    static_cast<void>(write("near.obj", objAt(glm::dvec3(0.0))));
    const LoadedScene near = loadAt("near.json", sceneAt(glm::dvec3(0.0)).dump());
    for (const glm::dvec3 &place : places) {
        const LoadedScene far = loadAt("far.json", sceneAt(place).dump());
        expectNear(far, near, place);
        ASSERT_EQ(far.cameraPath.size(), near.cameraPath.size());
        for (std::size_t i = 0; i < near.cameraPath.size(); ++i)
            EXPECT_LT(glm::length(far.cameraPath[i].position - near.cameraPath[i].position), 1e-8) << i;
    }
}

TEST_F(Far, MeshesOfFarFilesAreBroughtNearByTheirTransforms) {
    static_cast<void>(write("near.obj", objAt(glm::dvec3(0.0))));
    const auto sceneOf = [&](const std::string &file, const glm::dvec3 &place) {
        const json back = json::array({{{"translate", pointAt(-place, glm::dvec3(0.0))}}});
        return json{{"meshes",
                     {{{"file", file}, {"translate", back[0]["translate"]}},
                      {{"file", file}, {"transform", back}},
                      {{"file", file}, {"instances", {back}}}}},
                    {"camera", {{"position", {0, 0, 9}}}}}
            .dump();
    };
    static_cast<void>(write("near.stl", stlAt(glm::dvec3(0.0))));
    for (const std::string extension : {"obj", "stl"}) {
        const LoadedScene near = loadAt("near.json", sceneOf("near." + extension, glm::dvec3(0.0)));
        for (const glm::dvec3 &place : places) {
            static_cast<void>(write("far." + extension, extension == "obj" ? objAt(place) : stlAt(place)));
            expectNear(loadAt("far.json", sceneOf("far." + extension, place)), near, glm::dvec3(0.0));
        }
    }
}

TEST_F(Far, LargeScenesKeepTheirBits) {
    static_cast<void>(write("far.obj", objAt(utm)));
    const json scene{{"meshes", {{{"file", "far.obj"}}}},
                     {"materials", {{"grey", {{"type", "diffuse"}}}}},
                     {"spheres", {{{"centre", {0, 0, 0}}, {"radius", 1}, {"material", "grey"}}}}};
    const LoadedScene loaded = loadAt("large.json", scene.dump());
    EXPECT_EQ(loaded.scene.origin, glm::dvec3(0.0));
    for (std::size_t i = 0; i < corners.size(); ++i)
        EXPECT_EQ(loaded.scene.meshes.at(0).positions[i], glm::vec3(corners[i] + utm));
}

GltfMaker gltfAt(const glm::dvec3 &place) {
    GltfMaker maker = oneTriangle();
    maker.json["accessors"][0]["min"] = {0, 0, 0};
    maker.json["accessors"][0]["max"] = {1, 1, 0};
    maker.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}};
    maker.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    const json point = pointAt(place, glm::dvec3(0.0));
    maker.json["scenes"][0]["nodes"] = {1};
    maker.json["nodes"] = {
        {{"mesh", 0}},
        {{"children", {0, 2, 3}}, {"translation", point}},
        {{"camera", 0}, {"translation", {0.25, 0.5, 3}}},
        {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"translation", {0, 2, 2}}}};
    return maker;
}

TEST_F(Far, NodesOfGltfAreMovedNear) {
    const LoadedScene near = loadAt("near.glb", gltfAt(glm::dvec3(0.0)).glb());
    for (const glm::dvec3 &place : places) {
        expectNear(loadAt("far.glb", gltfAt(place).glb()), near, place);
        GltfMaker many = gltfAt(place);
        GltfMaker nearMany = gltfAt(glm::dvec3(0.0));
        for (GltfMaker *maker : {&many, &nearMany}) {
            maker->json["nodes"].push_back({{"mesh", 0}, {"translation", {2, 0, 0}}});
            maker->json["nodes"][1]["children"].push_back(4);
        }
        expectNear(loadAt("far.glb", many.glb()), loadAt("near.glb", nearMany.glb()), place);
    }
}

TEST_F(Far, SkinsAreMovedNear) {
    const auto skinnedAt = [](const glm::dvec3 &place) {
        GltfMaker maker = gltfAt(place);
        json &attributes = maker.json["meshes"][0]["primitives"][0]["attributes"];
        attributes["JOINTS_0"] =
            maker.add<std::uint8_t>("VEC4", 5121, 4, {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
        attributes["WEIGHTS_0"] = maker.addVec4({1, 0, 0, 0, 0.5, 0.5, 0, 0, 0, 1, 0, 0});
        maker.json["skins"] = {{{"joints", {1, 4}}}};
        maker.json["nodes"][0]["skin"] = 0;
        maker.json["nodes"].push_back({{"translation", {0, 0, 0.625}}});
        maker.json["nodes"][1]["children"].push_back(4);
        return maker.glb();
    };
    const LoadedScene near = loadAt("near.glb", skinnedAt(glm::dvec3(0.0)));
    EXPECT_EQ(near.scene.meshes.at(0).positions.at(2), glm::vec3(0, 1, 0.625f));
    for (const glm::dvec3 &place : places)
        expectNear(loadAt("far.glb", skinnedAt(place)), near, place);
}

TEST_F(Far, AnimationsDoNotMoveTheOrigin) {
    GltfMaker maker = gltfAt(utm);
    const std::size_t input = maker.addScalars({0, 1});
    const std::size_t output = maker.addVec3({0, 0, 0, 900, 0, 0});
    maker.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", input}, {"output", output}}}}}};
    for (const double seconds : {0.0, 0.5, 1.0}) {
        const LoadedScene loaded = loadAt("moving.glb", maker.glb(), {.timeSeconds = seconds});
        EXPECT_EQ(loaded.scene.origin, utm);
        EXPECT_EQ(loaded.scene.meshes.at(0).positions.at(1),
                  glm::vec3(static_cast<float>(1.0 + 900.0 * seconds), 0, 0));
        EXPECT_EQ(loaded.scene.camera.position, glm::dvec3(0.25, 0.5, 3));
    }
}

} // namespace
} // namespace hyalite::core
