// A small picture with gradients, hard edges and, on request, noise, made from integers alone: other programs can make
// the same one, so that their results can stand in the tests.
#pragma once

#include "host/image/image.h"

#include <algorithm>
#include <cstdint>

namespace hyalite {

inline std::uint32_t hashOf(std::uint32_t x, std::uint32_t y, std::uint32_t channel, std::uint32_t seed) {
    std::uint32_t hash = 0x9e3779b9u;
    for (const std::uint32_t word : {x, y, channel, seed}) {
        hash = (hash ^ word) * 0x85ebca6bu;
        hash ^= hash >> 13;
        hash *= 0xc2b2ae35u;
        hash ^= hash >> 16;
    }
    return hash;
}

/// The 8-bit level of a channel. Seed 0: clean. Others: noise of +-20 on the left two thirds; 2: a red patch besides.
inline int syntheticLevel(int x, int y, int channel, int width, int height, std::uint32_t seed) {
    int level = (x * (5 + channel) + y * (3 + 2 * channel)) % 256;
    if ((x / 16 + y / 12) % 3 == channel) {
        level = 255 - level;
    }
    const int dx = x - width / 2;
    const int dy = y - height / 2;
    if (dx * dx + dy * dy < 100) {
        level = 40 + 60 * channel;
    }
    if (seed == 0) {
        return level;
    }
    if (seed == 2 && x >= 10 && x < 20 && y >= 10 && y < 14) {
        return channel == 0 ? 255 : 0;
    }
    const std::uint32_t hash = hashOf(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                      static_cast<std::uint32_t>(channel), seed);
    return x < 2 * width / 3 ? std::clamp(level + static_cast<int>(hash % 41) - 20, 0, 255) : level;
}

template <typename ToFloat>
Image syntheticPicture(int width, int height, std::uint32_t seed, ToFloat toFloat) {
    Image image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int channel = 0; channel < 3; ++channel) {
                image.at(x, y)[channel] = toFloat(syntheticLevel(x, y, channel, width, height, seed));
            }
        }
    }
    return image;
}

/// Levels / 255.
inline Image displayPicture(int width, int height, std::uint32_t seed) {
    return syntheticPicture(width, height, seed,
                            [](int level) { return static_cast<float>(level) / 255.0f; });
}

/// (level / 64)^4 / 8: linear values from 0 to 31.5.
inline Image linearPicture(int width, int height, std::uint32_t seed) {
    return syntheticPicture(width, height, seed, [](int level) {
        const double quarter = level / 64.0;
        return static_cast<float>(quarter * quarter * quarter * quarter / 8.0);
    });
}

inline Image constantPicture(int width, int height, const glm::vec3 &colour) {
    Image image(width, height);
    std::fill(image.pixels().begin(), image.pixels().end(), colour);
    return image;
}

} // namespace hyalite
