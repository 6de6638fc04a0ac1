#include "assets/still-life/images.h"

#include "assets/still-life/noise.h"

namespace still_life {

namespace {

constexpr int side = 512; // pixels

// ---- Wood

constexpr int plankCount = 4;

struct Plank {
    double index;
    double across; ///< in [0, 1]
    double gap;    ///< 1 in the groove between two
    double grain;  ///< in [0, 1]
    double pores;  ///< 1 in fine dark strokes
};

/// Planks run along u; each has its own piece of grain, and the joints of neighbours are far from each other.
Plank plankAt(double u, double v) {
    const double scaled = v * plankCount;
    Plank plank{};
    plank.index = std::floor(scaled);
    plank.across = scaled - plank.index;
    const double joint = std::fmod(u + 0.37 * plank.index + 0.13, 1.0);
    const double edge =
        std::fmin(std::fmin(plank.across, 1.0 - plank.across) / plankCount, std::fmin(joint, 1.0 - joint));
    plank.gap = 1.0 - smoothStep(0.0015, 0.005, edge);
    const double piece = 7.0 * plank.index;
    const double bent = plank.across + 0.5 * layeredNoise({u * 3.0, plank.across * 1.5, piece}, 3, {3, 0, 0});
    const double rings = 0.5 + 0.5 * std::sin(2.0 * pi * (bent * 5.0));
    plank.grain = 0.6 * rings + 0.4 * layeredNoise({u * 6.0, plank.across * 40.0, piece + 3.0}, 3, {6, 0, 0});
    plank.pores =
        smoothStep(0.62, 0.8, layeredNoise({u * 24.0, plank.across * 110.0, piece + 5.0}, 2, {24, 0, 0}));
    return plank;
}

} // namespace

Picture woodColour() {
    return draw(side, side, [](double u, double v) {
        const Plank plank = plankAt(u, v);
        const double tone = noise({0.0, 3.1 * plank.index, 1.0});
        const Vec light = mix({0.76, 0.53, 0.33}, {0.67, 0.43, 0.26}, tone);
        const Vec dark = mix({0.53, 0.31, 0.17}, {0.45, 0.25, 0.14}, tone);
        Vec colour = mix(light, dark, plank.grain);
        colour = mix(colour, {0.33, 0.18, 0.1}, 0.45 * plank.pores);
        return Pixel{mix(colour, {0.1, 0.05, 0.03}, plank.gap)};
    });
}

Picture woodRoughness() {
    return draw(side, side, [](double u, double v) {
        const Plank plank = plankAt(u, v);
        const double rough = 0.34 + 0.12 * plank.grain + 0.2 * plank.pores + 0.4 * plank.gap;
        return Pixel{{rough, rough, rough}};
    });
}

Picture woodNormals() {
    return drawNormals(side, side, [](double u, double v) {
        const Plank plank = plankAt(u, v);
        return -0.0018 * plank.gap - 0.0002 * plank.grain - 0.0003 * plank.pores;
    });
}

// ---- The globe

namespace {

struct Ground {
    double height; ///< above the sea, in [-1, 1], nearly
    double cold;   ///< 1 where ice is
    double line;   ///< 1 on meridians and parallels, every 15 degrees
};

Ground groundAt(double u, double v) {
    const double longitude = 2.0 * pi * u;
    const double latitude = pi * (v - 0.5);
    const Vec point{std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                    std::cos(latitude) * std::cos(longitude)};
    const Vec moved = add(scale(point, 1.7), {4.3, 2.1, 7.7});
    const Vec warped =
        add(moved, scale({noise(add(scale(moved, 2.0), {9, 0, 0})), noise(add(scale(moved, 2.0), {0, 9, 0})),
                          noise(add(scale(moved, 2.0), {0, 0, 9}))},
                         0.45));
    Ground ground{};
    ground.height = 3.2 * (layeredNoise(warped, 6) - 0.52);
    ground.cold = smoothStep(1.16, 1.24, std::abs(latitude) + 0.25 * (noise(scale(moved, 6.0)) - 0.5));
    const auto fromLine = [](double turns, double count) {
        const double scaled = turns * count;
        return std::abs(scaled - std::round(scaled)) / count;
    };
    const double east = fromLine(u, 24.0) * 2.0 * std::cos(latitude); // as far as on a parallel as long as 2
    const double north = fromLine(v, 12.0);
    ground.line = 1.0 - smoothStep(0.0012, 0.0024, std::fmin(east, north));
    return ground;
}

} // namespace

Picture globeColour() {
    return draw(2 * side, side, [](double u, double v) {
        const Ground ground = groundAt(u, v);
        const Vec sea = mix({0.10, 0.30, 0.42}, {0.42, 0.66, 0.68}, smoothStep(-0.75, 0.0, ground.height));
        const Vec low = mix({0.42, 0.55, 0.28}, {0.80, 0.70, 0.42}, smoothStep(0.02, 0.35, ground.height));
        const Vec land = mix(low, {0.55, 0.36, 0.24}, smoothStep(0.3, 0.8, ground.height));
        const double shore = smoothStep(-0.012, 0.012, ground.height);
        Vec colour = mix(sea, land, shore);
        colour = mix(colour, {0.24, 0.2, 0.16}, 0.7 * (1.0 - smoothStep(0.0, 0.02, std::abs(ground.height))));
        colour = mix(colour, {0.93, 0.94, 0.92}, ground.cold);
        return Pixel{mix(colour, {0.25, 0.22, 0.18}, 0.4 * ground.line)};
    });
}

Picture globeRoughness() {
    return draw(2 * side, side, [](double u, double v) {
        const Ground ground = groundAt(u, v);
        const double dry = std::fmax(smoothStep(-0.02, 0.05, ground.height), ground.cold);
        const double rough = 0.16 + 0.44 * dry;
        return Pixel{{rough, rough, rough}};
    });
}

// ---- The lantern

namespace {

struct Blossom {
    double u, v, size;
};

constexpr Blossom blossoms[] = {{0.10, 0.62, 0.075}, {0.22, 0.47, 0.055}, {0.33, 0.66, 0.065},
                                {0.47, 0.52, 0.08},  {0.60, 0.68, 0.05},  {0.70, 0.44, 0.06},
                                {0.83, 0.60, 0.075}, {0.93, 0.42, 0.05}};

double branchHeight(double u) {
    return 0.5 + 0.09 * std::sin(2.0 * pi * u) + 0.04 * std::sin(6.0 * pi * u + 1.0);
}

/// How much of a blossom of five petals covers a point, and how near its middle that is.
struct Petals {
    double cover;
    double heart;
};

Petals petalsAt(const Blossom &blossom, double u, double v) {
    const double across = std::remainder(u - blossom.u, 1.0) * 2.0; // the picture is twice as wide as high
    const double up = v - blossom.v;
    const double distance = std::sqrt(across * across + up * up) / blossom.size;
    const double angle = std::atan2(up, across) + 3.0 * blossom.u;
    const double rim = 0.72 + 0.28 * std::abs(std::cos(2.5 * angle));
    return {1.0 - smoothStep(rim - 0.06, rim, distance), 1.0 - smoothStep(0.1, 0.3, distance)};
}

} // namespace

Picture lanternLight() {
    return draw(2 * side, side, [](double u, double v) {
        const double middle =
            1.0 - 0.45 * std::pow(std::abs(2.0 * v - 1.0), 2.0); // brightest around the candle
        const double fibres = 0.9 + 0.2 * (layeredNoise({u * 40.0, v * 20.0, 0.0}, 3, {40, 0, 0}) - 0.5);
        Vec colour = scale({1.0, 0.62, 0.27}, middle * fibres);
        const double branch =
            1.0 - smoothStep(0.008, 0.013,
                             std::abs(v - branchHeight(u)) + 0.006 * noise({u * 60.0, 0.0, 2.0}, {60, 0, 0}));
        colour = mix(colour, {0.20, 0.09, 0.05}, branch);
        for (const Blossom &blossom : blossoms) {
            const Petals petals = petalsAt(blossom, u, v);
            colour = mix(colour, scale({0.72, 0.07, 0.06}, 0.6 + 0.4 * middle), petals.cover);
            colour = mix(colour, {1.0, 0.85, 0.35}, petals.heart);
        }
        const double rib = std::abs(std::remainder(v * 9.0, 1.0)) / 9.0;
        return Pixel{scale(colour, 1.0 - 0.55 * (1.0 - smoothStep(0.002, 0.005, rib)))};
    });
}

// ---- The pot

namespace {

/// 1 on the zigzag and its lines, painted around the pot.
double paintAt(double u, double v) {
    const double wave = 0.66 + 0.055 * (4.0 * std::abs(std::remainder(u * 16.0, 1.0)) - 1.0);
    const double line = std::fmin(std::fmin(std::abs(v - 0.55), std::abs(v - 0.77)), std::abs(v - wave));
    return 1.0 - smoothStep(0.011, 0.016, line);
}

} // namespace

Picture potColour() {
    return draw(side, side, [](double u, double v) {
        const double mottle = layeredNoise({u * 12.0, v * 6.0, 11.0}, 4, {12, 0, 0});
        Vec colour = mix({0.72, 0.40, 0.27}, {0.80, 0.52, 0.37}, mottle);
        const double lime = smoothStep(0.6, 0.75, layeredNoise({u * 9.0, v * 5.0, 21.0}, 4, {9, 0, 0}));
        colour = mix(colour, {0.85, 0.72, 0.62}, 0.5 * lime * (1.0 - v));
        return Pixel{mix(colour, {0.93, 0.88, 0.76}, 0.9 * paintAt(u, v))};
    });
}

Picture potNormals() {
    return drawNormals(side, side, [](double u, double v) {
        const double rings =
            std::sin(2.0 * pi * (v * 22.0 + 0.4 * noise({u * 4.0, v * 3.0, 0.0}, {4, 3, 0})));
        return 0.0011 * rings + 0.004 * layeredNoise({u * 24.0, v * 24.0, 3.0}, 3, {24, 24, 0}) / 4.0;
    });
}

// ---- The leaf

Picture leaf() {
    constexpr int width = side / 2;
    return draw(width, 2 * width, [](double u, double v) {
        const double across = 2.0 * u - 1.0;
        const double half = 0.93 * std::pow(std::sin(pi * std::pow(clamp01(v), 0.8)), 0.8) * (1.0 - 0.25 * v);
        const double serration = 0.03 * std::abs(std::remainder(v * 22.0 - 0.5 * std::abs(across), 1.0));
        const double stem = std::abs(across) < 0.035 && v < 0.3 ? 1.0 : 0.0;
        const double inside = std::abs(across) < half - serration ? 1.0 : 0.0;
        const double rib = 1.0 - smoothStep(0.012, 0.04, std::abs(across));
        const double vein =
            1.0 - smoothStep(0.0, 0.16, std::abs(std::remainder((v - 0.32 * std::abs(across)) * 11.0, 1.0)));
        const double patch = layeredNoise({u * 8.0, v * 16.0, 5.0}, 4);
        Vec colour = mix({0.13, 0.33, 0.10}, {0.36, 0.58, 0.18}, patch);
        colour = mix(colour, {0.58, 0.73, 0.34}, std::fmax(0.85 * rib, 0.4 * vein));
        return Pixel{colour, std::fmax(inside, stem)};
    });
}

} // namespace still_life
