#include "assets/still-life/noise.h"

namespace still_life {

namespace {

/// Of a point of the grid, in [0, 1].
double cornerValue(const std::array<int, 3> &corner) {
    std::uint32_t hash = 0x9E3779B9u;
    for (const int x : corner) {
        hash ^= static_cast<std::uint32_t>(x) * 0x85EBCA6Bu;
        hash = (hash ^ (hash >> 15)) * 0x2C1B3C6Du;
        hash = (hash ^ (hash >> 12)) * 0x297A2D39u;
        hash ^= hash >> 15;
    }
    return hash / 4294967295.0;
}

} // namespace

double noise(const Vec &at, const std::array<int, 3> &period) {
    std::array<int, 3> low{};
    Vec share{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double floor = std::floor(at[i]);
        low[i] = static_cast<int>(floor);
        share[i] = smoothStep(0.0, 1.0, at[i] - floor);
    }
    double sum = 0.0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        std::array<int, 3> place = low;
        double weight = 1.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const bool isUpper = (corner >> i & 1u) != 0;
            place[i] += isUpper ? 1 : 0;
            weight *= isUpper ? share[i] : 1.0 - share[i];
            if (period[i] > 0)
                place[i] = (place[i] % period[i] + period[i]) % period[i];
        }
        sum += weight * cornerValue(place);
    }
    return sum;
}

double layeredNoise(const Vec &at, int octaves, const std::array<int, 3> &period) {
    double sum = 0.0;
    double total = 0.0;
    for (int octave = 0; octave < octaves; ++octave) {
        const int fineness = 1 << octave;
        sum +=
            noise(scale(at, fineness), {period[0] * fineness, period[1] * fineness, period[2] * fineness}) /
            fineness;
        total += 1.0 / fineness;
    }
    return sum / total;
}

} // namespace still_life
