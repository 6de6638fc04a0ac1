// make_still_life --output FOLDER: writes still-life.obj, its materials, and the textures that they wear. Runs while Hyalite
// is built.
//
// On a table of planks stand a globe on a brass foot, a plant in a painted pot, and a paper lantern.
#include "assets/still-life/images.h"
#include "assets/still-life/mesh.h"
#include "assets/still-life/noise.h"

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string_view>

namespace {

using namespace still_life;

constexpr int exitUsage = 2;
constexpr int exitOutput = 7;

constexpr std::string_view materials = R"(# Written by make_still_life.
newmtl table
map_Kd -s 3 2 1 -o 0.1 0 0 still-life-wood.png
map_Pr -s 3 2 1 -o 0.1 0 0 still-life-wood-roughness.png
norm -s 3 2 1 -o 0.1 0 0 still-life-wood-normals.png

newmtl globe
map_Kd still-life-globe.png
map_Pr still-life-globe-roughness.png

newmtl brass
Kd 0.89 0.68 0.34
Pr 0.22
Pm 1

newmtl lantern
Kd 0.6 0.5 0.4
Ke 2 2 2
map_Ke still-life-lantern.png

newmtl lacquer
Kd 0.05 0.03 0.025
Pr 0.3

newmtl pot
map_Kd still-life-pot.png
Pr 0.7
norm still-life-pot-normals.png

newmtl earth
Kd 0.09 0.06 0.04

newmtl leaf
map_Kd still-life-leaf.png
map_d still-life-leaf.png
Pr 0.45
)";

/// A ring around the axis through `middle`, along z.
void addRing(Part &part, const Vec &middle, double radius, double thickness, double fromTurn, double toTurn) {
    addSheet(part, 96, 20, [&](double u, double v) {
        const double around = 2.0 * pi * (fromTurn + (toTurn - fromTurn) * u);
        const double across = 2.0 * pi * v;
        const double distance = radius + thickness * std::cos(across);
        return add(middle,
                   {distance * std::sin(around), distance * std::cos(around), -thickness * std::sin(across)});
    });
}

void addTable(std::vector<Part> &parts) {
    Part table{"table"};
    addSheet(table, 1, 1, [](double u, double v) { return Vec{-9.0 + 18.0 * u, 0.0, 5.5 - 12.0 * v}; });
    parts.push_back(table);
}

void addGlobe(std::vector<Part> &parts) {
    const Vec middle{-2.05, 2.1, -0.2};
    constexpr double radius = 1.25;
    constexpr double tilt = 23.4 / 180.0 * pi;
    Part globe{"globe"};
    addSheet(globe, 128, 64, [&](double u, double v) {
        const double longitude = 2.0 * pi * (u - 0.30);
        const double latitude = pi * (v - 0.5);
        const Vec point{radius * std::cos(latitude) * std::sin(longitude), radius * std::sin(latitude),
                        radius * std::cos(latitude) * std::cos(longitude)};
        return add(middle, {point[0] * std::cos(tilt) + point[1] * std::sin(tilt),
                            point[1] * std::cos(tilt) - point[0] * std::sin(tilt), point[2]});
    });
    parts.push_back(globe);
    Part brass{"brass"};
    addRing(brass, middle, 1.36, 0.05, tilt / (2.0 * pi), tilt / (2.0 * pi) + 0.5);
    addTurned(brass, 64, 48, {middle[0], 0.0, middle[2]}, [](double v) {
        const double height = 0.72 * v;
        const double column = 0.075 + 0.05 * std::exp(-60.0 * (v - 0.55) * (v - 0.55));
        const double foot = 0.72 * std::exp(-9.0 * v * v) * smoothStep(-0.05, 0.03, v);
        return Profile{std::fmax(column, foot) * (1.0 - 0.2 * smoothStep(0.95, 1.0, v)), height};
    });
    parts.push_back(brass);
}

void addLantern(std::vector<Part> &parts) {
    const Vec place{2.35, 0.0, -0.6};
    constexpr double low = 0.22;
    constexpr double high = 2.9;
    const auto radiusAt = [](double v) {
        return 0.52 + 0.36 * std::pow(std::sin(pi * (0.08 + 0.84 * v)), 0.75);
    };
    Part paper{"lantern"};
    addTurned(paper, 96, 90, place, [&](double v) {
        const double rib = 0.012 * std::abs(std::remainder(v * 9.0, 1.0));
        return Profile{radiusAt(v) + rib, low + (high - low) * v};
    });
    parts.push_back(paper);
    Part lacquer{"lacquer"};
    const auto addRim = [&](double y, double radius, double height) {
        addTurned(lacquer, 64, 24, place, [&](double v) { // from the middle of its bottom to that of its top
            const double walk = clamp01((v - 0.3) / 0.4);
            const double out = v < 0.3 ? v / 0.3 : v > 0.7 ? (1.0 - v) / 0.3 : 1.0;
            const double bulge = 0.03 * std::sin(pi * walk);
            return Profile{radius * std::fmax(out, 1e-4) + bulge, y + height * smoothStep(0.0, 1.0, walk)};
        });
    };
    addRim(0.0, radiusAt(0.0) + 0.05, low + 0.04);
    addRim(high - 0.04, radiusAt(1.0) + 0.05, 0.2);
    parts.push_back(lacquer);
}

void addPlant(std::vector<Part> &parts) {
    const Vec place{0.2, 0.0, -1.1};
    constexpr double rimHeight = 1.25;
    Part pot{"pot"};
    addTurned(pot, 96, 80, place, [](double v) {
        // Up the outside, over a rounded rim, and down the inside.
        if (v > 0.88) {
            const double turn = pi * (v - 0.88) / 0.12;
            return Profile{0.87 + 0.05 * std::cos(turn),
                           rimHeight + 0.05 * std::sin(turn) - 0.12 * smoothStep(0.94, 1.0, v)};
        }
        const double up = v / 0.88;
        const double rim = 0.07 * smoothStep(0.8, 0.84, up);
        return Profile{(0.5 + 0.35 * up + rim) * smoothStep(-0.02, 0.004, up), rimHeight * up};
    });
    parts.push_back(pot);
    Part earth{"earth"};
    addTurned(earth, 48, 8, add(place, {0.0, rimHeight - 0.1, 0.0}), [](double v) {
        return Profile{0.84 * (1.0 - v) + 1e-4, 0.07 * smoothStep(0.0, 1.0, v)};
    });
    parts.push_back(earth);
    Part leaves{"leaf"};
    constexpr int leafCount = 22;
    for (int i = 0; i < leafCount; ++i) {
        const double azimuth = 2.399963 * i; // the golden angle
        const double age = static_cast<double>(i) / (leafCount - 1);
        const double chance = noise({1.7 * i, 0.5, 0.5});
        const double length = 1.5 + 0.75 * (1.0 - std::abs(2.0 * age - 0.9)) + 0.3 * chance;
        const double rise =
            (1.25 - 0.95 * age) + 0.15 * chance; // of its stalk, in radians: old leaves lean out
        const double sag = 0.55 + 0.75 * age;
        const double half = 0.25 + 0.06 * chance;
        const Vec out{std::sin(azimuth), 0.0, std::cos(azimuth)};
        const Vec aside{std::cos(azimuth), 0.0, -std::sin(azimuth)};
        addSheet(leaves, 6, 24, [&](double u, double v) {
            // Walked along an arc that bends downwards more and more.
            Vec at = add(place, {0.0, rimHeight - 0.05, 0.0});
            constexpr int pieces = 24;
            double angle = rise;
            for (int piece = 0; piece < pieces; ++piece) {
                const double share = clamp01(v * pieces - piece);
                angle = rise - sag * (piece + 0.5) / pieces * 2.0;
                at = add(at, add(scale(out, std::cos(angle) * share * length / pieces),
                                 {0.0, std::sin(angle) * share * length / pieces, 0.0}));
            }
            const double across = 2.0 * u - 1.0;
            const Vec upward = add(scale(out, -std::sin(angle)), {0.0, std::cos(angle), 0.0});
            const double fold = 0.28 * std::abs(across) * half;
            return add(at, add(scale(aside, across * half), scale(upward, fold)));
        });
    }
    parts.push_back(leaves);
}

bool writeText(const std::filesystem::path &file, std::string_view text) {
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    stream.close();
    return stream.good();
}

bool writeAll(const std::filesystem::path &folder) {
    const auto write = [&](const char *name, const Picture &picture, bool hasAlpha = false) {
        return writePng(folder / (std::string("still-life-") + name + ".png"), picture, hasAlpha);
    };
    std::vector<Part> parts;
    addTable(parts);
    addGlobe(parts);
    addLantern(parts);
    addPlant(parts);
    return write("wood", woodColour()) && write("wood-roughness", woodRoughness()) &&
           write("wood-normals", woodNormals()) && write("globe", globeColour()) &&
           write("globe-roughness", globeRoughness()) && write("lantern", lanternLight()) &&
           write("pot", potColour()) && write("pot-normals", potNormals()) && write("leaf", leaf(), true) &&
           writeText(folder / "still-life.mtl", materials) &&
           writeObj(folder / "still-life.obj", "still-life.mtl", parts);
}

} // namespace

int main(int argumentCount, char **arguments) {
    if (argumentCount != 3 || std::strcmp(arguments[1], "--output") != 0) {
        std::fputs("usage: make_still_life --output FOLDER\n", stderr);
        return exitUsage;
    }
    if (!writeAll(arguments[2])) {
        std::fprintf(stderr, "make_still_life: the files could not be written to %s\n", arguments[2]);
        return exitOutput;
    }
    return 0;
}
