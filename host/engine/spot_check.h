// Spot check of renderers that share a picture: a few of its tiles are compared, as renderers with different bits make
// seams.
#pragma once

#include "host/engine/backend.h"

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace hyalite::core {

/// Tiles of 8x8 pixels in the middle of the crop, where most pictures have their subject, and around it: up to 4, fewer
/// in small crops, cut at the edges.
[[nodiscard]] std::vector<Crop> spotsIn(const Crop &crop);

/// A check for one picture. The judge is the CPU, on one thread. It renders each tile once, however many ask.
class SpotCheck {
  public:
    static constexpr std::uint32_t maxSamples = 2; ///< of each pixel, the last ones

    /// All but `crop` must outlive it.
    SpotCheck(const PackedScene &scene, const RenderSettings &settings, const Crop &crop,
              const std::function<bool()> &shouldStop);

    /// Compares all bits of the backend's films with the CPU's. Each thread may check a backend of its own. Throws
    /// Error{DeviceLost}, with backend, pixel and both values, at the first difference, and the failure of a backend
    /// that fails. Adds Vulkan calls that failed, and after which it went on, to `faults`. Returns false if it was
    /// stopped.
    ///
    /// A backend with another precision() than the CPU has bits of its own, and is not compared; nor is the CPU.
    [[nodiscard]] bool run(Backend &backend, std::vector<std::string> &faults);

  private:
    [[nodiscard]] BackendResult render(Backend &backend, const Crop &spot) const;
    [[nodiscard]] Film rightFilm(std::size_t spot);
    [[nodiscard]] bool isWhole(const Film &film) const;

    const PackedScene &scene_;
    const RenderSettings &settings_;
    const std::function<bool()> &shouldStop_;
    const std::uint32_t samplesPerPixel_;
    const std::uint32_t checkedSamples_;
    const std::vector<Crop> spots_;
    const std::unique_ptr<Backend> cpu_;
    std::mutex mutex_; ///< of what follows, and of the CPU
    std::vector<Film> rightFilms_;
};

} // namespace hyalite::core
