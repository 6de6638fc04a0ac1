// Meshes of the still life, with normals and texture coordinates, and the OBJ file that they become.
#pragma once

#include "assets/still-life/vec.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace still_life {

struct Vertex {
    Vec position{};
    Vec normal{};
    double u = 0.0;
    double v = 0.0;
};

/// Faces of the same material, each of three or four vertices.
struct Part {
    std::string material;
    std::vector<Vertex> vertices{};
    std::vector<std::vector<std::size_t>> faces{};
};

/// A grid of columns x rows faces over the unit square: `at` gives its points, of which normals are made. Seen so that u
/// grows to the right and v upwards it faces the viewer.
void addSheet(Part &part, int columns, int rows, const std::function<Vec(double u, double v)> &at);

/// What turns a profile, of distance from the y axis and height from v = 0 to 1, about that axis, and then moves it. u
/// goes round as longitude does, its middle at +z.
struct Profile {
    double radius;
    double height;
};
void addTurned(Part &part, int columns, int rows, const Vec &offset,
               const std::function<Profile(double v)> &profile);

/// Whether it could be written.
bool writeObj(const std::filesystem::path &file, const std::string &library, const std::vector<Part> &parts);

} // namespace still_life
