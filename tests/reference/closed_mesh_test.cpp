// Rays from inside of closed meshes: none leaves without crossing a wall, and none is stopped by the face that it left.
#include "host/reference/closest_hit.h"
#include "tests/fixtures/geometry_fixture.h"

#include <glm/mat3x3.hpp>

#include <cmath>

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::packed;
using hyalite::core::testing::Random;
using hyalite::core::testing::Tally;
using Vec = glm::dvec3;

struct Solid {
    std::string name;
    std::vector<Vec> corners;
    std::vector<glm::uvec3> faces; ///< counter-clockwise seen from outside
};

Solid box(const std::string &name, const Vec &half) {
    Solid solid{name, {}, {}};
    for (unsigned i = 0; i < 8; ++i)
        solid.corners.push_back(half *
                                Vec((i & 1u) != 0 ? 1 : -1, (i & 2u) != 0 ? 1 : -1, (i & 4u) != 0 ? 1 : -1));
    for (const glm::uvec4 &q : {glm::uvec4(0, 4, 6, 2), glm::uvec4(1, 3, 7, 5), glm::uvec4(0, 1, 5, 4),
                                glm::uvec4(2, 6, 7, 3), glm::uvec4(0, 2, 3, 1), glm::uvec4(4, 5, 7, 6)}) {
        solid.faces.emplace_back(q.x, q.y, q.z);
        solid.faces.emplace_back(q.x, q.z, q.w);
    }
    return solid;
}

Solid icosphere(int level) {
    const double g = std::numbers::phi;
    Solid solid{"icosphere",
                {{-1, g, 0},
                 {1, g, 0},
                 {-1, -g, 0},
                 {1, -g, 0},
                 {0, -1, g},
                 {0, 1, g},
                 {0, -1, -g},
                 {0, 1, -g},
                 {g, 0, -1},
                 {g, 0, 1},
                 {-g, 0, -1},
                 {-g, 0, 1}},
                {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
    for (Vec &corner : solid.corners)
        corner = glm::normalize(corner);
    for (int i = 0; i < level; ++i) {
        std::map<std::pair<unsigned, unsigned>, unsigned> middles;
        const auto middle = [&](unsigned a, unsigned b) {
            const auto [place, isNew] =
                middles.try_emplace(std::minmax(a, b), static_cast<unsigned>(solid.corners.size()));
            if (isNew)
                solid.corners.push_back(glm::normalize(solid.corners[a] + solid.corners[b]));
            return place->second;
        };
        std::vector<glm::uvec3> finer;
        for (const glm::uvec3 &face : solid.faces) {
            const unsigned a = middle(face.x, face.y), b = middle(face.y, face.z), c = middle(face.z, face.x);
            finer.insert(finer.end(), {{face.x, a, c}, {face.y, b, a}, {face.z, c, b}, {a, b, c}});
        }
        solid.faces = finer;
    }
    return solid;
}

/// A prism over a triangle with the angle between two sides of length 1.
Solid wedge(double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vec side(std::cos(angle), std::sin(angle), 0.0);
    const Vec half(0.0, 0.0, 0.5);
    return {fmt::format("wedge of {} degrees", degrees),
            {-half, Vec(1, 0, 0) - half, side - half, half, Vec(1, 0, 0) + half, side + half},
            {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}}};
}

double distanceToEdge(const Vec &p, const Vec &a, const Vec &b) {
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::length(p - a - (b - a) * t);
}

/// The walk of rays in one placed solid.
class Inside {
  public:
    explicit Inside(const Solid &solid) : solid_(solid) {
        Scene scene;
        scene.materials.emplace_back();
        TriangleMesh mesh;
        double largest = 0.0;
        for (const Vec &corner : solid.corners) {
            mesh.positions.emplace_back(corner);
            for (int axis = 0; axis < 3; ++axis)
                largest = std::max(largest, std::abs(corner[axis]));
        }
        for (const glm::uvec3 &face : solid.faces)
            mesh.triangles.push_back({.positions = face});
        corners_ = mesh.positions;
        scene.meshes.push_back(mesh);
        scene_ = packed(scene);
        unitInLastPlace_ = std::ldexp(1.0, std::ilogb(largest) - 23);
    }

    /// Rays by reflection, by chance and near to the face; checks closest hits and shadow rays.
    void walk(Random &random, int rayCount, Tally &escapes, Tally &stops) {
        const SceneView<float> view(scene_);
        NoCounter counter;
        Vec middle(0.0);
        for (const glm::vec3 &corner : corners_)
            middle += Vec(corner) / static_cast<double>(corners_.size());
        for (int i = 0; i < rayCount;) {
            Ray<float> ray{glm::vec3(middle), glm::vec3(random.direction())};
            Hit<float> hit = closestHit(view, ray, counter);
            for (int bounce = 0; bounce < 32 && i < rayCount && hit.primitive != layout::noPrimitive;
                 ++bounce, ++i) {
                std::uint32_t material = 0;
                const Surface<float> surface = smoothSurface(view, hit, ray.origin, ray.direction, material);
                const Vec inward = -normalOf(faceOf(hit));
                const Vec to = directionFrom(random, bounce, ray, inward);
                ray = {offsetRayOrigin(view, surface, glm::vec3(to)), glm::vec3(to), hit.primitive};
                const Hit<float> next = closestHit(view, ray, counter);
                const bool isBlocked = isAnythingBefore(view, ray, 1e30f, layout::noPrimitive, counter);
                const bool isLost = next.primitive == layout::noPrimitive || !isBlocked;
                escapes.check(!isLost || widthAt(hit) <= 8.0 * unitInLastPlace_,
                              [&] { return fmt::format("{}, {} wide", solid_.name, widthAt(hit)); });
                stops.check(isLost || glm::dot(normalOf(faceOf(next)), -inward) < 1.0 - 1e-9,
                            [&] { return solid_.name; });
                hit = isLost ? noHit<float>() : next;
            }
        }
    }

  private:
    [[nodiscard]] std::size_t faceOf(const Hit<float> &hit) const {
        return hit.primitive - scene_.frame.firstTriangleId;
    }
    [[nodiscard]] Vec corner(std::size_t face, int i) const { return corners_[solid_.faces[face][i]]; }
    [[nodiscard]] Vec normalOf(std::size_t face) const {
        return glm::normalize(
            glm::cross(corner(face, 1) - corner(face, 0), corner(face, 2) - corner(face, 0)));
    }

    /// Towards the inside.
    [[nodiscard]] static Vec directionFrom(Random &random, int bounce, const Ray<float> &ray,
                                           const Vec &inward) {
        if (bounce % 3 == 0) {
            const Vec mirrored = glm::reflect(Vec(ray.direction), inward);
            if (glm::dot(mirrored, inward) > 1e-6)
                return mirrored;
        }
        if (bounce % 5 == 0) // near to the face
            return glm::normalize(glm::normalize(glm::cross(inward, random.direction())) +
                                  inward * random.logUniform(1e-4, 1.0));
        return glm::normalize(inward + 0.999999 * random.direction());
    }

    /// How wide the inside is at a hit: to the walls around it, and across.
    [[nodiscard]] double widthAt(const Hit<float> &hit) const {
        const std::size_t at = faceOf(hit);
        const double u = static_cast<double>(hit.u), v = static_cast<double>(hit.v);
        const Vec point = corner(at, 0) * u + corner(at, 1) * v + corner(at, 2) * (1.0 - u - v);
        double width = std::numeric_limits<double>::infinity();
        for (std::size_t face = 0; face < solid_.faces.size(); ++face)
            if (std::abs(glm::dot(normalOf(face), normalOf(at))) < 1.0 - 1e-10)
                width = std::min(width, distanceToFace(point, face));
        return width;
    }
    [[nodiscard]] double distanceToFace(const Vec &point, std::size_t face) const {
        const Vec normal = normalOf(face);
        const double height = glm::dot(point - corner(face, 0), normal);
        bool isAbove = true;
        double toEdges = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 3; ++i) {
            const Vec a = corner(face, i), b = corner(face, (i + 1) % 3);
            isAbove = isAbove && glm::dot(glm::cross(b - a, point - normal * height - a), normal) >= 0.0;
            toEdges = std::min(toEdges, distanceToEdge(point, a, b));
        }
        return isAbove ? std::abs(height) : toEdges;
    }

    Solid solid_;
    std::vector<glm::vec3> corners_;
    PackedScene scene_;
    double unitInLastPlace_ = 0.0;
};

Solid placed(Solid solid, Random &random, bool isTurned, double scale, double distance) {
    const Vec x = random.direction();
    const Vec y = glm::normalize(glm::cross(x, random.direction()));
    const glm::dmat3 turn = isTurned ? glm::dmat3(x, y, glm::cross(x, y)) : glm::dmat3(1.0);
    const Vec offset = random.direction() * (scale * distance);
    for (Vec &corner : solid.corners)
        corner = turn * corner * scale + offset;
    return solid;
}

TEST(ClosedMesh, KeepsTheRaysThatAreInside) {
    Random random(20);
    Tally escapes("rays that leave where the inside is wider than 8 units in the last place", random.seed());
    Tally stops("rays that are stopped by the face that they left", random.seed());
    const std::vector<Solid> solids{box("box", Vec(1.0)), box("slab", Vec(1.0, 0.1, 0.3)),
                                    icosphere(0),         icosphere(2),
                                    wedge(1.0),           wedge(5.0),
                                    wedge(30.0),          wedge(175.0)};
    for (const Solid &solid : solids)
        for (const bool isTurned : {false, true})
            for (const double scale : {1e-4, 1.0, 1e5})
                for (const double distance : {0.0, 1.0, 1e2, 1e3, 1e4})
                    Inside(placed(solid, random, isTurned, scale, distance))
                        .walk(random, 2000, escapes, stops);
    escapes.expectNone();
    stops.expectNone();
}

} // namespace
} // namespace hyalite::core::reference
