// A linear float RGB image.
#pragma once

#include <glm/vec3.hpp>

#include <cassert>
#include <cstddef>
#include <vector>

namespace hyalite::core {

/// Linear radiance, row by row from the top left.
class Image {
  public:
    Image() = default;
    Image(int width, int height)
        : width_(width), height_(height),
          pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), glm::vec3(0.0f)) {
        assert(width >= 0 && height >= 0);
    }

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] std::vector<glm::vec3> &pixels() { return pixels_; }
    [[nodiscard]] const std::vector<glm::vec3> &pixels() const { return pixels_; }

    [[nodiscard]] glm::vec3 &at(int x, int y) { return pixels_[index(x, y)]; }
    [[nodiscard]] const glm::vec3 &at(int x, int y) const { return pixels_[index(x, y)]; }

  private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        assert(x >= 0 && x < width_ && y >= 0 && y < height_);
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    int width_ = 0;
    int height_ = 0;
    std::vector<glm::vec3> pixels_;
};

} // namespace hyalite::core
