// Meshes of the tea table: sheets, bodies of revolution, tubes and rounded cubes. Lengths are in metres.
#pragma once

#include "assets/still-life/vec.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tea_table {

using still_life::Vec;

/// Triangles, counter-clockwise seen from outside. Lists of vertices are of the same length, or empty for `uvs` and
/// `colours`.
struct Mesh {
    std::vector<Vec> positions{};
    std::vector<Vec> normals{};
    std::vector<std::array<double, 2>> uvs{}; ///< v from the top, as glTF has it
    std::vector<Vec> colours{};               ///< linear
    std::vector<std::uint16_t> indices{};
};

/// A point of a profile: its distance from the y axis, and its height.
struct ProfilePoint {
    double radius;
    double height;
};

/// A grid of columns x rows over the unit square, whose points `at` gives. Seen so that u grows to the right and v
/// upwards it faces the viewer. Triangles that touch a pole are left out where they have no area.
void addSheet(Mesh &mesh, int columns, int rows, const std::function<Vec(double u, double v)> &at);

/// Turns a smooth curve (centripetal Catmull-Rom) through `profile` about the y axis. A profile that goes from the axis
/// up the outside, over the rim and down the inside back to the axis makes a closed vessel. v follows its length.
void addTurned(Mesh &mesh, int columns, int rowsPerPoint, const std::vector<ProfilePoint> &profile);

/// A tube along a cubic Bezier curve in the plane z = 0. `along` gives, for v from 0 to 1, the place on the curve from
/// 0 to 1 and the radius there.
struct TubePoint {
    double place;
    double radius;
};
void addTube(Mesh &mesh, int columns, int rows, const std::array<ProfilePoint, 4> &curve,
             const std::function<TubePoint(double v)> &along);

/// A cube around the origin from -half to half, its edges rounded by a share `rounding` of that.
void addRoundedCube(Mesh &mesh, double half, double rounding);

/// Gives each vertex the texture coordinates of its x and z: from 0 to 1 over a square of that half width.
void layFlat(Mesh &mesh, double halfWidth);

/// Gives each vertex a colour by its position.
void paint(Mesh &mesh, const std::function<Vec(const Vec &position)> &colourAt);

} // namespace tea_table
