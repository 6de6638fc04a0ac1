// Random scenes, drawn from the tables that readers of scene files are made from: materials, textures, settings, and
// the words for shapes, lights and cameras. What a table gains is drawn without a change here.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>

namespace hyalite::core::testing {

struct RandomScene {
    nlohmann::json document; ///< see scene_document.h
    bool isFurnace = false;  ///< all light comes from around and is 1, so that no radiance exceeds 1
    bool isExtreme = false;  ///< has numbers whose products may exceed the largest float
};

/// So many seeds, from a multiple of it on, have scenes of one kind: with other numbers, but mostly for the same
/// specialised kernel, as a driver compiles a kernel for longer than it renders a hundred of these scenes.
inline constexpr std::uint64_t scenesOfKind = 8;

/// The scene of a seed: the same everywhere, as its numbers are sums, products and roots. It is valid.
[[nodiscard]] RandomScene drawScene(std::uint64_t seed);

} // namespace hyalite::core::testing
