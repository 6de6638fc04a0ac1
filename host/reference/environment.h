// An image around the scene, and how it is aimed at. Twin: shaders/lights/environment.glsl.
//
// The image is a map of directions by longitude and latitude: its middle is -z, its top row is around +y. Between the
// middles of its pixels radiance is interpolated. A pixel is chosen by integers, the row first; the weights are what
// the interpolated image sends through the pixel's area (host/packing/environment.cpp), so that nothing that shines is left
// out.
#pragma once

#include "host/packing/packed_scene.h"
#include "host/reference/functions.h"

#include <algorithm>

namespace hyalite::reference {

template <class Real> struct EnvironmentLight {
    Vec3<Real> direction;
    Vec3<Real> radiance;
    Real density; ///< of the direction, per solid angle; 0: it cannot be chosen
};

/// Of a packed scene with layout::lightsByEnvironment.
template <class Real> class EnvironmentMap {
  public:
    explicit EnvironmentMap(const PackedScene &scene) : frame_(scene.frame), texels_(scene.texels) {}

    /// What comes from a direction, and how densely that is chosen.
    [[nodiscard]] EnvironmentLight<Real> from(const Vec3<Real> &direction) const {
        const Vec2<Real> place = placeOf(direction);
        const Vec2<Real> position = place * Vec2<Real>(static_cast<Real>(frame_.environmentWidth),
                                                       static_cast<Real>(frame_.environmentHeight));
        const auto x = std::min(static_cast<std::uint32_t>(position.x), frame_.environmentWidth - 1);
        const auto y = std::min(static_cast<std::uint32_t>(position.y), frame_.environmentHeight - 1);
        const Real sine = std::sqrt(direction.x * direction.x + direction.z * direction.z);
        return {direction, radianceAt(place), density(x, y, sine)};
    }

    /// What comes from a direction.
    [[nodiscard]] Vec3<Real> radianceFrom(const Vec3<Real> &direction) const {
        return radianceAt(placeOf(direction));
    }

    /// A direction chosen by two numbers of 32 bits.
    [[nodiscard]] EnvironmentLight<Real> sample(const glm::uvec2 &random) const {
        // The last number counts for what ends the row or the column.
        const glm::uvec2 bits(std::min(random.x, 0xFFFFFFFEu), std::min(random.y, 0xFFFFFFFEu));
        const std::uint32_t texelCount = frame_.environmentWidth * frame_.environmentHeight;
        const std::uint32_t y =
            search(frame_.environmentTexels + texelCount, frame_.environmentHeight, bits.y);
        const std::uint32_t x =
            search(frame_.environmentTexels + y * frame_.environmentWidth, frame_.environmentWidth, bits.x);
        const Real down = shareOf(bits.y, y == 0 ? 0 : row(y - 1).word, row(y).word);
        const Real across = shareOf(bits.x, x == 0 ? 0 : texel(x - 1, y).word, texel(x, y).word);
        const Vec2<Real> place((static_cast<Real>(x) + across) / static_cast<Real>(frame_.environmentWidth),
                               (static_cast<Real>(y) + down) / static_cast<Real>(frame_.environmentHeight));
        const Real turned = place.x - static_cast<Real>(frame_.environmentTurns);
        const SineCosine<Real> longitude = sineCosine(turned < 0 ? turned + Real(1) : turned);
        const SineCosine<Real> latitude = sineCosine(Real(0.5) * place.y);
        const Vec3<Real> direction(-longitude.sine * latitude.sine, latitude.cosine,
                                   longitude.cosine * latitude.sine);
        return {direction, radianceAt(place), density(x, y, latitude.sine)};
    }

    /// Place in the image of a direction: x and y from the left and the top, in [0, 1].
    [[nodiscard]] Vec2<Real> placeOf(const Vec3<Real> &direction) const {
        const Real squared = direction.x * direction.x + direction.z * direction.z;
        const Real longitude = squared > 0 ? turnsOf(-direction.x, direction.z) : Real(0);
        const Real turned = longitude + static_cast<Real>(frame_.environmentTurns);
        const Real latitude = Real(2) * turnsOf(std::sqrt(squared), direction.y);
        return {turned >= 1 ? turned - Real(1) : turned, lesser(latitude, Real(1))};
    }

  private:
    [[nodiscard]] const layout::TexelRecord &texel(std::uint32_t x, std::uint32_t y) const {
        return texels_[frame_.environmentTexels + y * frame_.environmentWidth + x];
    }

    [[nodiscard]] const layout::TexelRecord &row(std::uint32_t y) const {
        return texels_[frame_.environmentTexels + frame_.environmentHeight * frame_.environmentWidth + y];
    }

    [[nodiscard]] static Vec3<Real> mixtureOf(const layout::TexelRecord &a, const layout::TexelRecord &b,
                                              Real share) {
        return reference::mixtureOf(Vec3<Real>(a.value), Vec3<Real>(b.value), share);
    }

    [[nodiscard]] Vec3<Real> radianceAt(const Vec2<Real> &place) const {
        const Real x = place.x * static_cast<Real>(frame_.environmentWidth) + Real(0.5);
        const Real y = place.y * static_cast<Real>(frame_.environmentHeight) + Real(0.5);
        auto right = static_cast<std::uint32_t>(x);
        auto lower = static_cast<std::uint32_t>(y);
        const Real across = x - static_cast<Real>(right);
        const Real down = y - static_cast<Real>(lower);
        const std::uint32_t left = right == 0 ? frame_.environmentWidth - 1 : right - 1;
        right = right >= frame_.environmentWidth ? right - frame_.environmentWidth : right;
        const std::uint32_t upper = lower == 0 ? 0 : lower - 1;
        lower = std::min(lower, frame_.environmentHeight - 1);
        return reference::mixtureOf(mixtureOf(texel(left, upper), texel(right, upper), across),
                                    mixtureOf(texel(left, lower), texel(right, lower), across), down);
    }

    /// The density, per solid angle, with which a direction is chosen that lies `sine` off the vertical, in the given
    /// pixel.
    [[nodiscard]] Real density(std::uint32_t x, std::uint32_t y, Real sine) const {
        if (sine <= 0)
            return 0;
        const std::uint32_t before = x == 0 ? 0 : texel(x - 1, y).word;
        const std::uint32_t numbers = texel(x, y).word - before;
        const Real inRow = static_cast<Real>(numbers) * Real(1.0 / 4294967296.0);
        const Real chance = inRow * static_cast<Real>(row(y).value.x);
        const Real scaled = chance * (static_cast<Real>(frame_.environmentWidth) *
                                      static_cast<Real>(frame_.environmentHeight));
        return scaled / (Real(19.739208802178716) * sine); // 2 pi^2
    }

    /// The first of `count` texels, from `first` on, whose `word` is more than `bits`; the last one if none is.
    [[nodiscard]] std::uint32_t search(std::uint32_t first, std::uint32_t count, std::uint32_t bits) const {
        const auto begin = texels_.begin() + first;
        const auto found = std::partition_point(
            begin, begin + count - 1, [&](const layout::TexelRecord &one) { return one.word <= bits; });
        return static_cast<std::uint32_t>(found - begin);
    }

    /// Where in a pixel a number lies that chose it, in [0, 1].
    [[nodiscard]] static Real shareOf(std::uint32_t bits, std::uint32_t before, std::uint32_t end) {
        return static_cast<Real>(bits - before) / static_cast<Real>(end - before);
    }

    const layout::FrameRecord &frame_;
    const std::vector<layout::TexelRecord> &texels_;
};

} // namespace hyalite::reference
