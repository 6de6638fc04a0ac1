// A minimal scene for each flag by which kernels are specialised.
#pragma once

#include "host/packing/packed_scene.h"
#include "host/scene/scene.h"
#include "tests/fixtures/test_scene.h"

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace hyalite::core::testing {

struct FlagScene {
    std::string flag; ///< its constant in shaders/layout/layout.h; of a texture slot that of the slot
    TestScene scene;
    /// What the flag's word is of the packed scene, and what it is of this scene, where nothing else needs it.
    std::function<std::uint32_t(const PackedScene &)> word;
    std::uint32_t expected;
    /// Makes kernels leave out what the flag stands for; empty: the scene's own records decide.
    std::function<void(PackedScene &)> clear{};
    bool isEncoded = false; ///< textures keep their 8-bit levels
};

/// For messages of tests.
inline void PrintTo(const FlagScene &row, std::ostream *stream) { *stream << row.flag; }

[[nodiscard]] std::vector<FlagScene> flagScenes();

} // namespace hyalite::core::testing
