#include "assets/tea-table/mesh.h"

#include "assets/tea-table/turns.h"

#include <algorithm>
#include <array>

namespace tea_table {

using still_life::add;
using still_life::cross;
using still_life::normalise;
using still_life::scale;

namespace {

constexpr double step = 1e-4; // of u and v, for differences

/// The root of the distance between two points of a profile.
double knotBetween(const ProfilePoint &a, const ProfilePoint &b) {
    const double x = b.radius - a.radius;
    const double y = b.height - a.height;
    return std::sqrt(std::sqrt(x * x + y * y));
}

/// Centripetal Catmull-Rom between p[1] and p[2]: Yuksel et al., "Parameterization and Applications of Catmull-Rom
/// Curves", 2011. A uniform one loops where close neighbours follow distant ones, as they do at rims.
double catmullRom(const ProfilePoint *p, double ProfilePoint::*part, double t) {
    const double before = knotBetween(p[0], p[1]);
    const double here = knotBetween(p[1], p[2]);
    const double after = knotBetween(p[2], p[3]);
    const auto slope = [&](std::size_t from, double first, double second) {
        const double a = p[from].*part;
        const double b = p[from + 1].*part;
        const double c = p[from + 2].*part;
        return here * ((b - a) / first - (c - a) / (first + second) + (c - b) / second);
    };
    const double leaving = slope(0, before, here);
    const double arriving = slope(1, here, after);
    const double from = p[1].*part;
    const double way = p[2].*part - from;
    return from + t * (leaving +
                       t * ((3.0 * way - 2.0 * leaving - arriving) + t * (leaving + arriving - 2.0 * way)));
}

/// A smooth curve through the points of a profile. Where it ends on the axis it meets the axis at a right angle.
class Curve {
  public:
    explicit Curve(const std::vector<ProfilePoint> &profile) {
        points_.push_back(beyond(profile[0], profile[1]));
        points_.insert(points_.end(), profile.begin(), profile.end());
        points_.push_back(beyond(profile[profile.size() - 1], profile[profile.size() - 2]));
    }

    /// At a place from 0 to 1, between neighbours equally far apart.
    [[nodiscard]] ProfilePoint at(double place) const {
        const std::size_t pieceCount = points_.size() - 3;
        const double walked = std::clamp(place, 0.0, 1.0) * static_cast<double>(pieceCount);
        const std::size_t piece = std::min(static_cast<std::size_t>(walked), pieceCount - 1);
        const double t = walked - static_cast<double>(piece);
        const ProfilePoint *p = &points_[piece];
        return {std::max(catmullRom(p, &ProfilePoint::radius, t), 0.0),
                catmullRom(p, &ProfilePoint::height, t)};
    }

  private:
    static ProfilePoint beyond(const ProfilePoint &end, const ProfilePoint &inner) {
        if (end.radius == 0.0)
            return {-inner.radius, inner.height};
        return {2.0 * end.radius - inner.radius, 2.0 * end.height - inner.height};
    }

    std::vector<ProfilePoint> points_;
};

void addTriangle(Mesh &mesh, std::size_t a, std::size_t b, std::size_t c) {
    const auto same = [&](std::size_t i, std::size_t j) { return mesh.positions[i] == mesh.positions[j]; };
    if (same(a, b) || same(b, c) || same(c, a))
        return;
    for (const std::size_t vertex : {a, b, c})
        mesh.indices.push_back(static_cast<std::uint16_t>(vertex));
}

void addGrid(Mesh &mesh, std::size_t first, int columns, int rows) {
    const auto width = static_cast<std::size_t>(columns) + 1;
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row)
        for (std::size_t column = 0; column + 1 < width; ++column) {
            const std::size_t corner = first + row * width + column;
            addTriangle(mesh, corner, corner + 1, corner + width + 1);
            addTriangle(mesh, corner, corner + width + 1, corner + width);
        }
}

} // namespace

void addSheet(Mesh &mesh, int columns, int rows, const std::function<Vec(double u, double v)> &at) {
    const std::size_t first = mesh.positions.size();
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column) {
            const double u = static_cast<double>(column) / columns;
            const double v = static_cast<double>(row) / rows;
            const double beside =
                std::clamp(v, 2.0 * step, 1.0 - 2.0 * step); // a pole has no direction along u
            const Vec alongU = add(at(u + step, beside), scale(at(u - step, beside), -1.0));
            const Vec alongV = add(at(u, beside + step), scale(at(u, beside - step), -1.0));
            mesh.positions.push_back(at(u, v));
            mesh.normals.push_back(normalise(cross(alongU, alongV)));
            mesh.uvs.push_back({u, 1.0 - v});
        }
    addGrid(mesh, first, columns, rows);
}

void addTurned(Mesh &mesh, int columns, int rowsPerPoint, const std::vector<ProfilePoint> &profile) {
    const Curve curve(profile);
    const int rows = rowsPerPoint * static_cast<int>(profile.size() - 1);
    const std::size_t first = mesh.positions.size();
    addSheet(mesh, columns, rows, [&](double u, double v) {
        const ProfilePoint point = curve.at(v);
        return Vec{point.radius * sinTurns(u - 0.5), point.height, point.radius * cosTurns(u - 0.5)};
    });
    std::vector<double> lengths{0.0};
    for (int row = 1; row <= rows; ++row) {
        const ProfilePoint from = curve.at(static_cast<double>(row - 1) / rows);
        const ProfilePoint to = curve.at(static_cast<double>(row) / rows);
        const double x = to.radius - from.radius;
        const double y = to.height - from.height;
        lengths.push_back(lengths.back() + std::sqrt(x * x + y * y));
    }
    for (std::size_t i = first; i < mesh.uvs.size(); ++i)
        mesh.uvs[i][1] =
            1.0 - lengths[(i - first) / (static_cast<std::size_t>(columns) + 1)] / lengths.back();
}

void addTube(Mesh &mesh, int columns, int rows, const std::array<ProfilePoint, 4> &curve,
             const std::function<TubePoint(double v)> &along) {
    const auto blend = [&](double ProfilePoint::*part, double t) {
        const double s = 1.0 - t;
        return s * s * s * curve[0].*part + 3.0 * s * s * t * curve[1].*part +
               3.0 * s * t * t * curve[2].*part + t * t * t * curve[3].*part;
    };
    const auto slope = [&](double ProfilePoint::*part, double t) {
        const double s = 1.0 - t;
        return s * s * (curve[1].*part - curve[0].*part) + 2.0 * s * t * (curve[2].*part - curve[1].*part) +
               t * t * (curve[3].*part - curve[2].*part);
    };
    addSheet(mesh, columns, rows, [&](double u, double v) {
        const TubePoint point = along(v);
        const Vec middle{blend(&ProfilePoint::radius, point.place), blend(&ProfilePoint::height, point.place),
                         0.0};
        const Vec forward = normalise(
            {slope(&ProfilePoint::radius, point.place), slope(&ProfilePoint::height, point.place), 0.0});
        const Vec side{forward[1], -forward[0], 0.0}; // to the right of `forward`; z is towards the viewer
        return add(middle,
                   add(scale(side, point.radius * sinTurns(u)), Vec{0.0, 0.0, point.radius * cosTurns(u)}));
    });
}

void addRoundedCube(Mesh &mesh, double half, double rounding) {
    constexpr int cells = 10;
    const double core = 1.0 - rounding;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            const std::size_t first = mesh.positions.size();
            for (int row = 0; row <= cells; ++row)
                for (int column = 0; column <= cells; ++column) {
                    Vec at{};
                    at[axis] = side;
                    at[(axis + 1) % 3] =
                        side * (2.0 * column / cells - 1.0); // mirrored, so that it faces outwards
                    at[(axis + 2) % 3] = 2.0 * row / cells - 1.0;
                    Vec inner{};
                    for (std::size_t i = 0; i < 3; ++i)
                        inner[i] = std::clamp(at[i], -core, core);
                    const Vec normal = normalise(add(at, scale(inner, -1.0)));
                    mesh.positions.push_back(scale(add(inner, scale(normal, rounding)), half));
                    mesh.normals.push_back(normal);
                    mesh.uvs.push_back(
                        {static_cast<double>(column) / cells, 1.0 - static_cast<double>(row) / cells});
                }
            addGrid(mesh, first, cells, cells);
        }
}

void layFlat(Mesh &mesh, double halfWidth) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        mesh.uvs[i] = {0.5 + 0.5 * mesh.positions[i][0] / halfWidth,
                       0.5 + 0.5 * mesh.positions[i][2] / halfWidth};
}

void paint(Mesh &mesh, const std::function<Vec(const Vec &position)> &colourAt) {
    mesh.colours.clear();
    for (const Vec &position : mesh.positions)
        mesh.colours.push_back(colourAt(position));
}

} // namespace tea_table
