// Coverage: the objects and materials in a picture, by the share of its pixels that each covers.
#pragma once

#include "host/engine/prepare.h"
#include "host/image/crop.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

struct CoveredPixels {
    std::uint64_t pixelCount = 0;
    Crop box; ///< around them, in the whole image
};

/// A sphere, or a mesh at one of its places.
struct ObjectCoverage {
    std::optional<std::uint32_t> sphere; ///< its index; else it is a mesh
    std::string material{};              ///< of the sphere
    SceneNode node{};                    ///< of the mesh
    std::string file{};                  ///< glTF: the mesh file of a scene file whose node it is; or empty
    /// Which of the places of its node, in the order of the input; nothing where the node has one.
    std::optional<std::size_t> instance{};
    CoveredPixels pixels{};
};

struct MaterialCoverage {
    std::string name;
    CoveredPixels pixels;
};

struct Coverage {
    Crop crop;                                 ///< the part of the image that was looked at
    std::uint64_t pixelCount = 0;              ///< of it
    std::uint64_t backgroundCount = 0;         ///< pixels that see no object
    std::vector<ObjectCoverage> objects{};     ///< those that are seen, the largest first
    std::vector<MaterialCoverage> materials{}; ///< likewise
    std::size_t unseenCount = 0;               ///< objects that are not

    [[nodiscard]] double shareOf(std::uint64_t count) const {
        return static_cast<double>(count) / static_cast<double>(pixelCount);
    }
};

/// By the first hits of the reference renderer (first_hits.h). The source of the scene was kept.
[[nodiscard]] Coverage measureCoverage(const PreparedScene &prepared);

} // namespace hyalite::core
