// glTF: cameras, lights, the neutral environment, animations, skins and morph targets.
#include "host/import/load.h"
#include "host/import/neutral_environment.h"
#include "tests/fixtures/gltf_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hyalite::core {
namespace {

class GltfView : public GltfFolder {};

GltfMaker withCameras() {
    GltfMaker maker = oneTriangle();
    maker.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}},
                             {{"type", "orthographic"},
                              {"name", "plan"},
                              {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 1}}}}};
    maker.json["scenes"][0]["nodes"] = {0, 1, 2};
    maker.json["nodes"].push_back({{"camera", 0}, {"name", "eye"}, {"translation", {1, 2, 3}}});
    maker.json["nodes"].push_back({{"camera", 1}});
    return maker;
}

TEST_F(GltfView, HasTheFirstCameraOrTheChosenOne) {
    const LoadedScene first = load(withCameras());
    EXPECT_EQ(first.scene.camera.position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(first.scene.camera.direction, glm::dvec3(0, 0, -1));
    EXPECT_NEAR(first.verticalFovDegrees.value(), 0.8 * 180.0 / std::numbers::pi, 1e-12);
    EXPECT_NEAR(first.scene.camera.horizontalFovDegrees, *first.verticalFovDegrees, 1e-9); // a square image
    EXPECT_FALSE(first.autoFramed);
    for (const char *choice : {"plan", "1"}) {
        const LoadedScene chosen = load(withCameras(), {.camera = choice});
        EXPECT_EQ(chosen.scene.camera.kind, CameraKind::Orthographic);
        EXPECT_EQ(chosen.scene.camera.viewWidth, 6.0);
    }
    EXPECT_EQ(load(withCameras(), {.camera = "eye"}).scene.camera.kind, CameraKind::Perspective);
    try {
        static_cast<void>(load(withCameras(), {.camera = "none"}));
        FAIL();
    } catch (const Error &error) {
        EXPECT_EQ(error.kind, ErrorKind::Usage);
        EXPECT_NE(std::string(error.what()).find("\"eye\", \"plan\""), std::string::npos) << error.what();
    }
}

TEST_F(GltfView, WithoutACameraSeesItWhole) {
    const LoadedScene loaded = load(oneTriangle());
    EXPECT_TRUE(loaded.autoFramed);
    EXPECT_NE(loaded.scene.camera.position, Camera{}.position);
}

TEST_F(GltfView, WithoutTrianglesSaysSo) {
    GltfMaker maker = oneTriangle();
    maker.json["scenes"][0]["nodes"] = nlohmann::json::array();
    maker.json["scenes"][0].erase("nodes");
    const LoadedScene loaded = load(maker);
    EXPECT_FALSE(loaded.autoFramed);
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_NE(loaded.warnings[0].find("nothing to see"), std::string::npos);
}

TEST_F(GltfView, ChoicesAreRefusedForOtherFormats) {
    const std::string mesh = write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
    EXPECT_THROW(static_cast<void>(loadScene(mesh, {.camera = "a"})), Error);
    EXPECT_THROW(static_cast<void>(loadScene(mesh, {.gltfScene = "a"})), Error);
    EXPECT_THROW(static_cast<void>(loadScene(mesh, {.timeSeconds = 1.0})), Error);
}

TEST_F(GltfView, HiddenNodesShowNeitherTheirMeshesNorTheirLightsNorThoseBelow) {
    const nlohmann::json hidden = {{"KHR_node_visibility", {{"visible", false}}}};
    const nlohmann::json lit = {{"KHR_lights_punctual", {{"light", 0}}}};
    GltfMaker maker = oneTriangle();
    maker.json["extensionsRequired"] = {"KHR_node_visibility"};
    maker.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    maker.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    maker.json["nodes"] = {
        {{"mesh", 0}, {"extensions", {{"KHR_node_visibility", nlohmann::json::object()}}}},
        {{"mesh", 0}, {"extensions", hidden}, {"children", {2, 3}}, {"translation", {0, 0, 7}}},
        {{"mesh", 0}, {"extensions", {{"KHR_node_visibility", {{"visible", true}}}}}, {"camera", 0}},
        {{"extensions", lit}}};
    maker.json["scenes"][0]["nodes"] = {0, 1};
    const LoadedScene loaded = load(maker);
    EXPECT_EQ(loaded.scene.meshes.size(), 1u);
    EXPECT_TRUE(loaded.scene.instances.empty());
    EXPECT_TRUE(loaded.scene.lights.empty());
    EXPECT_EQ(loaded.scene.camera.position, glm::dvec3(0, 0, 7));
}

TEST_F(GltfView, LightsHaveTheirUnits) {
    GltfMaker maker = oneTriangle();
    maker.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 2}, {"color", {1, 0.5, 0}}, {"range", 10}},
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
        {{"type", "directional"}, {"intensity", 3}}};
    maker.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
    for (int light = 0; light < 3; ++light)
        maker.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", light}}}}},
                                       {"translation", {0, light, 0}},
                                       {"scale", {2, 2, 2}}});
    const LoadedScene loaded = load(maker);
    const std::vector<Light> &lights = loaded.scene.lights;
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_EQ(lights[0].kind, LightKind::Point);
    EXPECT_NEAR(lights[0].power.x, 8.0 * std::numbers::pi, 1e-9);
    EXPECT_NEAR(lights[0].power.y, 4.0 * std::numbers::pi, 1e-9);
    EXPECT_EQ(lights[1].position, glm::dvec3(0, 1, 0));
    EXPECT_EQ(lights[1].direction, glm::dvec3(0, 0, -1));
    EXPECT_NEAR(lights[1].angleDegrees, 0.5 * 180.0 / std::numbers::pi, 1e-9);
    EXPECT_NEAR(lights[1].blend, 0.5, 1e-9);
    EXPECT_EQ(lights[1].fade, SpotFade::Square);
    EXPECT_EQ(lights[2].kind, LightKind::Directional);
    EXPECT_EQ(lights[2].power, glm::dvec3(3.0));
    EXPECT_TRUE(loaded.scene.environment.radiance.pixels().empty());
    ASSERT_EQ(loaded.meshReports.at(0).warnings.size(), 1u);
    EXPECT_NE(loaded.meshReports[0].warnings[0].find("lights/0/range"), std::string::npos);
}

TEST_F(GltfView, WithoutLightsThereIsTheNeutralEnvironment) {
    const LoadedScene loaded = load(oneTriangle());
    const Image &image = loaded.scene.environment.radiance;
    ASSERT_FALSE(image.pixels().empty());
    EXPECT_EQ(loaded.settings.integrator, Integrator::Path);
    EXPECT_EQ(loaded.settings.tree, TreeKind::Sah);
    double sum = 0.0;
    double weights = 0.0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const double weight = std::sin(std::numbers::pi * (y + 0.5) / image.height());
            const glm::vec3 &pixel = image.pixels()[static_cast<std::size_t>(y * image.width() + x)];
            EXPECT_EQ(pixel.x, pixel.y);
            sum += weight * static_cast<double>(pixel.x);
            weights += weight;
        }
    EXPECT_NEAR(sum / weights, 0.7, 1e-5);
}

/// A triangle whose node is moved by an animation of that interpolation.
GltfMaker animated(const char *interpolation, const std::vector<double> &times,
                   const std::vector<double> &values) {
    GltfMaker maker = oneTriangle();
    const std::size_t input = maker.addScalars(times);
    const std::size_t output = maker.addVec3(values);
    maker.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}}}};
    return maker;
}

TEST_F(GltfView, AnimationsMoveNodesInTime) {
    const auto placeAt = [&](const GltfMaker &maker, double seconds) {
        return cornersOf(load(maker, {.timeSeconds = seconds}).scene.meshes.at(0)).at(0).x;
    };
    const GltfMaker linear = animated("LINEAR", {1, 3}, {0, 0, 0, 4, 0, 0});
    EXPECT_EQ(cornersOf(load(linear).scene.meshes.at(0)).at(1).x, 1.0f); // at rest
    EXPECT_EQ(placeAt(linear, 0.0), 0.0f);
    EXPECT_NEAR(placeAt(linear, 1.5), 1.0f, 1e-6f);
    EXPECT_EQ(placeAt(linear, 9.0), 4.0f);
    const GltfMaker step = animated("STEP", {1, 3}, {0, 0, 0, 4, 0, 0});
    EXPECT_EQ(placeAt(step, 2.9), 0.0f);
    EXPECT_EQ(placeAt(step, 3.0), 4.0f);
    // Tangents of 2 a second lead straight from 0 to 4 in two seconds; with others the middle is off by their
    // difference.
    const GltfMaker spline =
        animated("CUBICSPLINE", {1, 3}, {0, 0, 0, 0, 0, 0, 2, 0, 0, 2, 0, 0, 4, 0, 0, 0, 0, 0});
    EXPECT_NEAR(placeAt(spline, 1.5), 1.0f, 1e-6f);
    const GltfMaker swinging =
        animated("CUBICSPLINE", {0, 1}, {0, 0, 0, 0, 0, 0, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_NEAR(placeAt(swinging, 0.5), 1.0f, 1e-6f); // (t^3 - 2 t^2 + t) 8 = 1
    EXPECT_THROW(static_cast<void>(placeAt(animated("LINEAR", {1, 3}, {0, 0, 0}), 1.0)), Error);
}

/// A triangle, and a camera below a node that an animation moves; the camera's node is 2.
GltfMaker withMovingCamera() {
    GltfMaker maker = animated("LINEAR", {0, 1}, {0, 0, 5, 2, 0, 5});
    maker.json["animations"][0]["channels"][0]["target"]["node"] = 1;
    maker.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    maker.json["nodes"].push_back({{"children", {2}}});
    maker.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 1, 0}}});
    maker.json["scenes"][0]["nodes"] = {0, 1};
    return maker;
}

TEST_F(GltfView, CamerasMoveInTheFramesOfASequence) {
    const LoadedScene loaded = load(withMovingCamera(), {.sequence = SequenceTimes{4.0, 0, 6}});
    EXPECT_FALSE(loaded.movesByTime);
    ASSERT_EQ(loaded.cameraPath.size(), 7u);
    for (int frame = 0; frame <= 6; ++frame) {
        const CameraPose &pose = loaded.cameraPath[static_cast<std::size_t>(frame)];
        EXPECT_NEAR(glm::length(pose.position - glm::dvec3(std::min(0.5 * frame, 2.0), 1.0, 5.0)), 0.0, 1e-6);
        EXPECT_EQ(pose.direction, glm::dvec3(0.0, 0.0, -1.0));
    }
    EXPECT_TRUE(load(withMovingCamera()).cameraPath.empty());
    GltfMaker flat = withMovingCamera();
    flat.json["nodes"][1]["scale"] = {1, 1, 1};
    flat.json["animations"][0]["channels"][0]["target"]["path"] = "scale";
    const std::size_t zero = flat.addVec3({1, 1, 1, 0, 0, 0});
    flat.json["animations"][0]["samplers"][0]["output"] = zero;
    try {
        static_cast<void>(load(flat, {.sequence = SequenceTimes{4.0, 0, 6}}));
        FAIL();
    } catch (const Error &error) {
        EXPECT_NE(std::string(error.what()).find("the camera is flattened in frame 4"), std::string::npos)
            << error.what();
    }
}

TEST_F(GltfView, WhatElseMovesIsToBeLoadedForEachFrame) {
    const LoadOptions options{.sequence = SequenceTimes{24.0, 0, 1}};
    EXPECT_FALSE(load(oneTriangle(), options).movesByTime);
    EXPECT_TRUE(load(animated("LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0}), options).movesByTime);
    GltfMaker carried = withMovingCamera(); // with the camera
    carried.json["nodes"][1]["children"] = {2, 0};
    carried.json["scenes"][0]["nodes"] = {1};
    EXPECT_TRUE(load(carried, options).movesByTime);
}

TEST_F(GltfView, RotationsGoTheShorterWay) {
    GltfMaker maker = oneTriangle();
    const std::size_t input = maker.addScalars({0, 1});
    const double h = std::sqrt(0.5);
    const std::size_t output = maker.addVec4({0, 0, 0, 1, 0, 0, -h, -h}); // the second is 90 degrees about z
    maker.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}},
         {"samplers", {{{"input", input}, {"output", output}}}}}};
    const glm::vec3 corner = cornersOf(load(maker, {.timeSeconds = 0.5}).scene.meshes.at(0)).at(1);
    EXPECT_NEAR(corner.x, h, 1e-6);
    EXPECT_NEAR(corner.y, h, 1e-6);
}

TEST_F(GltfView, MorphTargetsFollowWeights) {
    GltfMaker maker = oneTriangle();
    const std::size_t target = maker.addVec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
    maker.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", target}}};
    const auto heightOf = [&](const LoadOptions &options = {}) {
        return cornersOf(load(maker, options).scene.meshes.at(0)).at(0).z;
    };
    EXPECT_EQ(heightOf(), 0.0f);
    maker.json["meshes"][0]["weights"] = {0.25};
    EXPECT_EQ(heightOf(), 0.25f);
    maker.json["nodes"][0]["weights"] = {0.5};
    EXPECT_EQ(heightOf(), 0.5f);
    const std::size_t input = maker.addScalars({0, 1});
    const std::size_t output = maker.addScalars({0, 2});
    maker.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
         {"samplers", {{{"input", input}, {"output", output}}}}}};
    EXPECT_EQ(heightOf({.timeSeconds = 0.5}), 1.0f);
}

TEST_F(GltfView, SkinsMoveVerticesWithTheirJoints) {
    GltfMaker maker = oneTriangle();
    nlohmann::json &attributes = maker.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = maker.add<std::uint8_t>("VEC4", 5121, 4, {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    attributes["WEIGHTS_0"] = maker.addVec4({1, 0, 0, 0, 0.5, 0.5, 0, 0, 0, 1, 0, 0});
    const std::size_t inverses =
        maker.add<float>("MAT4", 5126, 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1, //
                                            1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1});
    maker.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", inverses}}};
    maker.json["scenes"][0]["nodes"] = {0, 1};
    // The node of the mesh does not count; the second joint is 10 above its place of rest at x = 1.
    maker.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}},
                           {{"children", {2}}},
                           {{"translation", {1, 0, 10}}}};
    const std::vector<glm::vec3> corners = cornersOf(load(maker).scene.meshes.at(0));
    EXPECT_EQ(corners.at(0), glm::vec3(0, 0, 0));
    EXPECT_EQ(corners.at(1), glm::vec3(1, 0, 5));
    EXPECT_EQ(corners.at(2), glm::vec3(0, 1, 10));
    maker.json["skins"][0]["joints"] = {1};
    EXPECT_NE(refusal(maker).find("names joint 1"), std::string::npos);
}

} // namespace
} // namespace hyalite::core
