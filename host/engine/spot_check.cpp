#include "host/engine/spot_check.h"

#include "host/base/error.h"
#include "host/engine/cpu_backend.h"

#include <fmt/format.h>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace hyalite::core {

namespace {

constexpr int spotSide = 8;

/// In shares of width and height.
constexpr std::array<glm::dvec2, 4> spotPlaces{{{0.5, 0.5}, {0.5, 0.8}, {0.24, 0.35}, {0.76, 0.35}}};

struct Sum {
    const char *name;
    glm::vec3 (*of)(const layout::FilmPixel &pixel);
};

constexpr std::array<Sum, 5> sums{
    {{"sum", [](const layout::FilmPixel &pixel) { return pixel.sum; }},
     {"rest of the sum", [](const layout::FilmPixel &pixel) { return pixel.sumRest; }},
     {"sum of squares", [](const layout::FilmPixel &pixel) { return pixel.sumOfSquares; }},
     {"rest of the sum of squares", [](const layout::FilmPixel &pixel) { return pixel.squaresRest; }},
     {"transparency, with its rest,", [](const layout::FilmPixel &pixel) {
          return glm::vec3(pixel.transparency, pixel.transparencyRest, 0.0f);
      }}}};

void requireEqualBits(const std::string &name, const Film &film, const std::string &judge, const Film &right,
                      std::uint32_t samples) {
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        if (haveEqualBits(film, right, i))
            continue;
        using Bits = std::array<std::uint32_t, 3>;
        const auto sum = std::ranges::find_if(sums, [&](const Sum &each) {
            return std::bit_cast<Bits>(each.of(film.pixels[i])) !=
                   std::bit_cast<Bits>(each.of(right.pixels[i]));
        });
        const Sum &differing = sum != sums.end() ? *sum : sums.front();
        const glm::vec3 a = differing.of(film.pixels[i]);
        const glm::vec3 b = differing.of(right.pixels[i]);
        const int index = static_cast<int>(i);
        throw Error(ErrorKind::DeviceLost,
                    fmt::format("{} and {} disagree: at pixel ({}, {}) the {} of {} samples is "
                                "({:.9g} {:.9g} {:.9g}) and ({:.9g} {:.9g} {:.9g})",
                                name, judge, film.crop.x0 + index % film.crop.width(),
                                film.crop.y0 + index / film.crop.width(), differing.name, samples, a.x, a.y,
                                a.z, b.x, b.y, b.z),
                    Remedy::OneDevice);
    }
}

} // namespace

std::vector<Crop> spotsIn(const Crop &crop) {
    std::vector<Crop> spots;
    const auto blockAt = [](int pixels, double share) {
        return static_cast<int>(share * pixels) / spotSide * spotSide;
    };
    for (const glm::dvec2 &place : spotPlaces) {
        const int x = crop.x0 + blockAt(crop.width(), place.x);
        const int y = crop.y0 + blockAt(crop.height(), place.y);
        const Crop spot{x, std::min(x + spotSide, crop.x1), y, std::min(y + spotSide, crop.y1)};
        if (std::ranges::find(spots, spot) == spots.end())
            spots.push_back(spot);
    }
    return spots;
}

SpotCheck::SpotCheck(const PackedScene &scene, const RenderSettings &settings, const Crop &crop,
                     const std::function<bool()> &shouldStop)
    : scene_(scene), settings_(settings), shouldStop_(shouldStop),
      samplesPerPixel_(static_cast<std::uint32_t>(settings.samplesPerPixel)),
      checkedSamples_(std::min(samplesPerPixel_, maxSamples)), spots_(spotsIn(crop)),
      cpu_(makeCpuBackend(reference::Precision::Float32, 1)) {}

bool SpotCheck::run(Backend &backend, std::vector<std::string> &faults) {
    if (backend.precision() != cpu_->precision() || backend.name() == cpu_->name())
        return true;
    for (std::size_t i = 0; i < spots_.size(); ++i) {
        BackendResult result = render(backend, spots_[i]);
        if (result.failure && !result.faults.empty())
            result.faults.pop_back(); // after which it was not opened again
        for (const std::string &fault : result.faults)
            faults.push_back(backend.name() + ": " + fault);
        if (result.failure)
            throw Error(*result.failure);
        const Film right = rightFilm(i);
        if (!isWhole(result.film) || !isWhole(right))
            return false;
        requireEqualBits(backend.name(), result.film, cpu_->name(), right, checkedSamples_);
    }
    return true;
}

BackendResult SpotCheck::render(Backend &backend, const Crop &spot) const {
    // All but the last samples count as finished. The sample count stays, and with it the picture's kernel.
    Film begun(spot);
    for (layout::FilmPixel &pixel : begun.pixels)
        pixel.sampleCount = samplesPerPixel_ - checkedSamples_;
    return backend.render(scene_, settings_, std::move(begun), {.shouldStop = shouldStop_});
}

Film SpotCheck::rightFilm(std::size_t spot) {
    const std::scoped_lock lock(mutex_);
    if (rightFilms_.size() == spot) // everyone begins with the first spot
        rightFilms_.push_back(render(*cpu_, spots_[spot]).film);
    return rightFilms_[spot];
}

bool SpotCheck::isWhole(const Film &film) const {
    return std::ranges::all_of(film.pixels, [this](const layout::FilmPixel &pixel) {
        return pixel.sampleCount == samplesPerPixel_;
    });
}

} // namespace hyalite::core
