// A viewer of a small scene, by renderers of the CPU, and waiting for it.
#pragma once

#include "host/view/viewer.h"
#include "tests/fixtures/temporary_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace hyalite::core::testing {

/// A folder of its own, which vanishes.
struct ViewerFolder : ::testing::Test {
    const TemporaryFolder temporary_;
    const std::filesystem::path &folder = temporary_.path;

    [[nodiscard]] std::string store(const std::string &name, const std::string &text) const {
        const std::filesystem::path path = folder / name;
        std::ofstream(path) << text;
        return path.string();
    }
};

/// A ball of this albedo on nothing, with a light, `spp` samples.
[[nodiscard]] inline std::string ballScene(double albedo, int samplesPerPixel = 4) {
    return R"({"camera": {"position": [0, 0, 5], "target": [0, 0, 0], "width": 24, "height": 16},
               "materials": {"clay": {"type": "diffuse", "albedo": )" +
           std::to_string(albedo) + R"(}},
               "spheres": [{"centre": [0, 0, 0], "radius": 1, "material": "clay"}],
               "lights": [{"type": "point", "position": [2, 3, 5], "power": 900}],
               "settings": {"integrator": "path", "spp": )" +
           std::to_string(samplesPerPixel) + "}}";
}

[[nodiscard]] inline ViewRequest requestOf(const std::string &scene,
                                           std::vector<RendererNames> renderers = {{"cpu"}}) {
    ViewRequest request;
    request.scene.scene = scene;
    request.renderers = std::move(renderers);
    return request;
}

/// Waits until the state is one that is meant; returns it.
inline nlohmann::ordered_json waitFor(const Viewer &viewer,
                                      const std::function<bool(const nlohmann::ordered_json &)> &isMeant) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    std::uint64_t seen = 0;
    nlohmann::ordered_json state = viewer.state();
    while (!isMeant(state) && std::chrono::steady_clock::now() < deadline) {
        seen = viewer.waitForNews(seen, std::chrono::milliseconds(1000));
        state = viewer.state();
    }
    EXPECT_TRUE(isMeant(state)) << state.dump(1);
    return state;
}

/// Waits until all renderers have finished the view that is wished.
inline nlohmann::ordered_json waitForAll(const Viewer &viewer) {
    return waitFor(viewer, [](const nlohmann::ordered_json &state) {
        bool isFinished = !state["isChanging"];
        for (const auto &renderer : state["renderers"])
            isFinished = isFinished && (renderer["isFinished"] || renderer["failure"] != "");
        return isFinished;
    });
}

} // namespace hyalite::core::testing
