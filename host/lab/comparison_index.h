// Index of several comparisons, as an HTML page with a thumbnail of each. It needs no network.
#pragma once

#include "host/image/error_map.h"
#include "host/image/image.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

struct IndexedComparison {
    std::string title; ///< the scene
    std::string verdict;
    bool isPassed = false;
    std::string page{};               ///< name of the file with its page, beside the index; empty: none
    std::vector<std::byte> picture{}; ///< thumbnail(), or nothing
    std::vector<std::byte> errors{};
};

/// PNGs, at most 320 pixels wide and high: of means of linear radiance, tone-mapped, and of the largest errors.
[[nodiscard]] std::vector<std::byte> thumbnail(const Image &image);
[[nodiscard]] std::vector<std::byte> thumbnail(const ErrorMap &errors);

/// Those that are not passed come first.
[[nodiscard]] std::string comparisonIndexHtml(std::span<const IndexedComparison> comparisons);

} // namespace hyalite::core
