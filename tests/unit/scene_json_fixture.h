// A folder of its own for each test of the scene file, and a scene that uses the whole grammar.
#pragma once

#include "host/error.h"
#include "host/image/png.h"
#include "host/scene/scene_json.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace hyalite {

/// Writes scene files and loads them; a mesh of one triangle, triangle.obj, and two images, sky.pfm and
/// image.png, lie beside them.
class SceneFolder : public testing::Test {
  protected:
    void SetUp() override {
        std::filesystem::create_directories(folder);
        static_cast<void>(write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n"));
        const std::uint8_t bluish[] = {128, 128, 255};
        const std::vector<std::byte> image = encodePng(1, 1, bluish);
        static_cast<void>(
            write("image.png", std::string(reinterpret_cast<const char *>(image.data()), image.size())));
        static_cast<void>(write("sky.pfm", "PF\n2 1\n-1\n" + std::string(24, '\0'))); // black
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    [[nodiscard]] std::filesystem::path write(const std::string &name, const std::string &text) const {
        std::ofstream(folder / name, std::ios::binary) << text;
        return folder / name;
    }

    [[nodiscard]] Scene load(const std::string &text) const {
        return loadSceneFile(write("scene.json", text)).scene;
    }

    /// The message with which a file is refused, less its own name; empty where it is loaded.
    [[nodiscard]] static std::string refusalOf(const std::filesystem::path &file) {
        try {
            static_cast<void>(loadSceneFile(file));
        } catch (const Error &error) {
            EXPECT_EQ(error.exitCode, ExitCode::BadInput);
            const std::string message = error.what();
            EXPECT_TRUE(message.starts_with(file.string() + ":")) << message;
            return message.substr(std::min(message.size(), file.string().size() + 1));
        }
        return {};
    }
    [[nodiscard]] std::string refusal(const std::string &text) const {
        return refusalOf(write("scene.json", text));
    }

    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / fmt::format("hyalite-scene-json-{}", getpid());
};

/// A scene in which each object of the grammar stands once, with all of its keys (but `direction`, which
/// excludes `target`).
inline nlohmann::json completeScene() {
    return nlohmann::json::parse(R"({
        "$schema": "hyalite-scene.schema.json",
        "description": "all that there is",
        "camera": {"type": "perspective", "position": [1, 2, 3], "target": [1, 2, -4], "up": [0, 2, 0], "horizontalFov": 45.5,
                   "aperture": 0.25, "focusDistance": 8.5, "viewWidth": 12,
                   "width": 333, "height": 217},
        "background": [0.1, 0.2, 0.3],
        "environment": {"file": "sky.pfm", "scale": 0.5, "rotateDegrees": 30},
        "lights": [{"type": "point", "position": [-10, 20, 40], "power": [1, 2, 3]},
                   {"type": "spot", "position": [1, 2, 3], "power": 7, "direction": [0, 0, 2],
                    "angle": 40, "blend": 0.5},
                   {"type": "directional", "direction": [1, -1, 0], "irradiance": [3, 2, 1]}],
        "materials": {
            "paper": {"type": "diffuse", "albedo": [0.25, 0.5, 1], "twoSided": true,
                      "emission": [1, 2, 3],
                      "textures": {"baseColour": {"file": "image.png", "scale": [2, 3], "offset": 0.25},
                                   "emission": {"file": "image.png"},
                                   "normal": {"file": "image.png", "scale": 4, "offset": [0, 1], "strength": 0.5},
                                   "opacity": {"file": "image.png"}}},
            "chrome": {"type": "mirror"},
            "ice": {"type": "dielectric", "index": 1.31, "segmentTint": 0.75,
                    "absorption": [0.5, 0.25, 0], "priority": -2, "roughness": 0.3},
            "brass": {"type": "conductor", "metal": "copper", "index": [0.4, 0.5, 0.6], "extinction": 2,
                      "roughness": 0.25},
            "varnish": {"type": "principled", "baseColour": [0.1, 0.2, 0.3], "metallic": 0.125,
                        "roughness": 0.375, "specular": 0.625, "transmission": 0, "index": 1.25,
                        "absorption": 0.75, "priority": 4, "clearcoat": 0.875,
                        "clearcoatRoughness": 0.0625, "twoSided": true, "emission": 5,
                        "textures": {"baseColour": {"file": "image.png"}, "emission": {"file": "image.png"},
                                     "roughness": {"file": "image.png"}, "metallic": {"file": "image.png"},
                                     "normal": {"file": "image.png"}, "opacity": {"file": "image.png"}}}
        },
        "spheres": [{"centre": [4, 5, 6], "radius": 7, "material": "ice", "inwardNormal": true}],
        "meshes": [{"file": "triangle.obj", "scale": 2, "rotateDegrees": [0, 0, 90],
                    "translate": [0, 0, -5], "material": "paper"}],
        "settings": {"integrator": "whitted", "occlusionDistance": 7.5, "spp": 32, "maxDepth": 12, "bvh": "sah", "leafSize": 4,
                     "sampler": "centre", "filter": "blackman-harris", "seed": 4294967295, "clamp": 9, "exposure": -1.5, "shadowThroughGlass": 0.5}
    })");
}

} // namespace hyalite
