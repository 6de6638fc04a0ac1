// The layout of a film on a device: all of its pixels, or only those that want samples. Parts, films that others have
// begun, and rounds of adaptive renders leave most pixels alone: gathered, the others keep all slots busy.
#pragma once

#include "host/film/film.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace hyalite::core::gpu {

class FilmLayout {
  public:
    FilmLayout() = default; ///< without pixels

    /// Of the pixels of `crop`, row by row, at the beginning of a render up to `sampleEnd` samples. Without pixels in
    /// `film`, all want samples.
    FilmLayout(const Crop &crop, std::span<const layout::FilmPixel> film, std::uint32_t sampleEnd);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    [[nodiscard]] std::size_t pixelCount() const { return std::size_t{width_} * height_; }
    [[nodiscard]] bool isGathered() const { return !places_.empty(); }

    /// Of a gathered film, where each pixel on the device is in the image, as layout.h has it.
    [[nodiscard]] std::vector<std::uint32_t> positions() const;

    /// Copies `size` values for each pixel between the film and the device's layout, where both differ.
    template <class Value>
    void gather(std::span<const Value> film, std::size_t size, std::span<Value> device) const {
        for (std::size_t i = 0; i < places_.size(); ++i)
            if (places_[i] != noPlace)
                std::ranges::copy(film.subspan(places_[i] * size, size), device.subspan(i * size).begin());
    }
    template <class Value>
    void scatter(std::span<const Value> device, std::size_t size, std::span<Value> film) const {
        for (std::size_t i = 0; i < places_.size(); ++i)
            if (places_[i] != noPlace)
                std::ranges::copy(device.subspan(i * size, size), film.subspan(places_[i] * size).begin());
    }

  private:
    static constexpr std::size_t noPlace = std::numeric_limits<std::size_t>::max();

    Crop crop_{};
    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    std::vector<std::size_t> places_; ///< in the film, of each pixel on the device; empty: both are alike
};

} // namespace hyalite::core::gpu
