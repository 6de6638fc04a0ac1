#include "tests/random/random_files.h"

#include "host/scene/limits.h"

#include <fmt/format.h>

#include <cmath>

namespace hyalite::core::testing {

using nlohmann::json;

json unitOf(double x, double y, double z) {
    const double length = std::sqrt(x * x + y * y + z * z);
    return length > 0.0 ? json{x / length, y / length, z / length} : json{0, 0, 1};
}

std::string FileDraws::addSky(bool isWhite) {
    const int width = 2 * draws_.whole(1, 6);
    const int height = draws_.whole(1, 6);
    json floats = json::array();
    for (int i = 0; i < 3 * width * height; ++i)
        floats.push_back(isWhite              ? 1.0
                         : draws_.chance(0.3) ? 0.0
                         : draws_.chance(0.1) ? draws_.uniform(20, 300)
                                              : draws_.uniform(0, 2));
    files_["sky.pfm"] = {{"width", width}, {"height", height}, {"floats", floats}};
    return "sky.pfm";
}

std::string FileDraws::addImage(bool isNormal) {
    const int channels = !isNormal && draws_.chance(0.3) ? 4 : 3;
    const int width = draws_.whole(1, 5);
    const int height = draws_.whole(1, 5);
    json levels = json::array();
    for (int i = 0; i < width * height; ++i)
        for (int channel = 0; channel < channels; ++channel)
            levels.push_back(isNormal && channel == 2 ? 128 + draws_.level() / 2
                             : draws_.chance(0.2)     ? 255 * draws_.whole(0, 1)
                                                      : draws_.level());
    levels[2] = levels[0] == 200 ? 201 : 200; // no grey image: a normal map of greys is refused
    const std::string name = fmt::format("image{}.png", imageCount_++);
    files_[name] = {{"width", width}, {"channels", channels}, {"levels", levels}};
    return name;
}

Patch FileDraws::patch() {
    Patch patch;
    const int cells = draws_.whole(1, 4);
    const bool isBall = draws_.chance(0.5);
    const int faces = isBall ? 6 : 1;
    const double bump = draws_.chance(0.5) ? 0.5 : 0.0;
    const double tilt = draws_.chance(0.5) ? 0.8 : 0.0;
    for (int face = 0; face < faces; ++face) {
        const int first = static_cast<int>(patch.positions.size());
        for (int i = 0; i <= cells; ++i)
            for (int j = 0; j <= cells; ++j) {
                const double u = static_cast<double>(i) / cells;
                const double v = static_cast<double>(j) / cells;
                const double side = face % 2 == 0 ? 1.0 : -1.0;
                double corner[3];
                corner[face / 2] = side;
                corner[(face / 2 + 1) % 3] = side * (2.0 * u - 1.0);
                corner[(face / 2 + 2) % 3] = 2.0 * v - 1.0;
                patch.uvs.push_back({u, v});
                if (isBall) {
                    patch.positions.push_back(unitOf(corner[0], corner[1], corner[2]));
                    patch.normals.push_back(patch.positions.back());
                } else {
                    patch.positions.push_back({2.0 * u - 1.0, 2.0 * v - 1.0, draws_.uniform(-bump, bump)});
                    patch.normals.push_back(
                        unitOf(draws_.uniform(-tilt, tilt), draws_.uniform(-tilt, tilt), 1.0));
                }
            }
        for (int i = 0; i < cells; ++i)
            for (int j = 0; j < cells; ++j) {
                const int a = first + i * (cells + 1) + j;
                const int b = a + cells + 1;
                patch.triangles.push_back({a, b, b + 1});
                patch.triangles.push_back({a, b + 1, a + 1});
            }
    }
    return patch;
}

std::string FileDraws::addObj() {
    const Patch patch = this->patch();
    json lines = json::array();
    const bool hasColours = draws_.chance(0.2);
    for (const json &p : patch.positions)
        lines.push_back(
            fmt::format("v {} {} {}", p[0].get<double>(), p[1].get<double>(), p[2].get<double>()) +
            (hasColours ? fmt::format(" {} {} {}", draws_.number(limits::fraction),
                                      draws_.number(limits::fraction), draws_.number(limits::fraction))
                        : ""));
    for (const json &n : patch.normals)
        lines.push_back(
            fmt::format("vn {} {} {}", n[0].get<double>(), n[1].get<double>(), n[2].get<double>()));
    for (const json &uv : patch.uvs)
        lines.push_back(fmt::format("vt {} {}", uv[0].get<double>(), uv[1].get<double>()));
    const bool hasNormals = draws_.chance(0.6);
    for (const auto &triangle : patch.triangles) {
        std::string line = "f";
        for (const int corner : triangle)
            line +=
                hasNormals ? fmt::format(" {0}/{0}/{0}", corner + 1) : fmt::format(" {0}/{0}", corner + 1);
        lines.push_back(line);
    }
    files_["patch.obj"] = lines;
    return "patch.obj";
}

std::string FileDraws::addLamp(std::size_t index) {
    constexpr std::size_t lampCount = 4;
    index %= lampCount;
    const std::string name = fmt::format("lamp-{}.ies", index);
    if (files_.contains(name))
        return name;
    Draws draws(index, 0); // others keep theirs
    const std::vector<std::string> planes{"0", "0 37 90", "90 150 170 270", "0 5 100 240 360"};
    const std::vector<std::size_t> planeCounts{1, 3, 4, 5};
    const bool isUp = index == 2;
    json lines{"IESNA:LM-63-2002",
               "TILT=NONE",
               fmt::format("1 -1 2 5 {} 1 2 0 0 0", planeCounts[index]),
               "1 1 50",
               isUp         ? "90 91 120 140 180"
               : index == 1 ? "0 30 31 60 90"
                            : "0 45 90 135 180",
               planes[index]};
    for (std::size_t plane = 0; plane < planeCounts[index]; ++plane) {
        std::string line = index == 3 && plane == 2 ? "0" : "70"; // each has some light
        for (int gamma = 1; gamma < 5; ++gamma)
            line += fmt::format(" {}", draws.chance(0.3) ? 0.0 : draws.uniform(0.0, 100.0));
        lines.push_back(line);
    }
    files_[name] = lines;
    return name;
}

} // namespace hyalite::core::testing
