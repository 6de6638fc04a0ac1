// assets/hyalite-scene.schema.json tells editors what the loader takes: the same keys, names, limits and defaults.
#include "host/scene/limits.h"
#include "tests/fixtures/scene_json_fixture.h"
#include "tests/fixtures/test_scene.h"

#include <set>
#include <span>
#include <utility>
#include <vector>

namespace hyalite::core {
namespace {

using nlohmann::json;
using Pointer = json::json_pointer;

using SceneSchema = SceneFolder;

json schema() {
    return json::parse(
        std::ifstream(std::filesystem::path(HYALITE_SOURCE_DIR) / "assets/hyalite-scene.schema.json"));
}

/// An object of the grammar: its definition in the schema, its keys in the loader, its place in completeScene().
struct GrammarObject {
    Pointer definition;
    std::vector<std::string_view> keys;
    Pointer place;
};

std::vector<GrammarObject> grammar() {
    const Pointer defs("/$defs");
    const auto ofKind = [](MaterialKind kind) { return scene_keys::material(rowOf(kind)); };
    const auto all = [](const auto &keys) { return std::vector<std::string_view>(keys.begin(), keys.end()); };
    return {
        {Pointer(), all(scene_keys::top), Pointer()},
        {defs / "camera", all(scene_keys::camera), Pointer("/camera")},
        {defs / "cameraPath", all(scene_keys::cameraPath), Pointer("/camera/path")},
        {defs / "cameraKey", all(scene_keys::cameraKey), Pointer("/camera/path/keys/0")},
        {defs / "environment", all(scene_keys::environment), Pointer("/environment")},
        {defs / "point light", all(scene_keys::pointLight), Pointer("/lights/0")},
        {defs / "spot light", all(scene_keys::spotLight), Pointer("/lights/1")},
        {defs / "directional light", all(scene_keys::directionalLight), Pointer("/lights/2")},
        {defs / "diffuse", ofKind(MaterialKind::Diffuse), Pointer("/materials/paper")},
        {defs / "mirror", ofKind(MaterialKind::Mirror), Pointer("/materials/chrome")},
        {defs / "dielectric", ofKind(MaterialKind::Dielectric), Pointer("/materials/ice")},
        {defs / "conductor", ofKind(MaterialKind::Conductor), Pointer("/materials/brass")},
        {defs / "principled", ofKind(MaterialKind::Principled), Pointer("/materials/varnish")},
        {defs / "gltf", ofKind(MaterialKind::Gltf), Pointer("/materials/velvet")},
        {defs / "gltf" / "properties" / "textures", scene_keys::textures(rowOf(MaterialKind::Gltf)),
         Pointer("/materials/velvet/textures")},
        {defs / "diffuse" / "properties" / "textures", scene_keys::textures(rowOf(MaterialKind::Diffuse)),
         Pointer("/materials/paper/textures")},
        {defs / "principled" / "properties" / "textures",
         scene_keys::textures(rowOf(MaterialKind::Principled)), Pointer("/materials/varnish/textures")},
        {defs / "texture", all(scene_keys::texture), Pointer("/materials/paper/textures/baseColour")},
        {defs / "normalMap", all(scene_keys::normalMap), Pointer("/materials/paper/textures/normal")},
        {defs / "sphere", all(scene_keys::sphere), Pointer("/spheres/0")},
        {defs / "mesh", all(scene_keys::mesh), Pointer("/meshes/0")},
        {defs / "shape", all(scene_keys::shape), Pointer("/shapes/0")},
        {defs / "settings", all(scene_keys::settings), Pointer("/settings")},
    };
}

TEST_F(SceneSchema, SchemaAndLoaderNameTheSameKeys) {
    const json document = schema();
    for (const GrammarObject &object : grammar()) {
        const json &definition = document.at(object.definition);
        std::set<std::string> inSchema;
        for (const auto &[key, value] : definition.at("properties").items())
            inSchema.insert(key);
        EXPECT_EQ(inSchema, std::set<std::string>(object.keys.begin(), object.keys.end()))
            << object.definition.to_string();
        EXPECT_EQ(definition.at("additionalProperties"), false) << object.definition.to_string();
    }
}

TEST_F(SceneSchema, EveryKeyOfTheSchemaIsAcceptedAndRead) {
    const json document = schema();
    EXPECT_EQ(refusal(completeScene().dump()), "");
    for (const GrammarObject &object : grammar())
        for (const auto &[key, property] : document.at(object.definition).at("properties").items()) {
            json scene = completeScene();
            if (key == "direction" && scene.at(object.place).contains("target")) {
                scene[object.place].erase("target");
                scene[object.place]["direction"] = {0, 0, 1};
                EXPECT_EQ(refusal(scene.dump()), "");
            }
            if (key == "materialOverrides") {
                scene["meshes"][0].erase("material");
                scene["meshes"][0]["materialOverrides"] = json::object();
                EXPECT_EQ(refusal(scene.dump()), "");
            }
            const Pointer place = object.place / key;
            ASSERT_TRUE(scene.contains(place)) << place.to_string();
            // No key takes true or false and something else: one that is let through was not read.
            scene[place] = scene[place].is_boolean() ? json("no") : json(true);
            EXPECT_TRUE(refusal(scene.dump()).starts_with(" " + place.to_string() + ": "))
                << place.to_string();
        }
}

TEST_F(SceneSchema, NullIsAsGoodAsNoKey) {
    for (const GrammarObject &object : grammar())
        for (const std::string_view key : object.keys) {
            const Pointer place = object.place / std::string(key);
            json absent = completeScene();
            absent[object.place].erase(std::string(key));
            json null = completeScene();
            null[place] = nullptr;
            EXPECT_EQ(refusal(null.dump()), refusal(absent.dump())) << place.to_string();
        }
}

TEST_F(SceneSchema, SchemaAndLoaderRequireTheSameKeys) {
    const json document = schema();
    for (const GrammarObject &object : grammar())
        for (const std::string_view key : object.keys) {
            json scene = completeScene();
            scene[object.place].erase(std::string(key));
            if (key == "materials") { // their users cannot stay
                scene.erase("spheres");
                scene.erase("shapes");
                scene.erase("meshes");
            }
            const json required = document.at(object.definition).value("required", json::array());
            const bool isRequired = std::find(required.begin(), required.end(), key) != required.end();
            EXPECT_EQ(refusal(scene.dump()).find("missing") != std::string::npos, isRequired)
                << (object.place / std::string(key)).to_string();
        }
}

TEST_F(SceneSchema, SchemaAndLoaderListTheSameNames) {
    const json document = schema();
    const std::pair<const char *, const char *> choices[] = {
        {"/$defs/camera/properties/type", "/camera/type"},
        {"/$defs/cameraPath/properties/interpolation", "/camera/path/interpolation"},
        {"/$defs/conductor/properties/metal", "/materials/brass/metal"},
        {"/$defs/shape/properties/type", "/shapes/0/type"},
    };
    for (const auto &[definition, place] : choices) {
        std::set<std::string> names = document.at(Pointer(definition)).at("enum");
        json scene = completeScene();
        scene["shapes"][0].erase("segments"); // quads and boxes have none
        for (const std::string &name : names) {
            scene[Pointer(place)] = name;
            EXPECT_EQ(refusal(scene.dump()), "") << place;
        }
        scene[Pointer(place)] = "no such name";
        const std::string message = refusal(scene.dump());
        // found "no such name"; allowed: "a", "b": four quotation marks a pair of names, two for what was found
        EXPECT_EQ(static_cast<std::size_t>(std::count(message.begin(), message.end(), '"')),
                  2 + 2 * names.size())
            << message;
    }
}

TEST_F(SceneSchema, SchemaAndLoaderHaveTheSameLimits) {
    const json defs = schema().at("$defs");
    const std::pair<const char *, Interval> ranges[] = {
        {"/camera/properties/horizontalFov", limits::horizontalFovDegrees},
        {"/camera/properties/aperture", limits::aperture},
        {"/camera/properties/focusDistance", limits::focusDistance},
        {"/camera/properties/viewWidth", limits::viewWidth},
        {"/cameraKey/properties/frame", limits::frame},
        {"/cameraKey/properties/horizontalFov", limits::horizontalFovDegrees},
        {"/cameraKey/properties/aperture", limits::aperture},
        {"/cameraKey/properties/focusDistance", limits::focusDistance},
        {"/cameraKey/properties/viewWidth", limits::viewWidth},
        {"/environment/properties/scale", limits::environmentScale},
        {"/environment/properties/rotateDegrees", limits::rotateDegrees},
        {"/spot light/properties/angle", limits::spotAngle},
        {"/fraction", limits::fraction},
        {"/conductor/properties/index", limits::conductorIndex},
        {"/conductor/properties/index/items", limits::conductorIndex},
        {"/principled/properties/index", limits::refractiveIndex},
        {"/imageSize", limits::imageSize},
        {"/dielectric/properties/index", limits::refractiveIndex},
        {"/sphere/properties/radius", limits::radius},
        {"/mesh/properties/scale", limits::meshScale},
        {"/mesh/properties/rotateDegrees/items", limits::rotateDegrees},
        {"/shape/properties/segments", limits::segments},
        {"/settings/properties/shadowThroughGlass", limits::fraction},
        {"/point/items", limits::coordinate},
        {"/diffuse/properties/albedo", limits::fraction},
        {"/diffuse/properties/albedo/items", limits::fraction},
        {"/texturePlacement", limits::texturePlacement},
        {"/texturePlacement/items", limits::texturePlacement},
        {"/normalMap/properties/strength", limits::normalStrength},
        {"/lightColour", limits::power},
        {"/lightColour/items", limits::radiance},
    };
    for (const auto &[place, interval] : ranges) {
        const json &range = defs.at(Pointer(place));
        EXPECT_EQ(range.value(interval.lowIncluded ? "minimum" : "exclusiveMinimum", json()), interval.low)
            << place;
        EXPECT_EQ(range.value(interval.highIncluded ? "maximum" : "exclusiveMaximum", json()), interval.high)
            << place;
    }
    const json properties = schema().at("properties");
    EXPECT_EQ(defs.at("cameraPath").at("properties").at("keys").at("maxItems"), limits::cameraKeyCount);
    EXPECT_EQ(properties.at("lights").at("maxItems"), limits::lightCount);
    EXPECT_EQ(properties.at("spheres").at("maxItems"), limits::sphereCount);
    EXPECT_EQ(properties.at("meshes").at("maxItems"), limits::meshCount);
    EXPECT_EQ(properties.at("shapes").at("maxItems"), limits::meshCount);
    EXPECT_EQ(properties.at("materials").at("maxProperties"), limits::materialCount);
}

TEST_F(SceneSchema, TheDefaultsOfTheSchemaAreThoseOfTheScene) {
    const json document = schema();
    const auto defaultsOf = [&](const std::string &name) {
        json values = json::object();
        for (const auto &[key, property] : document.at("$defs").at(name).at("properties").items()) {
            json described = property;
            if (property.contains("$ref"))
                described.update(document.at(Pointer(property.at("$ref").get<std::string>().substr(1))));
            described.update(property);
            if (described.contains("default"))
                values[key] = described.at("default");
        }
        return values;
    };
    json file = {{"camera", defaultsOf("camera")}, {"settings", defaultsOf("settings")}};
    file["background"] = document.at("properties").at("background").at("default");
    EXPECT_EQ(file["camera"].size(), scene_keys::camera.size() - 2); // all but target
    EXPECT_EQ(file["settings"].size(), scene_keys::settings.size());
    for (const char *kind : {"diffuse", "dielectric", "conductor"}) {
        file["materials"][kind] = defaultsOf(kind);
        file["materials"][kind]["type"] = kind;
    }
    const json principled = defaultsOf("principled");
    EXPECT_EQ(principled.size(),
              scene_keys::material(rowOf(MaterialKind::Principled)).size() -
                  3); // but type, textures, twoSided
    file["materials"]["given"] = principled;
    file["materials"]["given"]["type"] = "principled";
    file["materials"]["left out"]["type"] = "principled";

    const TestScene scene = load(file.dump());
    const TestScene expected;
    EXPECT_EQ(scene.camera.position, expected.camera.position);
    EXPECT_EQ(scene.camera.direction, expected.camera.direction);
    EXPECT_EQ(scene.camera.up, expected.camera.up);
    EXPECT_EQ(scene.camera.horizontalFovDegrees, expected.camera.horizontalFovDegrees);
    EXPECT_EQ(scene.camera.width, expected.camera.width);
    EXPECT_EQ(scene.camera.height, expected.camera.height);
    EXPECT_EQ(scene.background, expected.background);
    EXPECT_EQ(scene.shadowThroughGlass, expected.shadowThroughGlass);
    EXPECT_EQ(settingsToJson(scene.settings), settingsToJson(expected.settings));
    EXPECT_EQ(scene.camera.kind, expected.camera.kind);
    EXPECT_EQ(scene.camera.aperture, expected.camera.aperture);
    EXPECT_EQ(scene.camera.focusDistance, expected.camera.focusDistance);
    EXPECT_EQ(scene.camera.viewWidth, expected.camera.viewWidth);
    ASSERT_EQ(scene.materials.size(), 5u);
    const auto byName = [&](const std::string &name) {
        return *std::find_if(scene.materials.begin(), scene.materials.end(),
                             [&](const Material &material) { return material.name == name; });
    };
    EXPECT_EQ(byName("given").roughness, byName("left out").roughness);
    EXPECT_EQ(byName("given").specular, byName("left out").specular);
    EXPECT_EQ(byName("given").clearcoatRoughness, byName("left out").clearcoatRoughness);
    for (const Material &material : scene.materials) {
        EXPECT_EQ(material.conductorIndex, Material{}.conductorIndex);
        EXPECT_EQ(material.conductorExtinction, Material{}.conductorExtinction);
        EXPECT_EQ(material.metallic, Material{}.metallic);
        EXPECT_EQ(material.transmission, Material{}.transmission);
        EXPECT_EQ(material.clearcoat, Material{}.clearcoat);
        EXPECT_EQ(material.albedo, Material{}.albedo);
        EXPECT_EQ(material.twoSided, Material{}.twoSided);
        EXPECT_EQ(material.refractiveIndex, Material{}.refractiveIndex);
        EXPECT_EQ(material.segmentTint, Material{}.segmentTint);
    }
}

} // namespace
} // namespace hyalite::core
