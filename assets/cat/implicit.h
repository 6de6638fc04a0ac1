// Solid shapes as fields: negative inside, positive outside, never changing faster than the distance moved
// (a Lipschitz constant of 1). A field is an ordered list of parts, each a smooth union of primitives.
//
// The Lipschitz bound gives two things. A ball around p with a radius below |f(p)| holds no surface; and within
// a ball many primitives provably have no say, because the smooth union is *exactly* the minimum once its two
// sides differ by the blend width. A `Selection` lists those that do: it gives the same bits as the whole field.
#pragma once

#include "assets/cat/vec3.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace hyalite::cat {

struct FieldSample {
    double value = 0.0;
    Vec3 gradient;
};

// An orthonormal basis and an origin: maps local to model coordinates.
struct Frame {
    Vec3 origin;
    Vec3 axisX{1.0, 0.0, 0.0};
    Vec3 axisY{0.0, 1.0, 0.0};
    Vec3 axisZ{0.0, 0.0, 1.0};

    [[nodiscard]] Vec3 direction(const Vec3 &v) const { return axisX * v.x + axisY * v.y + axisZ * v.z; }
    [[nodiscard]] Vec3 point(const Vec3 &p) const { return origin + direction(p); }
};

struct Ball {
    Vec3 centre;
    double radius = 0.0;
};

// The convex hull of two balls, or the half-space below a plane.
//
//        ______------__
//      /                \      `toLocal` stretches space first, so that the balls may be ellipsoids: a
//     (  a  ------->  b  )     stretched field is scaled back by the smallest radius to keep its Lipschitz
//      \ ______      __/       bound.
//              ------
class Primitive {
  public:
    // `stretch` is how much wider than a ball the shape is along each axis of `axes` (whose origin is unused).
    [[nodiscard]] static Primitive taperedCapsule(const Ball &a, const Ball &b,
                                                  const Vec3 &stretch = {1.0, 1.0, 1.0},
                                                  const Frame &axes = {});
    // Everything with dot(normal, p) < offset; `normal` has unit length.
    [[nodiscard]] static Primitive halfSpace(const Vec3 &normal, double offset);

    [[nodiscard]] double value(const Vec3 &p) const;
    [[nodiscard]] FieldSample sample(const Vec3 &p) const;

  private:
    struct Closest;
    [[nodiscard]] Closest closest(const Vec3 &p) const;
    [[nodiscard]] Vec3 toLocal(const Vec3 &p) const;

    bool isHalfSpace_ = false;
    std::array<Vec3, 3> rows_{}; // the stretching map, by rows
    double scale_ = 1.0;
    Vec3 start_;          // local centre of the first ball
    Vec3 axis_;           // unit vector to the second; the plane's normal of a half-space
    double length_ = 0.0; // between the centres; zero when one ball holds the other
    double startRadius_ = 0.0;
    double endRadius_ = 0.0;
    double slopeSine_ = 0.0; // of the cone between the balls
    double slopeCosine_ = 1.0;
    double slopeTangent_ = 0.0;
};

enum class Combine { unite, subtract, intersect };

struct Part {
    std::vector<Primitive> primitives;
    double innerBlend = 0.0; // width of the smooth union of the primitives
    Combine combine = Combine::unite;
    double outerBlend = 0.0; // width of the blend with the parts before
};

// The primitives of a field that have a say in some ball, part by part.
struct Selection {
    struct PartRange {
        std::uint32_t part = 0;
        std::uint32_t first = 0; // into `primitives`
        std::uint32_t count = 0;
    };
    std::vector<PartRange> parts;
    std::vector<std::uint32_t> primitives; // index within the part
};

class Field {
  public:
    void add(Part part) { parts_.push_back(std::move(part)); }

    [[nodiscard]] Selection selectAll() const;
    // What of `from` has a say in the ball. `from` must be valid there.
    [[nodiscard]] Selection select(const Selection &from, const Ball &ball) const;

    // `selection` must be valid at `p`.
    [[nodiscard]] double value(const Selection &selection, const Vec3 &p) const;
    [[nodiscard]] FieldSample sample(const Selection &selection, const Vec3 &p) const;

  private:
    std::vector<Part> parts_;
};

} // namespace hyalite::cat
