// The edge that two triangles have in common.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <optional>

namespace hyalite::core {

using Corners = std::array<glm::vec3, 3>;

/// Edge k of a triangle runs from its corner k to the next one.
struct CommonEdge {
    std::uint32_t ofFirst;
    std::uint32_t ofSecond;
    bool isOpposite; ///< it runs the other way in the second triangle, as where a surface goes on
};

/// The first edge of `a`, and of `b`, with the same ends to the bit, or nothing.
[[nodiscard]] inline std::optional<CommonEdge> commonEdge(const Corners &a, const Corners &b) {
    using Bits = std::array<std::uint32_t, 3>;
    const auto isSame = [](const glm::vec3 &p, const glm::vec3 &q) {
        return std::bit_cast<Bits>(p) == std::bit_cast<Bits>(q);
    };
    for (std::uint32_t i = 0; i < 3; ++i)
        for (std::uint32_t j = 0; j < 3; ++j) {
            const glm::vec3 &begin = a[i];
            const glm::vec3 &end = a[(i + 1) % 3];
            if (isSame(b[j], end) && isSame(b[(j + 1) % 3], begin))
                return CommonEdge{i, j, true};
            if (isSame(b[j], begin) && isSame(b[(j + 1) % 3], end))
                return CommonEdge{i, j, false};
        }
    return std::nullopt;
}

} // namespace hyalite::core
