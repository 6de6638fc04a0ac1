// Texture: an image for surfaces, with the values of its file: 8-bit levels, or linear floats.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hyalite::core {

/// Rows from the top. The use decides the meaning of levels: colours are sRGB, other values are level / 255.
struct Texture {
    std::string name; ///< of the file, for messages
    int width = 0;    ///< pixels, from 1 to imageSideMax
    int height = 0;
    std::vector<std::uint32_t> levels{}; ///< red, green, blue and alpha from the lowest byte up; or none
    std::vector<glm::vec3> values{};     ///< instead of levels: finite, >= 0
    bool hasAlpha = false;               ///< else alpha is 255

    [[nodiscard]] bool isFloat() const { return levels.empty(); }
    [[nodiscard]] std::size_t pixelCount() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};

/// Its size in device memory: 4 bytes a pixel, or 16 for floats.
[[nodiscard]] inline std::size_t bytesOnDevice(const Texture &texture) {
    return texture.pixelCount() * (texture.isFloat() ? 16 : 4);
}

} // namespace hyalite::core
