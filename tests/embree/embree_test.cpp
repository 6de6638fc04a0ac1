// Our nearest hits and shadow rays against Embree's, ray by ray, and both against exact arithmetic.
//
// Two correct programs in float32 may name different triangles where a ray passes within rounding of an edge, where
// two triangles lie at the same distance, or where a triangle lies at the ray's start. Each difference is put to all
// triangles of the mesh in long double (exact_intersection.h): what that cannot explain fails the test.
#include "host/import/obj.h"
#include "host/packing/packed_scene.h"
#include "host/reference/closest_hit.h"
#include "tests/embree/embree_scene.h"
#include "tests/embree/exact_intersection.h"
#include "tests/embree/meshes.h"
#include "tests/fixtures/leaves.h"
#include "tests/fixtures/test_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>

namespace hyalite::core {
namespace {

using glm::dvec3;
using glm::vec3;
using testing::Doubt;
using testing::ExactIntersection;
using testing::Real;
using FloatRay = reference::Ray<float>;
using FloatHit = reference::Hit<float>;

/// A mesh in both programs.
class Subject {
  public:
    Subject(const char *label, TriangleMesh triangles, TreeKind tree)
        : name(label), mesh(std::move(triangles)), embree(mesh) {
        TestScene scene;
        scene.materials.emplace_back();
        scene.meshes.push_back(mesh);
        ours = packScene(scene, buildBvh(tree, buildTriangles(scene), scene.settings.leafSize));
        const dvec3 lower(ours.frame.boundsLower);
        const dvec3 upper(ours.frame.boundsUpper);
        centre = (lower + upper) / 2.0;
        halfSize = (upper - lower) / 2.0;
        radius = glm::length(halfSize);
        for (std::uint32_t first = 0; first < mesh.triangles.size(); first += clusterSize)
            clusters_.push_back(boundCluster(first));
    }

    /// Calls visit(triangle, intersection) for all triangles but the excluded one that the ray may hit, in whichever
    /// program, and for some more.
    template <class Visitor> void visitNearby(const FloatRay &ray, Visitor &&visit) const {
        for (std::size_t i = 0; i < clusters_.size(); ++i) {
            const dvec3 offset = clusters_[i].centre - dvec3(ray.origin);
            const double distance = glm::length(glm::cross(offset, dvec3(ray.direction)));
            if (distance > 1.001 * clusters_[i].radius + 1e-5 * glm::length(offset))
                continue;
            const std::size_t first = i * clusterSize;
            const std::size_t end = std::min(first + clusterSize, mesh.triangles.size());
            for (std::size_t triangle = first; triangle < end; ++triangle) {
                const std::uint32_t index = static_cast<std::uint32_t>(triangle);
                if (index + layout::minFirstTriangleId != ray.excluded && isNearby(ray, index))
                    visit(index, testing::intersectExactly(testing::cornersOf(mesh, index), ray.origin,
                                                           ray.direction));
            }
        }
    }

    const char *name;
    TriangleMesh mesh;
    testing::EmbreeScene embree;
    PackedScene ours;
    dvec3 centre{0.0};
    dvec3 halfSize{0.0};
    double radius = 0.0;

  private:
    static constexpr std::uint32_t clusterSize = 32;

    struct Ball {
        dvec3 centre;
        double radius;
    };

    [[nodiscard]] Ball boundCluster(std::uint32_t first) const {
        const std::size_t end = std::min<std::size_t>(first + clusterSize, mesh.triangles.size());
        Box box;
        for (std::uint32_t i = first; i < end; ++i)
            for (const vec3 &corner : testing::cornersOf(mesh, i))
                box.extend(corner);
        return {(dvec3(box.lower) + dvec3(box.upper)) / 2.0,
                glm::distance(dvec3(box.lower), dvec3(box.upper)) / 2.0};
    }

    /// Whether the ray passes the box of the triangle as seen along the ray; the rest is not worth long double.
    [[nodiscard]] bool isNearby(const FloatRay &ray, std::uint32_t triangle) const {
        const testing::Corners corners = testing::cornersOf(mesh, triangle);
        const dvec3 d(ray.direction);
        std::array<dvec3, 3> image;
        double reach = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const dvec3 offset = dvec3(corners[i]) - dvec3(ray.origin);
            reach = std::max(reach, glm::length(offset));
            image[i] = offset - d * glm::dot(offset, d);
        }
        const dvec3 lower = glm::min(glm::min(image[0], image[1]), image[2]);
        const dvec3 upper = glm::max(glm::max(image[0], image[1]), image[2]);
        const double slack = 1e-5 * reach;
        return std::max({lower.x, lower.y, lower.z}) < slack &&
               std::min({upper.x, upper.y, upper.z}) > -slack;
    }

    std::vector<Ball> clusters_;
};

std::uint32_t triangleOf(const FloatHit &hit) { return hit.primitive - layout::minFirstTriangleId; }

enum class Reason { Edge, Grazing, Tie, Start, Count };

/// Whether a program with such doubts may say that this is the nearest triangle, or that there is none.
bool isDefensible(const Subject &subject, const FloatRay &ray, std::optional<std::uint32_t> answer,
                  Doubt ExactIntersection::*doubt) {
    Real certainlyHitBy = std::numeric_limits<Real>::infinity();
    subject.visitNearby(ray, [&](std::uint32_t, const ExactIntersection &intersection) {
        if (intersection.isCertain(intersection.*doubt))
            certainlyHitBy = std::min(certainlyHitBy, intersection.t + (intersection.*doubt).tError);
    });
    if (!answer)
        return certainlyHitBy == std::numeric_limits<Real>::infinity();
    const ExactIntersection intersection =
        testing::intersectExactly(testing::cornersOf(subject.mesh, *answer), ray.origin, ray.direction);
    return intersection.isPossible(intersection.*doubt) &&
           intersection.t - (intersection.*doubt).tError <= certainlyHitBy;
}

/// What made two defensible answers differ, as the nearer one of the two triangles shows.
Reason reasonFor(const Subject &subject, const FloatRay &ray, std::optional<std::uint32_t> ours,
                 std::optional<std::uint32_t> theirs) {
    ExactIntersection nearest;
    nearest.t = std::numeric_limits<Real>::infinity();
    for (const std::optional<std::uint32_t> &answer : {ours, theirs}) {
        if (!answer)
            continue;
        const ExactIntersection intersection =
            testing::intersectExactly(testing::cornersOf(subject.mesh, *answer), ray.origin, ray.direction);
        if (intersection.t < nearest.t)
            nearest = intersection;
    }
    if (nearest.t <= std::max(nearest.ours.tError, nearest.theirs.tError))
        return Reason::Start;
    if (nearest.isGrazing())
        return Reason::Grazing;
    return std::min(nearest.ours.inside, nearest.theirs.inside) <= 1 ? Reason::Edge : Reason::Tie;
}

/// What the comparison of many rays found.
struct Rates {
    std::size_t rayCount = 0;
    std::size_t hitCount = 0;                                                   ///< ours
    std::array<std::size_t, static_cast<std::size_t>(Reason::Count)> reasons{}; ///< of differences
    std::size_t oursWrong = 0;
    std::size_t theirsWrong = 0;

    // Where both found the same triangle: the worst errors, in units of those that rounding explains.
    Real ourDistance = 0;
    Real theirDistance = 0;
    Real ourPosition = 0;
    Real ourNormal = 0;
    Real theirNormal = 0;
    Real relative = 0; ///< difference of both distances, for triangles in a good position

    void add(const Rates &other) {
        rayCount += other.rayCount;
        hitCount += other.hitCount;
        for (std::size_t i = 0; i < reasons.size(); ++i)
            reasons[i] += other.reasons[i];
        oursWrong += other.oursWrong;
        theirsWrong += other.theirsWrong;
        ourDistance = std::max(ourDistance, other.ourDistance);
        theirDistance = std::max(theirDistance, other.theirDistance);
        ourPosition = std::max(ourPosition, other.ourPosition);
        ourNormal = std::max(ourNormal, other.ourNormal);
        theirNormal = std::max(theirNormal, other.theirNormal);
        relative = std::max(relative, other.relative);
    }

    void print(const Subject &subject, const char *kind) const {
        fmt::print(
            "{:<11} {:<8} {:>5} rays, {:4.1f} % hit; differences: edge {}, grazing {}, tie {}, start {}, "
            "wrong: ours {}, Embree's {}; errors over bounds: t {:.2f}, {:.2f}, point {:.2f}, normal {:.2f}, "
            "{:.2f}; "
            "t differs by {:.1e}\n",
            subject.name, kind, rayCount,
            100.0 * static_cast<double>(hitCount) / static_cast<double>(rayCount), reasons[0], reasons[1],
            reasons[2], reasons[3], oursWrong, theirsWrong, static_cast<double>(ourDistance),
            static_cast<double>(theirDistance), static_cast<double>(ourPosition),
            static_cast<double>(ourNormal), static_cast<double>(theirNormal), static_cast<double>(relative));
        std::fflush(stdout);
    }
};

/// Compares distances and normals where both found the same triangle.
void compareHits(const Subject &subject, const FloatRay &ray, const FloatHit &ours,
                 const testing::EmbreeScene::Hit &theirs, Rates &rates) {
    const ExactIntersection exact = testing::intersectExactly(
        testing::cornersOf(subject.mesh, theirs.triangle), ray.origin, ray.direction);
    const Real ourT = Real(ours.distance);
    const Real theirT = Real(theirs.t);
    rates.ourDistance = std::max(rates.ourDistance, std::abs(ourT - exact.t) / exact.ours.tError);
    rates.theirDistance = std::max(rates.theirDistance, std::abs(theirT - exact.t) / exact.theirs.tError);
    if (exact.slenderness < 4 && exact.cosine > Real(0.25) && exact.reach < 2 * exact.t)
        rates.relative = std::max(rates.relative, std::abs(ourT - theirT) / exact.t);

    const reference::Surface<float> surface = reference::triangleSurface<float>(
        subject.ours.triangles[ours.record], subject.ours.normals[ours.record], ours.u, ours.v);
    // The point of the hit itself: that of the surface keeps its distance from the edges.
    const layout::TriangleRecord &triangle = subject.ours.triangles[ours.record];
    const vec3 point = reference::trianglePoint<float>(triangle.v0, triangle.v1, triangle.v2, ours.u, ours.v);
    rates.ourPosition = std::max(rates.ourPosition, glm::distance(testing::Vector(point), exact.position) /
                                                        exact.ourPositionError);
    const auto error = [&](const vec3 &normal) {
        return glm::length(glm::normalize(testing::Vector(normal)) - exact.normal);
    };
    // Embree subtracts the ray's origin from the vertices first, which costs their last digits.
    const Real allowed = 12 * testing::roundingUnit * exact.slenderness;
    rates.ourNormal = std::max(rates.ourNormal, error(surface.geometricNormal) / allowed);
    rates.theirNormal =
        std::max(rates.theirNormal, error(theirs.normal) / (allowed * (1 + exact.reach / exact.longest)));
}

void compareRay(const Subject &subject, const FloatRay &ray, const FloatHit &hit, Rates &rates) {
    const auto theirs = subject.embree.closestHit(ray.origin, ray.direction);
    std::optional<std::uint32_t> ourTriangle;
    std::optional<std::uint32_t> theirTriangle;
    if (hit.primitive != layout::noPrimitive)
        ourTriangle = triangleOf(hit);
    if (theirs)
        theirTriangle = theirs->triangle;
    ++rates.rayCount;
    rates.hitCount += ourTriangle ? 1 : 0;
    if (ourTriangle == theirTriangle) {
        if (theirs)
            compareHits(subject, ray, hit, *theirs, rates);
        return;
    }
    const bool isOursWrong = !isDefensible(subject, ray, ourTriangle, &ExactIntersection::ours);
    const bool isTheirsWrong = !isDefensible(subject, ray, theirTriangle, &ExactIntersection::theirs);
    rates.oursWrong += isOursWrong ? 1 : 0;
    rates.theirsWrong += isTheirsWrong ? 1 : 0;
    if (!isOursWrong && !isTheirsWrong)
        ++rates.reasons[static_cast<std::size_t>(reasonFor(subject, ray, ourTriangle, theirTriangle))];
    else if (rates.oursWrong + rates.theirsWrong <= 2)
        fmt::print("triangle {} instead of {} from {:a} {:a} {:a} in direction {:a} {:a} {:a}\n",
                   ourTriangle ? static_cast<int>(*ourTriangle) : -1,
                   theirTriangle ? static_cast<int>(*theirTriangle) : -1, ray.origin.x, ray.origin.y,
                   ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z);
}

/// Returns our hits.
std::vector<FloatHit> compareNearest(const Subject &subject, const char *kind,
                                     const std::vector<FloatRay> &rays) {
    std::vector<FloatHit> hits(rays.size());
    Rates total;
#pragma omp parallel
    {
        Rates rates;
#pragma omp for schedule(dynamic, 256)
        for (std::size_t i = 0; i < rays.size(); ++i) {
            hits[i] = reference::closestHit(subject.ours, rays[i]);
            compareRay(subject, rays[i], hits[i], rates);
        }
#pragma omp critical
        total.add(rates);
    }
    total.print(subject, kind);
    EXPECT_EQ(total.oursWrong, 0u) << subject.name << ", " << kind;
    EXPECT_EQ(total.theirsWrong, 0u) << subject.name << ", " << kind;
    EXPECT_LE(total.ourDistance, 1) << "in units of what rounding explains";
    EXPECT_LE(total.ourPosition, 1) << "in units of what rounding explains";
    EXPECT_LE(total.ourNormal, 1) << "in units of what rounding explains";
    EXPECT_LE(total.relative, 2e-6);
    return hits;
}

struct ShadowRay {
    FloatRay ray;
    float length;
};

void compareShadows(const Subject &subject, const char *kind, const std::vector<ShadowRay> &rays) {
    std::atomic<std::size_t> blockedCount = 0;
    std::atomic<std::size_t> differenceCount = 0;
    std::atomic<std::size_t> wrongCount = 0;
#pragma omp parallel for schedule(dynamic, 256)
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto &[ray, length] = rays[i];
        const Real end = Real(length);
        const bool isBlocked = reference::castShadowRay(subject.ours, ray, length).isBlocked;
        blockedCount += isBlocked ? 1 : 0;
        if (isBlocked == subject.embree.isOccluded(ray.origin, ray.direction, length))
            continue;
        ++differenceCount;
        const auto isInDoubt = [&](Doubt ExactIntersection::*doubt, bool answer) {
            bool isPossible = false;
            bool isCertain = false;
            subject.visitNearby(ray, [&](std::uint32_t, const ExactIntersection &intersection) {
                const Real error = (intersection.*doubt).tError;
                isPossible = isPossible ||
                             (intersection.isPossible(intersection.*doubt) && intersection.t - error < end);
                isCertain = isCertain ||
                            (intersection.isCertain(intersection.*doubt) && intersection.t + error < end);
            });
            return answer ? isPossible : !isCertain;
        };
        const bool isExplained = isInDoubt(&ExactIntersection::ours, isBlocked) &&
                                 isInDoubt(&ExactIntersection::theirs, !isBlocked);
        wrongCount += isExplained ? 0 : 1;
    }
    fmt::print("{:<11} {:<8} {:>5} rays, {:4.1f} % blocked; differences: explained {}, wrong {}\n",
               subject.name, kind, rays.size(),
               100.0 * static_cast<double>(blockedCount) / static_cast<double>(rays.size()),
               differenceCount - wrongCount, wrongCount.load());
    std::fflush(stdout);
    EXPECT_EQ(wrongCount, 0u) << subject.name << ", " << kind;
}

// ---- Rays

class RayMaker {
  public:
    explicit RayMaker(const Subject &subject) : subject_(subject) {}

    double uniform() { return distribution_(random_); } ///< in [-1, 1)

    dvec3 unitVector() {
        for (;;) {
            const dvec3 v(uniform(), uniform(), uniform());
            const double squared = glm::dot(v, v);
            if (squared > 0.01 && squared <= 1.0)
                return v / std::sqrt(squared);
        }
    }

    /// In the mesh's box.
    dvec3 point() { return subject_.centre + subject_.halfSize * dvec3(uniform(), uniform(), uniform()); }

    static FloatRay towards(const vec3 &origin, const dvec3 &target) {
        return {origin, vec3(glm::normalize(target - dvec3(origin)))};
    }

    /// From a distance of so many radii.
    std::vector<FloatRay> fromOutside(std::size_t count, double radii) {
        std::vector<FloatRay> rays;
        for (std::size_t i = 0; i < count; ++i)
            rays.push_back(
                towards(vec3(subject_.centre + unitVector() * (subject_.radius * radii)), point()));
        return rays;
    }

    std::vector<FloatRay> fromInside(std::size_t count) {
        std::vector<FloatRay> rays;
        for (std::size_t i = 0; i < count; ++i)
            rays.push_back({vec3(point()), vec3(unitVector())});
        return rays;
    }

    /// At vertices and at the middles of edges, from anywhere: nearly all of them are matters of rounding.
    std::vector<FloatRay> atEdges(std::size_t count) {
        std::vector<FloatRay> rays;
        for (std::size_t i = 0; i < count; ++i) {
            const testing::Corners corners = testing::cornersOf(
                subject_.mesh, static_cast<std::uint32_t>(random_() % subject_.mesh.triangles.size()));
            const vec3 target = i % 2 == 0 ? corners[0] : (corners[0] + corners[1]) * 0.5f;
            const dvec3 origin =
                i % 4 < 2 ? point() : subject_.centre + unitVector() * (3.0 * subject_.radius);
            rays.push_back(towards(vec3(origin), dvec3(target)));
        }
        return rays;
    }

    /// A ray that leaves the surface that another one hit.
    FloatRay leaving(const FloatHit &hit, const dvec3 &direction) const {
        const reference::Surface<float> surface = reference::triangleSurface<float>(
            subject_.ours.triangles[hit.record], subject_.ours.normals[hit.record], hit.u, hit.v);
        return {reference::offsetRayOrigin(surface, vec3(direction)), vec3(direction), hit.primitive};
    }

  private:
    const Subject &subject_;
    std::mt19937_64 random_{2024};
    std::uniform_real_distribution<double> distribution_{-1.0, 1.0};
};

/// The rays of a picture's pixel centres.
std::vector<FloatRay> primaryRays(const Subject &subject, int size) {
    TestScene scene;
    scene.camera.position = subject.centre + dvec3(0.6, 0.45, 1.1) * subject.radius;
    scene.camera.direction = subject.centre - scene.camera.position;
    scene.camera.width = size;
    scene.camera.height = size;
    const layout::FrameRecord frame = packScene(scene, Bvh{}).frame;
    std::vector<FloatRay> rays;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            rays.push_back(
                {frame.eye, reference::primaryDirection<float>(frame, glm::uvec2(x, y), glm::vec2(0.5f))});
    return rays;
}

void expectAgreement(const Subject &subject) {
    RayMaker maker(subject);
    const std::vector<FloatRay> primary = primaryRays(subject, 200);
    const std::vector<FloatHit> hits = compareNearest(subject, "primary", primary);
    compareNearest(subject, "outside", maker.fromOutside(40000, 2.0));
    compareNearest(subject, "far", maker.fromOutside(20000, 1000.0));
    compareNearest(subject, "inside", maker.fromInside(40000));
    compareNearest(subject, "edges", maker.atEdges(10000));

    const dvec3 light = subject.centre + dvec3(-1.0, 2.0, 1.5) * subject.radius;
    std::vector<FloatRay> bounces;
    std::vector<ShadowRay> shadows;
    for (std::size_t i = 0; bounces.size() < 40000; i = (i + 1) % hits.size()) {
        if (hits[i].primitive == layout::noPrimitive)
            continue;
        bounces.push_back(maker.leaving(hits[i], maker.unitVector())); // to either side
        const vec3 position = primary[i].origin + primary[i].direction * hits[i].distance;
        const dvec3 toLight = light - dvec3(position);
        shadows.push_back(
            {maker.leaving(hits[i], glm::normalize(toLight)), static_cast<float>(glm::length(toLight))});
        // And over all lengths, to end in the middle of things.
        shadows.push_back({bounces.back(), static_cast<float>((1.001 + maker.uniform()) * subject.radius)});
    }
    compareNearest(subject, "bounce", bounces);
    compareShadows(subject, "shadow", shadows);
}

TEST(Embree, AgreesOnTheCat) {
    TriangleMesh cat = loadObj(HYALITE_ASSET_DIR "/scenes/cat.obj").mesh;
    for (MeshTriangle &triangle : cat.triangles)
        triangle.normals = glm::uvec3(MeshTriangle::noNormal);
    expectAgreement(Subject("cat", std::move(cat), TreeKind::Midpoint));
}

TEST(Embree, AgreesOnATorusFarFromTheOrigin) {
    expectAgreement(Subject("torus", testing::torus(200, 100, {1000.0, -2000.0, 500.0}), TreeKind::Sah));
}

TEST(Embree, AgreesOnAnIcosphere) {
    expectAgreement(Subject("icosphere", testing::icosphere(6, 0.0), TreeKind::Sah));
}

TEST(Embree, AgreesOnARoughBall) {
    expectAgreement(Subject("rough ball", testing::icosphere(6, 0.05), TreeKind::Midpoint));
}

TEST(Embree, AgreesOnLongThinTriangles) {
    expectAgreement(Subject("drawn torus", testing::torus(12, 2000, dvec3(0.0)), TreeKind::Sah));
}

TEST(Embree, AgreesOnNeedles) { expectAgreement(Subject("needles", testing::needles(20000), TreeKind::Sah)); }

} // namespace
} // namespace hyalite::core
