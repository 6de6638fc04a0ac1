// FLIP's colour space conversions for one colour, with the paper's constants.
//
//   linear RGB (sRGB primaries)  <->  XYZ relative to the white point D65
//       -> opponent (linear: what the eye's filters work on)
//       -> CIELab with the Hunt adjustment (about uniform: what colours are compared in)
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace hyalite::core {

/// 0 for NaN.
inline float clampToUnit(float value) { return value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f; }

/// IEC 61966-2-1. `encoded` is in [0, 1].
inline float linearFromSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

inline constexpr glm::vec3 whitePointD65 = {0.950428545f, 1.0f, 1.088900371f};

/// XYZ, each divided by that of the white point: white is (1, 1, 1).
inline glm::vec3 relativeXyzFromLinear(const glm::vec3 &rgb) {
    const glm::vec3 xyz = {
        glm::dot(rgb, glm::vec3(10135552.0f, 8788810.0f, 4435075.0f) / 24577794.0f),
        glm::dot(rgb, glm::vec3(2613072.0f, 8788810.0f, 887015.0f) / 12288897.0f),
        glm::dot(rgb, glm::vec3(1425312.0f, 8788810.0f, 70074185.0f) / 73733382.0f),
    };
    return xyz / whitePointD65;
}

inline glm::vec3 linearFromRelativeXyz(const glm::vec3 &relative) {
    const glm::vec3 xyz = relative * whitePointD65;
    return {
        glm::dot(xyz, glm::vec3(3.241003275f, -1.537398934f, -0.498615861f)),
        glm::dot(xyz, glm::vec3(-0.969224334f, 1.875930071f, 0.041554224f)),
        glm::dot(xyz, glm::vec3(0.055639423f, -0.204011202f, 1.057148933f)),
    };
}

/// The publication's YCxCz without its scales and offset, (Y + 16) / 116, Cx / 500 and Cz / 200: the filters have
/// unit sums, so both are filtered alike, and the feature detectors want the achromatic channel in this form.
inline glm::vec3 opponentFromLinear(const glm::vec3 &rgb) {
    const glm::vec3 xyz = relativeXyzFromLinear(rgb);
    return {xyz.y, xyz.x - xyz.y, xyz.y - xyz.z};
}

inline glm::vec3 linearFromOpponent(const glm::vec3 &opponent) {
    return linearFromRelativeXyz({opponent.x + opponent.y, opponent.x, opponent.x - opponent.z});
}

/// CIELab, whose a and b are multiplied by 0.01 L: colours look duller in the dark (Hunt 1952).
inline glm::vec3 huntLabFromLinear(const glm::vec3 &rgb) {
    constexpr float delta = 6.0f / 29.0f;
    const auto compress = [](float t) {
        return t > delta * delta * delta ? std::cbrt(t) : t / (3.0f * delta * delta) + 4.0f / 29.0f;
    };
    const glm::vec3 xyz = relativeXyzFromLinear(rgb);
    const float x = compress(xyz.x);
    const float y = compress(xyz.y);
    const float z = compress(xyz.z);
    const float lightness = 116.0f * y - 16.0f;
    return {lightness, 0.01f * lightness * 500.0f * (x - y), 0.01f * lightness * 200.0f * (y - z)};
}

/// HyAB: city-block in lightness, Euclidean in chroma (Abasi, Tehran, Fairchild 2020).
inline float hyabDistance(const glm::vec3 &a, const glm::vec3 &b) {
    const glm::vec3 difference = a - b;
    return std::abs(difference.x) + std::sqrt(difference.y * difference.y + difference.z * difference.z);
}

} // namespace hyalite::core
