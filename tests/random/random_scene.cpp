#include "tests/random/random_scene.h"

#include "host/import/scene_json.h"
#include "tests/random/random_draws.h"
#include "tests/random/random_files.h"

#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core::testing {
namespace {

using nlohmann::json;

/// What lights a scene.
enum class Plan {
    Open,    ///< anything
    Furnace, ///< a white background or environment alone, for `path`
    Room,    ///< a closed room of few triangles, one of which emits
    Crowd    ///< so many lights or emitting spheres that `path` has a light tree
};

class SceneDrawer {
  public:
    explicit SceneDrawer(std::uint64_t seed) : draws_(seed / scenesOfKind, seed % scenesOfKind) {
        const double chosen = draws_.share();
        plan_ = chosen < 0.45   ? Plan::Open
                : chosen < 0.65 ? Plan::Furnace
                : chosen < 0.8  ? Plan::Room
                                : Plan::Crowd;
        if (plan_ == Plan::Furnace)
            draws_.isExtreme = false;
    }

    RandomScene draw() {
        // A power of two: coordinates keep their digits.
        scale_ = draws_.chance(0.2) ? std::ldexp(1.0, draws_.whole(-12, 12)) : 1.0;
        drawLight();
        drawMaterials();
        drawObjects();
        drawCamera();
        drawSettings();
        return {{{"scene", scene_}, {"files", drawn_.files()}}, plan_ == Plan::Furnace, draws_.isExtreme};
    }

  private:
    json place(double half) { return scaled(draws_.vector(half)); }
    json scaled(json vector) const {
        for (json &coordinate : vector)
            coordinate = coordinate.get<double>() * scale_;
        return vector;
    }

    // ---- Light

    void drawLight() {
        if (plan_ == Plan::Furnace) {
            if (draws_.chance(0.3))
                scene_["environment"] = {{"file", drawn_.addSky(true)},
                                         {"rotateDegrees", draws_.uniform(-90, 90)}};
            else
                scene_["background"] = 1;
            return;
        }
        if (plan_ != Plan::Room && draws_.chance(0.6))
            scene_["background"] = draws_.colour(limits::radiance);
        if (plan_ != Plan::Room && draws_.chance(0.35)) {
            scene_["environment"] = {{"file", drawn_.addSky(false)}};
            if (draws_.chance(0.5))
                scene_["environment"]["scale"] = draws_.uniform(0.0, 3.0);
            if (draws_.chance(0.5))
                scene_["environment"]["rotateDegrees"] = draws_.number(limits::rotateDegrees);
        }
        const bool isCrowd = plan_ == Plan::Crowd && draws_.chance(0.6);
        const int count = isCrowd ? draws_.whole(66, 140) : draws_.chance(0.5) ? draws_.whole(1, 5) : 0;
        for (int i = 0; i < count; ++i)
            scene_["lights"].push_back(drawLightSource(static_cast<std::size_t>(i)));
    }

    json drawLightSource(std::size_t index) {
        const auto &[name, kind] = draws_.oneOf(lightNames);
        json light{{"type", name}};
        const auto direction = [&] {
            json vector = draws_.vector(1.0);
            vector[draws_.whole(0, 2)] = 1.0; // not 0
            return vector;
        };
        if (kind == LightKind::Directional) {
            light["irradiance"] = draws_.colour(limits::power);
        } else {
            light["position"] = place(5.0);
            light["power"] = draws_.colour(limits::power);
            for (json *channel : channelsOf(light["power"]))
                *channel = std::min(channel->get<double>() * 30.0 * scale_ * scale_, limits::power.high);
        }
        if (kind != LightKind::Point)
            light["direction"] = direction();
        if (kind == LightKind::Spot) {
            light["angle"] = draws_.number(limits::spotAngle);
            light["blend"] = draws_.number(limits::fraction);
            light["fade"] =
                spotFadeNames[index % spotFadeNames.size()].first; // seeds keep the rest of their scenes
        }
        if (kind != LightKind::Directional && index % 3 == 1) { // likewise
            light["profile"] = drawn_.addLamp(index / 3);
            if (kind == LightKind::Point)
                light["direction"] = {0.25 * static_cast<double>(index % 5) - 0.5, -1, 0.125};
            light["c0"] = {light["direction"][1], light["direction"][2], light["direction"][0]};
            if (light["direction"][0] == light["direction"][1] &&
                light["direction"][1] == light["direction"][2])
                light.erase("c0");
        }
        return light;
    }

    static std::vector<json *> channelsOf(json &colour) {
        if (!colour.is_array())
            return {&colour};
        return {&colour[0], &colour[1], &colour[2]};
    }

    // ---- Materials

    void drawMaterials() {
        const int count = draws_.whole(1, 5);
        for (int i = 0; i < count; ++i) {
            const std::string name = fmt::format("m{}", i);
            bool isForMeshes = false;
            scene_["materials"][name] = drawMaterial(draws_.oneOf(materialTable), isForMeshes);
            meshMaterials_.push_back(name);
            if (!isForMeshes)
                ballMaterials_.push_back(name);
        }
        if (plan_ == Plan::Room || plan_ == Plan::Crowd) {
            scene_["materials"]["lamp"] = {{"type", "diffuse"}, {"emission", draws_.colour({1.0, 20.0})}};
            if (draws_.chance(0.5))
                scene_["materials"]["lamp"]["twoSided"] = draws_.chance(0.5);
        }
        if (ballMaterials_.empty()) {
            scene_["materials"]["plain"] = {{"type", "diffuse"}};
            ballMaterials_.emplace_back("plain");
        }
    }

    json drawMaterial(const MaterialRow &row, bool &isForMeshes) {
        json material{{"type", row.name}};
        for (const MaterialKey &key : row.keys) {
            const bool isEmission = key.key == "emission";
            if (draws_.chance(isEmission ? plan_ == Plan::Furnace ? 0.0 : 0.15 : 0.4))
                std::visit([&](const auto &value) { material[key.key] = drawKey(value); }, key.value);
        }
        if (row.textures != 0 && draws_.chance(0.4))
            drawTextures(row, material, isForMeshes);
        // Validation allows one of the two.
        if (row.kind == MaterialKind::Principled && material.contains("transmission"))
            material["clearcoat"] = 0;
        return material;
    }

    json drawKey(const NumberKey &key) { return draws_.number(key.allowed); }
    json drawKey(const ColourKey &key) { return draws_.colour(key.allowed); }
    json drawKey(const WholeKey &key) { return static_cast<int>(std::round(draws_.number(key.allowed))); }
    json drawKey(const FlagKey &) { return draws_.chance(0.5); }
    json drawKey(const GroupKey &) { return draws_.chance(0.5) ? "a" : "b"; }
    json drawKey(const SidesKey &) { return draws_.chance(0.5); }
    json drawKey(const MetalKey &) { return draws_.oneOf(metalNames).first; }

    void drawTextures(const MaterialRow &row, json &material, bool &isForMeshes) {
        for (const TextureSlot &slot : textureSlots) {
            const bool isForbidden = plan_ == Plan::Furnace && slot.slot == layout::slotEmission;
            if ((row.textures >> slot.slot & 1u) == 0 || isForbidden || !draws_.chance(0.2))
                continue;
            const bool isNormal = slot.slot == layout::slotNormal || slot.slot == layout::slotClearcoatNormal;
            json use{{"file", drawn_.addImage(isNormal)}};
            if (draws_.chance(0.3))
                use["scale"] = draws_.chance(0.5)
                                   ? json(draws_.uniform(-3, 3))
                                   : json{draws_.number(limits::texturePlacement), draws_.uniform(-3, 3)};
            if (draws_.chance(0.3))
                use["offset"] = {draws_.uniform(-2, 2), draws_.number(limits::texturePlacement)};
            if (slot.slot == layout::slotNormal && draws_.chance(0.4))
                use["strength"] = draws_.number(limits::normalStrength);
            material["textures"][slot.name] = use;
            isForMeshes = isForMeshes || slot.slot == layout::slotOpacity;
        }
    }

    // ---- Objects

    void drawObjects() {
        if (plan_ == Plan::Room)
            drawRoom();
        const bool isCrowd = plan_ == Plan::Crowd && !scene_.contains("lights");
        const int lampCount = isCrowd ? draws_.whole(66, 90) : plan_ == Plan::Crowd ? draws_.whole(0, 3) : 0;
        for (int i = 0; i < lampCount; ++i)
            addSphere("lamp", 3.0, 0.3);
        const double amount = draws_.share();
        const bool isClosed = plan_ == Plan::Room && draws_.chance(0.7);
        const int sphereCount = isClosed || amount < 0.3 ? 0
                                : amount < 0.85          ? draws_.whole(1, 5)
                                                         : draws_.whole(15, 40);
        for (int i = 0; i < sphereCount; ++i)
            addSphere(draws_.oneOf(ballMaterials_), 2.0, 1.2);
        const int shapeCount = draws_.chance(0.6) ? draws_.whole(1, 3) : sphereCount == 0 ? 1 : 0;
        for (int i = 0; i < shapeCount; ++i)
            addShape(isClosed);
        if (!isClosed && draws_.chance(0.4))
            addObj();
        if (!isClosed && draws_.chance(0.35))
            addGlb();
        if (draws_.chance(0.3) && plan_ != Plan::Room) // a floor
            scene_["shapes"].push_back({{"type", "quad"},
                                        {"material", draws_.oneOf(meshMaterials_)},
                                        {"transform", json::array({{{"scale", 8.0 * scale_}},
                                                                   {{"rotateDegrees", {-90, 0, 0}}},
                                                                   {{"translate", scaled({0, -2, 0})}}})}});
        for (const char *kind : {"spheres", "shapes"}) // coincident surfaces
            if (scene_.contains(kind) && draws_.chance(0.08)) {
                json twin = draws_.oneOf(scene_[kind]);
                twin["material"] = draws_.oneOf(ballMaterials_);
                scene_[kind].push_back(twin);
            }
    }

    void drawRoom() {
        const std::string wall = draws_.oneOf(meshMaterials_);
        scene_["shapes"].push_back(
            {{"type", "box"}, {"material", wall}, {"transform", json::array({{{"scale", 9.0 * scale_}}})}});
        scene_["shapes"].push_back({{"type", "quad"},
                                    {"material", "lamp"},
                                    {"transform", json::array({{{"scale", 3.0 * scale_}},
                                                               {{"rotateDegrees", {90, 0, 0}}},
                                                               {{"translate", scaled({0, 8, 0})}}})}});
    }

    void addSphere(const std::string &material, double half, double radius) {
        json sphere{{"centre", place(half)},
                    {"radius", std::max(draws_.uniform(0, radius), 0.01) * scale_},
                    {"material", material}};
        if (draws_.chance(0.15))
            sphere["inwardNormal"] = draws_.chance(0.7);
        scene_["spheres"].push_back(sphere);
    }

    void addShape(bool isSmall) {
        const auto &[name, kind] = draws_.oneOf(shapeNames);
        json shape{{"type", name}, {"material", draws_.oneOf(meshMaterials_)}, {"transform", transform(2.0)}};
        if (kind == ShapeKind::Disk || kind == ShapeKind::Cylinder)
            shape["segments"] = draws_.whole(3, isSmall ? 5 : 16);
        if (!isSmall)
            drawInstances(shape);
        scene_["shapes"].push_back(shape);
    }

    void drawInstances(json &object) {
        if (!draws_.chance(0.3))
            return;
        const int count = draws_.whole(1, 4);
        for (int i = 0; i < count; ++i)
            object["instances"].push_back(instance());
    }

    double factor() { return (draws_.chance(0.2) ? -1.0 : 1.0) * (draws_.uniform(0.0, 1.2) + 0.1); }

    json transform(double half) {
        json steps = json::array();
        steps.push_back(
            {{"scale", draws_.chance(0.5) ? json(factor()) : json{factor(), factor(), factor()}}});
        if (draws_.chance(0.7))
            steps.push_back({{"rotateDegrees", draws_.vector(180.0)}});
        steps.push_back({{"translate", draws_.vector(half)}});
        if (scale_ != 1.0)
            steps.push_back({{"scale", scale_}});
        return steps;
    }

    /// In the space of what is scaled already.
    json instance() {
        json steps = json::array();
        if (draws_.chance(0.6))
            steps.push_back({{"scale", factor()}});
        if (draws_.chance(0.6))
            steps.push_back({{"rotateDegrees", draws_.vector(180.0)}});
        if (draws_.chance(0.2)) // a shear
            steps.push_back(
                {{"matrix", {1, draws_.uniform(-1, 1), 0, 0, 0, 1, 0, 0, 0, draws_.uniform(-1, 1), 1, 0}}});
        steps.push_back({{"translate", place(2.0)}});
        return steps;
    }

    void addObj() {
        const std::string file = drawn_.addObj();
        json mesh{{"file", file}, {"transform", transform(2.0)}};
        if (draws_.chance(0.8))
            mesh["material"] = draws_.oneOf(meshMaterials_);
        if (draws_.chance(0.3))
            mesh["scale"] = factor();
        if (draws_.chance(0.3))
            mesh["rotateDegrees"] = draws_.vector(180.0);
        if (draws_.chance(0.3))
            mesh["translate"] = draws_.vector(0.5);
        drawInstances(mesh);
        scene_["meshes"].push_back(mesh);
    }

    void addGlb() {
        const std::string file = drawGlb(draws_, drawn_, plan_ != Plan::Furnace);
        json mesh{{"file", file}, {"transform", transform(2.0)}};
        drawInstances(mesh);
        scene_["meshes"].push_back(mesh);
    }

    // ---- Camera and settings

    void drawCamera() {
        const auto &[name, kind] = draws_.oneOf(cameraNames);
        json camera{{"type", draws_.chance(0.5) ? "perspective" : name}, {"width", 24}, {"height", 16}};
        json position = draws_.vector(4.0);
        position[2] = draws_.uniform(3.0, 7.0);
        camera["position"] = scaled(position);
        camera["target"] = place(1.0);
        if (draws_.chance(0.2))
            camera["up"] = {draws_.uniform(-1, 1), 1, draws_.uniform(-1, 1)};
        if (camera["type"] == "perspective") {
            if (draws_.chance(0.6))
                camera["horizontalFov"] = draws_.number(limits::horizontalFovDegrees);
            if (draws_.chance(0.3))
                camera["aperture"] = draws_.uniform(0, 2) * scale_;
            if (draws_.chance(0.3))
                camera["focusDistance"] = draws_.uniform(0.1, 9) * scale_;
        }
        if (camera["type"] == "orthographic")
            camera["viewWidth"] = draws_.uniform(0.1, 8) * scale_;
        scene_["camera"] = camera;
    }

    template <class Number> json drawSetting(const NumberSetting<Number> &setting) {
        const double number = draws_.number(setting.allowed);
        return std::is_integral_v<Number> ? json(static_cast<std::int64_t>(std::round(number)))
                                          : json(number);
    }
    json drawSetting(const FlagSetting &) { return draws_.chance(0.5); }
    template <class Value> json drawSetting(const ChoiceSetting<Value> &setting) {
        return draws_.oneOf(setting.names).first;
    }

    void drawSettings() {
        json settings = json::object();
        for (const Setting &setting : settingsTable)
            if (draws_.chance(0.5))
                std::visit([&](const auto &value) { settings[setting.key] = drawSetting(value); },
                           setting.value);
        if (plan_ != Plan::Open || draws_.chance(0.5))
            settings["integrator"] = nameOf(Integrator::Path);
        else if (!settings.contains("integrator"))
            settings["integrator"] = draws_.oneOf(integratorNames).first;
        if (draws_.chance(0.3))
            settings["shadowThroughGlass"] = draws_.number(limits::fraction);
        const bool isDenoised = settings.value("denoise", false) || settings.value("denoisingData", false);
        settings["spp"] = draws_.whole(isDenoised ? 2 : 1, 4);
        settings["maxDepth"] = draws_.whole(1, settings["integrator"] == nameOf(Integrator::Path) ? 32 : 8);
        if (settings.contains("filter") && settings["filter"] != nameIn(filterNames, FilterKind::Box))
            settings["sampler"] = nameOf(SamplerKind::Sobol);
        if (settings.value("alphaThroughGlass", false))
            settings["alpha"] = true;
        scene_["settings"] = settings;
    }

    Draws draws_;
    Plan plan_ = Plan::Open;
    double scale_ = 1.0;
    json scene_ = json::object();
    FileDraws drawn_{draws_};
    std::vector<std::string> meshMaterials_;
    std::vector<std::string> ballMaterials_;
};

} // namespace

RandomScene drawScene(std::uint64_t seed) { return SceneDrawer(seed).draw(); }

} // namespace hyalite::core::testing
