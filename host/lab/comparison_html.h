// Comparison as an HTML page: two pictures to be looked at, and their figures. It needs no network.
#pragma once

#include "host/image/attribute.h"
#include "host/image/comparison.h"

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

/// Of larger pictures, a page holds a part of so many pixels: 1920x1080 are whole. The page of two has 75 MiB.
inline constexpr std::int64_t pagePixelCountMax = std::int64_t{1} << 21;

struct ComparedPicture {
    std::string role; ///< "reference", "first", ...
    std::string name;
    const Image &colour; ///< as it is compared: over black
    std::span<const float> alpha{};
    std::vector<Attribute> origin{};
};

struct ComparisonPage {
    std::string title;
    std::string verdict;
    bool isPassed = false;
    ComparedPicture first;
    ComparedPicture second;
    const ImageComparison &comparison;
    Mask mask{};
    glm::ivec2 centre{0};            ///< the pixel to be seen of pictures that are too large
    glm::ivec2 corner{0};            ///< of the pictures, in the whole image
    nlohmann::ordered_json report{}; ///< with comparisonToJson()
};

/// The page's JSON is the report, and in "page":
///
///     title, verdict          texts
///     corner                  [x, y] of the pictures in the whole image
///     window                  [x0, x1, y0, y1], the part of the pictures that the page has
///     channels                3, or 4 with alpha
///     pictures                role, name, origin (pairs of texts), pixels: float32, little endian, in base64; null: those
///                             of the first
///     flip                    likewise, of the map; absent where it is 0
///     colours                 of errors from 0 to 1: 256 of R, G, B in base64
///     ulps                    [least, most, count] of values by their distance, over all compared pixels
[[nodiscard]] nlohmann::ordered_json comparisonPageToJson(const ComparisonPage &page);
[[nodiscard]] std::string comparisonHtml(const ComparisonPage &page);

} // namespace hyalite::core
