#include "tests/fixtures/leaves.h"

#include "host/reference/closest_hit.h"
#include "tests/fixtures/geometry_fixture.h"

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::Random;
using hyalite::core::testing::sameBits;
using hyalite::core::testing::Tally;
using hyalite::core::testing::text;
using LongVec = glm::vec<3, long double>;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

// ---- Watertight

/// Ericson, "Real-Time Collision Detection", section 5.1.5.
glm::dvec3 closestPoint(const glm::dvec3 &p, const glm::dvec3 &a, const glm::dvec3 &b, const glm::dvec3 &c) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const double d1 = glm::dot(ab, p - a);
    const double d2 = glm::dot(ac, p - a);
    if (d1 <= 0.0 && d2 <= 0.0)
        return a;
    const double d3 = glm::dot(ab, p - b);
    const double d4 = glm::dot(ac, p - b);
    if (d3 >= 0.0 && d4 <= d3)
        return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
        return a + ab * (d1 / (d1 - d3));
    const double d5 = glm::dot(ab, p - c);
    const double d6 = glm::dot(ac, p - c);
    if (d6 >= 0.0 && d5 <= d6)
        return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
        return a + ac * (d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 >= d3 && d5 >= d6)
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double sum = va + vb + vc;
    return a + ab * (vb / sum) + ac * (vc / sum);
}

/// A closed mesh around `centre`, and a ball around it that the mesh does not reach into.
struct ClosedMesh {
    PackedScene scene;
    glm::dvec3 centre;
    double coreRadius;
    double outerRadius;

    ClosedMesh(const TriangleMesh &unit, double scale, const glm::dvec3 &offset)
        : scene(hyalite::core::testing::packed(
              hyalite::core::testing::sceneOf(hyalite::core::testing::placed(unit, scale, offset)),
              TreeKind::Sah, 2)),
          centre(offset), coreRadius(std::numeric_limits<double>::infinity()), outerRadius(0.0) {
        for (const layout::TriangleRecord &t : scene.triangles) {
            coreRadius = std::min(coreRadius, glm::distance(centre, closestPoint(centre, t.v0, t.v1, t.v2)));
            outerRadius = std::max(outerRadius, glm::distance(centre, glm::dvec3(t.v0)));
        }
    }
};

/// A corner, or a point on an edge, as near as floats come.
glm::dvec3 targetOn(const ClosedMesh &mesh, Random &random, bool isVertex) {
    const layout::TriangleRecord &triangle = mesh.scene.triangles[random.below(mesh.scene.triangles.size())];
    const glm::vec3 corners[3] = {triangle.v0, triangle.v1, triangle.v2};
    const std::size_t first = random.below(3);
    const glm::dvec3 a = corners[first];
    const glm::dvec3 b = corners[(first + 1) % 3];
    return isVertex ? a : glm::mix(a, b, random.uniform());
}

std::string describe(const Ray<float> &ray, const Hit<float> &hit) {
    return fmt::format("origin {} direction {}: primitive {} at {:a}", text(ray.origin), text(ray.direction),
                       hit.primitive, hit.distance);
}

/// From inside of the core every ray must meet the mesh.
void shootFromInside(const ClosedMesh &mesh, Random &random, bool isVertex, int count, Tally &leaks) {
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 target = targetOn(mesh, random, isVertex);
        const glm::vec3 origin(mesh.centre + random.inBall(0.9 * mesh.coreRadius));
        const Ray<float> ray{origin, glm::vec3(glm::normalize(target - glm::dvec3(origin)))};
        const Hit<float> hit = closestHit(mesh.scene, ray);
        leaks.check(hit.primitive != layout::noPrimitive, [&] { return describe(ray, hit); });
    }
}

/// A ray from outside through the target into the core must meet the mesh before it comes to the core's middle: a hit
/// on the far side does not reportFailure a leak on the near side.
void shootFromOutside(const ClosedMesh &mesh, Random &random, bool isVertex, int count, Tally &leaks) {
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 target = targetOn(mesh, random, isVertex);
        const glm::dvec3 inner = mesh.centre + random.inBall(0.5 * mesh.coreRadius);
        const glm::dvec3 outward = glm::normalize(target - inner);
        const glm::vec3 origin(mesh.centre +
                               outward * (mesh.outerRadius * (2.0 + random.logUniform(1e-2, 1e3))) +
                               (inner - mesh.centre));
        const Ray<float> ray{origin, glm::vec3(glm::normalize(target - glm::dvec3(origin)))};
        const double toInner = glm::dot(mesh.centre - glm::dvec3(origin), glm::dvec3(ray.direction));
        const glm::dvec3 nearest = glm::dvec3(origin) + glm::dvec3(ray.direction) * toInner;
        if (glm::distance(nearest, mesh.centre) >
            0.9 * mesh.coreRadius) // moved by the rounding of the origin
            continue;
        const Hit<float> hit = closestHit(mesh.scene, ray);
        leaks.check(hit.primitive != layout::noPrimitive && static_cast<double>(hit.distance) < toInner,
                    [&] { return describe(ray, hit); });
    }
}

/// Rays along the axes and the diagonals, whose shear is exact, precisely through vertices.
void shootAlongAxes(const ClosedMesh &mesh, Random &random, int count, Tally &leaks) {
    for (int i = 0; i < count; ++i) {
        const glm::vec3 vertex(targetOn(mesh, random, true));
        const auto component = [&] {
            const float values[] = {-1.0f, -0.0f, 0.0f, 1.0f};
            return values[random.below(4)];
        };
        glm::vec3 steps{component(), component(), component()};
        if (steps == glm::vec3(0.0f))
            continue;
        const double reach = 4.0 * mesh.outerRadius;
        const float back = std::ldexp(1.0f, std::ilogb(static_cast<float>(reach)) + 1);
        const glm::vec3 origin = vertex - steps * back;
        if (origin + steps * back != vertex)
            continue;
        const Ray<float> ray{origin, steps * static_cast<float>(1.0 / glm::length(glm::dvec3(steps)))};
        const glm::dvec3 direction = glm::normalize(glm::dvec3(steps));
        const double toCentre = glm::dot(mesh.centre - glm::dvec3(origin), direction);
        const glm::dvec3 nearest = glm::dvec3(origin) + direction * toCentre;
        if (glm::distance(nearest, mesh.centre) > 0.9 * mesh.coreRadius)
            continue;
        const Hit<float> hit = closestHit(mesh.scene, ray);
        leaks.check(hit.primitive != layout::noPrimitive && static_cast<double>(hit.distance) < toCentre,
                    [&] { return describe(ray, hit); });
    }
}

void expectWatertight(const char *name, const TriangleMesh &mesh, std::uint64_t seed) {
    struct Placement {
        const char *name;
        double scale;
        glm::dvec3 offset;
    };
    for (const Placement &placement : {Placement{"at the origin", 1.0, glm::dvec3(0.0)},
                                       {"at offset 1e6", 10.0, {1e6, -1e6, 1e6}},
                                       {"at offset 1e6 along x", 100.0, {1e6, 0.0, 0.0}},
                                       {"scaled by 1e-6", 1e-6, glm::dvec3(0.0)},
                                       {"scaled by 1e6", 1e6, glm::dvec3(0.0)}}) {
        const ClosedMesh closed(mesh, placement.scale, placement.offset);
        ASSERT_GT(closed.coreRadius, 0.05 * placement.scale) << "the mesh does not enclose its centre";
        for (const bool isVertex : {true, false}) {
            Random random(seed);
            const char *target = isVertex ? "vertices" : "edges";
            Tally leaks(fmt::format("leaks of {} {} at {}", name, placement.name, target), seed);
            shootFromInside(closed, random, isVertex, 105'000, leaks);
            shootFromOutside(closed, random, isVertex, 105'000, leaks);
            if (isVertex)
                shootAlongAxes(closed, random, 50'000, leaks);
            EXPECT_GE(leaks.count(), 200'000u);
            leaks.expectNone();
        }
    }
}

TEST(Watertight, Tetrahedron) {
    expectWatertight("a tetrahedron", hyalite::core::testing::tetrahedron(), 101);
}
TEST(Watertight, Icosphere) { expectWatertight("an icosphere", hyalite::core::testing::icosphere(2), 102); }
TEST(Watertight, SpikyStarOfSlivers) {
    expectWatertight("a star of slivers", hyalite::core::testing::spikyStar(), 103);
}

TEST(Watertight, CubeOfFlatBoxes) { expectWatertight("a cube", hyalite::core::testing::gridCube(5), 115); }

TEST(Watertight, NeighboursOfASharedEdgeSeeOppositeEdgeFunctions) {
    // Two triangles over one edge, in a plane that faces the ray: whatever the rounding, a ray at a point of the inner
    // edge hits one of them.
    Random random(104);
    Tally gaps("gaps between two triangles", random.seed());
    for (int i = 0; i < 1'000'000; ++i) {
        const double scale = random.logUniform(1e-6, 1e6);
        const glm::dvec3 centre = random.inCube(scale * random.logUniform(1.0, 1e5));
        const glm::dvec3 x = random.direction();
        const glm::dvec3 y = glm::normalize(glm::cross(x, random.direction()));
        const glm::vec3 a(centre - x * scale);
        const glm::vec3 b(centre + x * scale);
        // Long and flat more often than not.
        const glm::vec3 left(centre +
                             (y * random.logUniform(1e-4, 1.0) + x * random.uniform(-1.0, 1.0)) * scale);
        const glm::vec3 right(centre -
                              (y * random.logUniform(1e-4, 1.0) + x * random.uniform(-1.0, 1.0)) * scale);
        const glm::dvec3 target = glm::mix(glm::dvec3(a), glm::dvec3(b), random.uniform(0.2, 0.8));
        const glm::dvec3 normal = glm::cross(x, y);
        const glm::vec3 origin(target +
                               (normal + random.inCube(0.5)) * (scale * random.logUniform(0.1, 100.0)));
        const glm::vec3 direction(glm::normalize(target - glm::dvec3(origin)));
        // Rounding must not push the ray, or the edge, beyond the far sides: they are 1e-4 of the size away.
        const double rounding = 1e-6 * (glm::length(glm::dvec3(origin)) + glm::length(centre));
        if (glm::length(glm::cross(glm::dvec3(left) - glm::dvec3(a), x)) < rounding ||
            glm::length(glm::cross(glm::dvec3(right) - glm::dvec3(a), x)) < rounding)
            continue;
        const glm::vec3 lower = glm::min(glm::min(a, b), glm::min(left, right));
        const glm::vec3 upper = glm::max(glm::max(a, b), glm::max(left, right));
        const BoxRay<float> boxRay = makeBoxRay(origin, direction, lower, upper);
        const TriangleRay<float> ray = makeTriangleRay(origin, direction);
        const bool isHit = intersectTriangle(ray, boxRay, a, b, left).distance > 0 ||
                           intersectTriangle(ray, boxRay, b, a, right).distance > 0;
        gaps.check(isHit, [&] {
            return fmt::format("a {} b {} left {} right {} origin {} direction {}", text(a), text(b),
                               text(left), text(right), text(origin), text(direction));
        });
    }
    gaps.expectNone();
}

// ---- The tree changes nothing

/// The definition of the nearest hit, without any tree: smallest distance, then smallest id.
Hit<float> nearestByDefinition(const PackedScene &scene, const Ray<float> &ray) {
    const BoxRay<float> boxRay =
        makeBoxRay(ray.origin, ray.direction, scene.frame.boundsLower, scene.frame.boundsUpper);
    const TriangleRay<float> triangleRay = makeTriangleRay(ray.origin, ray.direction);
    Hit<float> nearest = noHit<float>();
    for (std::uint32_t record = 0; record < scene.triangles.size(); ++record) {
        const layout::TriangleRecord &triangle = scene.triangles[record];
        if (triangle.primitiveId == ray.excluded)
            continue;
        const TriangleHit<float> hit =
            intersectTriangle(triangleRay, boxRay, triangle.v0, triangle.v1, triangle.v2);
        if (!(hit.distance > 0))
            continue;
        if (hit.distance < nearest.distance ||
            (hit.distance == nearest.distance && triangle.primitiveId < nearest.primitive))
            nearest = {hit.distance, triangle.primitiveId, record, hit.u, hit.v, layout::noInstance};
    }
    return nearest;
}

glm::vec3 latticePoint(Random &random, int half) {
    const auto coordinate = [&] {
        return static_cast<float>(static_cast<int>(random.below(static_cast<std::size_t>(2 * half + 1))) -
                                  half);
    };
    const float x = coordinate();
    const float y = coordinate();
    return {x, y, coordinate()};
}

/// Each in a plane of a lattice, so that boxes are flat and share faces.
TriangleMesh latticeTriangles(Random &random, std::size_t count, const glm::vec3 &offset, float scale) {
    TriangleMesh mesh;
    for (std::size_t i = 0; i < count; ++i) {
        glm::vec3 corners[3] = {latticePoint(random, 2), latticePoint(random, 2), latticePoint(random, 2)};
        const int axis = static_cast<int>(random.below(3));
        corners[1][axis] = corners[0][axis];
        corners[2][axis] = corners[0][axis];
        hyalite::core::testing::addTriangle(mesh, offset + corners[0] * scale, offset + corners[1] * scale,
                                            offset + corners[2] * scale);
    }
    return mesh;
}

std::vector<std::pair<std::string, TriangleMesh>> hostileMeshes(Random &random) {
    using hyalite::core::testing::addTriangle;
    using hyalite::core::testing::triangleSoup;
    std::vector<std::pair<std::string, TriangleMesh>> meshes;
    meshes.emplace_back("random", triangleSoup(random, 60, 1.0, 0.5));
    meshes.emplace_back("flat boxes", latticeTriangles(random, 60, glm::vec3(0.0f), 1.0f));
    meshes.emplace_back("flat boxes far away",
                        latticeTriangles(random, 60, glm::vec3(1e6f, 1e6f, -1e6f), 0.5f));
    meshes.emplace_back("tiny flat boxes", latticeTriangles(random, 60, glm::vec3(0.0f), 1e-6f));
    TriangleMesh coincident;
    for (int i = 0; i < 40; ++i) {
        const glm::vec3 shift(0.0f, i % 3 == 0 ? 1e-7f : 0.0f, 0.0f);
        if (i % 2 == 0)
            addTriangle(coincident, glm::vec3(-1, 0.25f, -1) + shift, glm::vec3(1, 0.25f, -1) + shift,
                        glm::vec3(0, 0.25f, 1) + shift);
        else
            addTriangle(coincident, glm::vec3(1, 0.25f, -1) + shift, glm::vec3(-1, 0.25f, -1) + shift,
                        glm::vec3(0, 0.25f, 1) + shift);
    }
    meshes.emplace_back("coincident", coincident);
    TriangleMesh needles;
    for (int i = 0; i < 60; ++i) {
        const glm::dvec3 a = random.inCube(1.0);
        const glm::dvec3 b = random.inCube(1.0);
        const double width = random.logUniform(1e-9, 1e-3);
        const glm::vec3 c(glm::mix(a, b, i % 3 == 0 ? 0.0 : random.uniform()) + random.inCube(width));
        addTriangle(needles, glm::vec3(a), glm::vec3(b), c);
    }
    meshes.emplace_back("needles", needles);
    TriangleMesh degenerate = triangleSoup(random, 20, 1.0, 0.5);
    for (int i = 0; i < 40; ++i) {
        const glm::vec3 a(random.inCube(1.0));
        const glm::vec3 b(random.inCube(1.0));
        addTriangle(degenerate, a, i % 2 == 0 ? a : b, i % 3 == 0 ? a : (a + b) / 2.0f);
    }
    meshes.emplace_back("degenerate", degenerate);
    meshes.emplace_back("a small mesh far away", triangleSoup(random, 60, 0.5, 0.2, {1e4, 2e4, -3e4}));
    TriangleMesh mixed = triangleSoup(random, 40, 1.0, 0.01);
    for (int i = 0; i < 20; ++i) {
        const double size = random.logUniform(1.0, 1e10);
        addTriangle(mixed, glm::vec3(random.inCube(size)), glm::vec3(random.inCube(size)),
                    glm::vec3(random.inCube(size)));
    }
    meshes.emplace_back("giant and tiny", mixed);
    meshes.emplace_back("coordinates of 1e15", triangleSoup(random, 60, 1e15, 5e14));
    meshes.emplace_back("coordinates of 1e-12", triangleSoup(random, 60, 1e-12, 5e-13));
    TriangleMesh ball = hyalite::core::testing::icosphere(1);
    meshes.emplace_back("a ball", ball);
    TriangleMesh room;
    hyalite::core::testing::addQuad(room, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
    hyalite::core::testing::addQuad(room, {-1, -1, 1}, {2, 0, 0}, {0, 2, 0});
    hyalite::core::testing::addQuad(room, {-1, -1, -1}, {0, 2, 0}, {0, 0, 2});
    hyalite::core::testing::addQuad(room, {1, -1, -1}, {0, 2, 0}, {0, 0, 2});
    hyalite::core::testing::addQuad(room, {-1, -1, -1}, {0, 0, 2}, {2, 0, 0});
    hyalite::core::testing::addQuad(room, {-1, 1, -1}, {0, 0, 2}, {2, 0, 0});
    meshes.emplace_back("a room", room);
    return meshes;
}

Ray<float> hostileRay(Random &random, const PackedScene &scene) {
    const glm::dvec3 lower(scene.frame.boundsLower);
    const glm::dvec3 upper(scene.frame.boundsUpper);
    const glm::dvec3 centre = (lower + upper) * 0.5;
    const double size = std::max({upper.x - lower.x, upper.y - lower.y, upper.z - lower.z, 1e-30});
    const auto anyTriangle = [&]() -> const layout::TriangleRecord & {
        return scene.triangles[random.below(scene.triangles.size())];
    };
    const auto pointOf = [&](const layout::TriangleRecord &t) -> glm::vec3 {
        switch (random.below(4)) {
        case 0:
            return t.v0;
        case 1:
            return glm::vec3(glm::mix(glm::dvec3(t.v1), glm::dvec3(t.v2), random.uniform()));
        default: {
            const double u = random.uniform();
            const double v = random.uniform() * (1.0 - u);
            return glm::vec3(glm::dvec3(t.v0) * u + glm::dvec3(t.v1) * v + glm::dvec3(t.v2) * (1.0 - u - v));
        }
        }
    };
    Ray<float> ray;
    switch (random.below(5)) {
    case 0: // on a triangle
        ray.origin = pointOf(anyTriangle());
        break;
    case 1: { // in a plane of a triangle's box
        ray.origin = glm::vec3(centre + random.inCube(size));
        const layout::TriangleRecord &t = anyTriangle();
        const int axis = static_cast<int>(random.below(3));
        ray.origin[axis] = t.v0[axis];
        if (random.coin())
            ray.origin[(axis + 1) % 3] = t.v1[(axis + 1) % 3];
        break;
    }
    case 2: // far outside
        ray.origin = glm::vec3(centre + random.direction() * (size * random.logUniform(1.0, 1e4)));
        break;
    default:
        ray.origin = glm::vec3(centre + random.inCube(size));
    }
    const float zeroOrOne[] = {-1.0f, -0.0f, 0.0f, 1.0f};
    glm::dvec3 direction = random.direction();
    switch (random.below(6)) {
    case 0: // along axes and diagonals
        direction = {zeroOrOne[random.below(4)], zeroOrOne[random.below(4)], zeroOrOne[random.below(4)]};
        break;
    case 1: // in an axis-parallel plane
        direction[static_cast<int>(random.below(3))] = random.coin() ? 0.0 : -0.0;
        break;
    case 2: // nearly parallel to a plane
        direction[static_cast<int>(random.below(3))] =
            random.logUniform(1e-40, 1e-6) * (random.coin() ? 1 : -1);
        break;
    case 3: { // in the plane of a triangle
        const layout::TriangleRecord &t = anyTriangle();
        ray.origin = pointOf(t);
        direction = glm::dvec3(pointOf(t)) - glm::dvec3(ray.origin);
        break;
    }
    default: // at a triangle
        direction = glm::dvec3(pointOf(anyTriangle())) - glm::dvec3(ray.origin);
    }
    const double length = glm::length(direction);
    ray.direction = length > 0.0 ? glm::vec3(direction / length) : glm::vec3(0.0f, -0.0f, -1.0f);
    if (random.below(4) == 0)
        ray.excluded = anyTriangle().primitiveId;
    return ray;
}

bool isSameHit(const Hit<float> &a, const Hit<float> &b) {
    return a.primitive == b.primitive && sameBits(a.distance, b.distance) && sameBits(a.u, b.u) &&
           sameBits(a.v, b.v);
}

TEST(ClosestHit, IsTheSameToTheBitWithEveryTreeAndWithout) {
    // For long runs by hand: HYALITE_TEST_SCALE=10 traces ten times as many rays.
    const char *scale = std::getenv("HYALITE_TEST_SCALE");
    const int raysPerScene = 80'000 * std::clamp(scale != nullptr ? std::atoi(scale) : 1, 1, 1000);
    Random random(105);
    Tally differences("tree against brute force", random.seed());
    std::uint64_t hitCount = 0;
    for (const auto &[name, mesh] : hostileMeshes(random)) {
        const Scene scene = hyalite::core::testing::sceneOf(mesh);
        std::vector<std::pair<std::string, PackedScene>> trees;
        trees.emplace_back("none", hyalite::core::testing::packed(scene, TreeKind::None));
        for (const int leafSize : {1, 3, 8})
            trees.emplace_back(fmt::format("midpoint, leaf size {}", leafSize),
                               hyalite::core::testing::packed(scene, TreeKind::Midpoint, leafSize));
        for (const int leafSize : {1, 4, 64})
            trees.emplace_back(fmt::format("sah, leaf size {}", leafSize),
                               hyalite::core::testing::packed(scene, TreeKind::Sah, leafSize));
        for (int i = 0; i < raysPerScene; ++i) {
            const Ray<float> ray = hostileRay(random, trees[0].second);
            const Hit<float> expected = nearestByDefinition(trees[0].second, ray);
            hitCount += expected.primitive != layout::noPrimitive ? 1 : 0;
            // Two trees a ray, in turn: 1.04e6 rays against all of them would take a minute.
            for (const std::size_t tree :
                 {static_cast<std::size_t>(i) % 7, (static_cast<std::size_t>(i) + 3) % 7}) {
                const Hit<float> hit = closestHit(trees[tree].second, ray);
                differences.check(isSameHit(hit, expected), [&] {
                    return fmt::format("{}, {}: {}, expected {} at {:a}", name, trees[tree].first,
                                       describe(ray, hit), expected.primitive, expected.distance);
                });
            }
        }
    }
    fmt::print("    {:.1f} % of the rays hit\n",
               100.0 * static_cast<double>(hitCount) / (13.0 * raysPerScene));
    EXPECT_GT(hitCount, 300'000u);
    differences.expectNone();
}

TEST(ClosestHit, IsTheSameToTheBitInDoubleToo) {
    Random random(106);
    Tally differences("tree against brute force in double", random.seed());
    for (const auto &[name, mesh] : hostileMeshes(random)) {
        const Scene scene = hyalite::core::testing::sceneOf(mesh);
        const PackedScene flat = hyalite::core::testing::packed(scene, TreeKind::None);
        const PackedScene tree = hyalite::core::testing::packed(scene, TreeKind::Sah, 2);
        for (int i = 0; i < 10'000; ++i) {
            const Ray<float> narrow = hostileRay(random, flat);
            const Ray<double> ray{narrow.origin, narrow.direction, narrow.excluded};
            const Hit<double> expected = closestHit(flat, ray);
            const Hit<double> hit = closestHit(tree, ray);
            differences.check(hit.primitive == expected.primitive && hit.distance == expected.distance,
                              [&] { return name; });
        }
    }
    differences.expectNone();
}

TEST(ShadowRay, IsBlockedExactlyWhereTheClosestHitIsNearer) {
    Random random(107);
    Tally differences("shadow rays that disagree with the closest hit", random.seed());
    for (const auto &[name, mesh] : hostileMeshes(random)) {
        const PackedScene scene = hyalite::core::testing::packed(
            hyalite::core::testing::sceneOf(mesh), random.coin() ? TreeKind::Sah : TreeKind::Midpoint,
            static_cast<int>(1 + random.below(8)));
        for (int i = 0; i < 30'000; ++i) {
            const Ray<float> ray = hostileRay(random, scene);
            const Hit<float> hit = closestHit(scene, ray);
            const float lengths[] = {hit.distance, std::nextafter(hit.distance, infinity),
                                     hit.distance * 0.5f, hit.distance * 2.0f,
                                     static_cast<float>(random.logUniform(1e-6, 1e6))};
            const float length = lengths[random.below(5)];
            const Shadow shadow = castShadowRay(scene, ray, length);
            const bool isNearer = hit.primitive != layout::noPrimitive && hit.distance < length;
            differences.check(shadow.isBlocked == isNearer && !shadow.isDimmed, [&] {
                return fmt::format("{}, length {:a}: {}", name, length, describe(ray, hit));
            });
        }
    }
    differences.expectNone();
}

TEST(ShadowRay, GlassDimsAndOpaqueBlocksWhateverTheOrder) {
    Random random(108);
    Tally differences("dimmed or blocked", random.seed());
    for (int trial = 0; trial < 200; ++trial) {
        Scene scene;
        scene.materials.resize(2);
        scene.materials[1].kind = MaterialKind::Dielectric;
        scene.meshes.push_back(hyalite::core::testing::triangleSoup(random, 6, 1.0, 1.0));
        scene.meshes.push_back(hyalite::core::testing::triangleSoup(random, 6, 1.0, 1.0));
        scene.meshes[1].materialIndex = 1;
        const PackedScene both = hyalite::core::testing::packed(scene, TreeKind::Sah, 1);
        std::swap(scene.meshes[1].triangles,
                  scene.meshes[0].triangles); // the same corners, the other material
        std::swap(scene.meshes[1].positions, scene.meshes[0].positions);
        const PackedScene swapped = hyalite::core::testing::packed(scene, TreeKind::Midpoint, 2);
        const auto isMet = [](const PackedScene &packed, const Ray<float> &ray, float length, bool isGlass) {
            const BoxRay<float> boxRay =
                makeBoxRay(ray.origin, ray.direction, packed.frame.boundsLower, packed.frame.boundsUpper);
            const TriangleRay<float> triangleRay = makeTriangleRay(ray.origin, ray.direction);
            return std::ranges::any_of(packed.triangles, [&](const layout::TriangleRecord &t) {
                const TriangleHit<float> hit = intersectTriangle(triangleRay, boxRay, t.v0, t.v1, t.v2);
                return hit.distance > 0 && hit.distance < length &&
                       ((t.flags & layout::triangleIsTransmissive) != 0) == isGlass;
            });
        };
        for (int i = 0; i < 500; ++i) {
            const Ray<float> ray{glm::vec3(random.inCube(2.0)), glm::vec3(random.direction())};
            const float length = static_cast<float>(random.uniform(0.0, 4.0));
            for (const PackedScene *packed : {&both, &swapped}) {
                const Shadow shadow = castShadowRay(*packed, ray, length);
                const bool isBlocked = isMet(*packed, ray, length, false);
                differences.check(shadow.isBlocked == isBlocked &&
                                  (isBlocked || shadow.isDimmed == isMet(*packed, ray, length, true)));
            }
        }
    }
    differences.expectNone();
}

TEST(ClosestHit, ATieGoesToTheSmallerId) {
    TriangleMesh mesh;
    for (int i = 0; i < 100; ++i)
        hyalite::core::testing::addTriangle(mesh, {-1, -1, -2}, {1, -1, -2}, {0, 1, -2});
    for (const TreeKind kind : {TreeKind::None, TreeKind::Midpoint, TreeKind::Sah}) {
        const PackedScene scene =
            hyalite::core::testing::packed(hyalite::core::testing::sceneOf(mesh), kind, 1);
        Ray<float> ray{{0, 0, 0}, {0, 0, -1}};
        EXPECT_EQ(closestHit(scene, ray).primitive, layout::minFirstTriangleId);
        EXPECT_EQ(closestHit(scene, ray).distance, 2.0f);
        ray.excluded = layout::minFirstTriangleId;
        EXPECT_EQ(closestHit(scene, ray).primitive, layout::minFirstTriangleId + 1);
    }
}

TEST(ClosestHit, SpheresComeBeforeTrianglesAndInTheirOrder) {
    Scene scene = hyalite::core::testing::sceneOf({});
    hyalite::core::testing::addTriangle(scene.meshes[0], {-1, -1, -2}, {1, -1, -2}, {0, 1, -2});
    scene.spheres.push_back({{0, 0, -30}, 1.0, 0, false});
    scene.spheres.push_back({{0, 0, -3}, 1.0, 0, false});
    scene.spheres.push_back({{0, 0, -3}, 1.0, 0, false});
    const Hit<float> hit =
        closestHit(hyalite::core::testing::packed(scene), Ray<float>{{0, 0, 0}, {0, 0, -1}});
    EXPECT_EQ(hit.primitive, 1u);
    EXPECT_EQ(hit.distance, 2.0f);
}

TEST(ClosestHit, AnEmptySceneIsNeverHit) {
    const PackedScene scene = hyalite::core::testing::packed(hyalite::core::testing::sceneOf({}));
    Random random(109);
    for (int i = 0; i < 1000; ++i) {
        const Ray<float> ray{glm::vec3(random.inCube(10.0)), glm::vec3(random.direction())};
        EXPECT_EQ(closestHit(scene, ray).primitive, layout::noPrimitive);
        EXPECT_FALSE(castShadowRay(scene, ray, 100.0f).isBlocked);
    }
}

// ---- One triangle

struct TriangleShot {
    glm::vec3 corners[3];
    glm::vec3 origin;
    glm::vec3 direction;
    BoxRay<float> boxRay;
    TriangleHit<float> hit;

    TriangleShot(const glm::vec3 &a, const glm::vec3 &b, const glm::vec3 &c, const glm::vec3 &from,
                 const glm::vec3 &to)
        : corners{a, b, c}, origin(from), direction(to),
          boxRay(makeBoxRay(from, to, glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c))),
          hit(intersectTriangle(makeTriangleRay(from, to), boxRay, a, b, c)) {}

    [[nodiscard]] std::string text() const {
        return fmt::format("{} {} {}, origin {}, direction {}: {:a} {:a} {:a}",
                           hyalite::core::testing::text(corners[0]), hyalite::core::testing::text(corners[1]),
                           hyalite::core::testing::text(corners[2]), hyalite::core::testing::text(origin),
                           hyalite::core::testing::text(direction), hit.distance, hit.u, hit.v);
    }
};

TEST(Triangle, IsHitFromBothSidesWithTheWeightsOfItsCorners) {
    for (const float side : {5.0f, -5.0f}) {
        const TriangleShot shot({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 2, side},
                                {0, 0, side > 0 ? -1.0f : 1.0f});
        EXPECT_EQ(shot.hit.distance, 5.0f);
        EXPECT_EQ(shot.hit.u, 0.25f); // of the first corner
        EXPECT_EQ(shot.hit.v, 0.25f); // of the second one
    }
}

TEST(Triangle, EdgesAndCornersBelongToIt) {
    const auto distanceAt = [](float x, float y) {
        return TriangleShot({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {x, y, 5}, {0, 0, -1}).hit.distance;
    };
    EXPECT_EQ(distanceAt(0, 0), 5.0f);
    EXPECT_EQ(distanceAt(4, 0), 5.0f);
    EXPECT_EQ(distanceAt(0, 4), 5.0f);
    EXPECT_EQ(distanceAt(2, 2), 5.0f);
    EXPECT_EQ(distanceAt(0, 3), 5.0f);
    EXPECT_EQ(distanceAt(-1e-5f, 1), 0.0f);
    EXPECT_EQ(distanceAt(2.00001f, 2), 0.0f);
    EXPECT_EQ(distanceAt(1, -1e-30f), 0.0f);
}

TEST(Triangle, WithoutAreaIsNeverHit) {
    EXPECT_EQ(TriangleShot({1, 1, 0}, {1, 1, 0}, {1, 1, 0}, {1, 1, 5}, {0, 0, -1}).hit.distance, 0.0f);
    EXPECT_EQ(TriangleShot({0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {1, 1, 5}, {0, 0, -1}).hit.distance, 0.0f);
    // Seen from its own plane it has no area either.
    EXPECT_EQ(TriangleShot({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {-5, 1, 0}, {1, 0, 0}).hit.distance, 0.0f);
}

TEST(Triangle, BehindTheOriginIsNeverHit) {
    // Behind by more than rounding, and by so little that only rounding decides: then the distance found, if any, is
    // within the box's pad of 0.
    Random random(110);
    Tally behind("triangles behind the origin that are hit", random.seed());
    Tally near("hits farther ahead than rounding explains", random.seed());
    for (int i = 0; i < 500'000; ++i) {
        const double scale = random.logUniform(1e-6, 1e6);
        const glm::vec3 a(random.inCube(scale));
        const glm::vec3 b(random.inCube(scale));
        const glm::vec3 c(random.inCube(scale));
        const double u = random.uniform();
        const double v = random.uniform() * (1.0 - u);
        const glm::dvec3 point = glm::dvec3(a) * u + glm::dvec3(b) * v + glm::dvec3(c) * (1.0 - u - v);
        const glm::dvec3 direction = random.direction();
        const glm::dvec3 normal =
            glm::normalize(glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)));
        const double cosine = std::abs(glm::dot(normal, direction));
        if (!(cosine > 0.1))
            continue;
        const TriangleShot far(a, b, c, glm::vec3(point + direction * (scale * random.logUniform(1e-4, 1e3))),
                               glm::vec3(direction));
        behind.check(far.hit.distance <= 0, [&] { return far.text(); });
        const TriangleShot close(a, b, c,
                                 glm::vec3(point + direction * (scale * random.logUniform(1e-12, 1e-4))),
                                 glm::vec3(direction));
        near.check(static_cast<double>(close.hit.distance) <= 2e-5 * scale, [&] { return close.text(); });
    }
    behind.expectNone();
    near.expectNone();
}

TEST(Triangle, TheDistanceLiesInTheIntervalOfItsOwnBox) {
    Random random(111);
    Tally outside("distances outside of the box's interval", random.seed());
    std::uint64_t hitCount = 0;
    for (int i = 0; i < 1'000'000; ++i) {
        const double scale = random.logUniform(1e-6, 1e6);
        const glm::dvec3 offset =
            random.coin() ? glm::dvec3(0.0) : random.inCube(scale * random.logUniform(1.0, 1e6));
        glm::vec3 corners[3];
        for (glm::vec3 &corner : corners)
            corner = glm::vec3(offset + random.inCube(scale));
        if (i % 4 == 0) // a flat box
            corners[1][i % 3] = corners[2][i % 3] = corners[0][i % 3];
        const double u = random.uniform();
        const double v = random.uniform() * (1.0 - u);
        const glm::dvec3 target =
            glm::dvec3(corners[0]) * u + glm::dvec3(corners[1]) * v + glm::dvec3(corners[2]) * (1.0 - u - v);
        const glm::vec3 origin(offset + random.inCube(scale * random.logUniform(0.5, 100.0)));
        if (glm::dvec3(origin) == target)
            continue;
        const TriangleShot shot(corners[0], corners[1], corners[2], origin,
                                glm::vec3(glm::normalize(target - glm::dvec3(origin))));
        if (!(shot.hit.distance > 0))
            continue;
        ++hitCount;
        const Vec2<float> interval =
            boxInterval(shot.boxRay, glm::min(glm::min(corners[0], corners[1]), corners[2]),
                        glm::max(glm::max(corners[0], corners[1]), corners[2]));
        outside.check(interval.x <= shot.hit.distance && shot.hit.distance <= interval.y,
                      [&] { return shot.text(); });
    }
    EXPECT_GT(hitCount, 800'000u);
    outside.expectNone();
}

/// Cramer's rule in long double, without any rounding that matters here.
struct ExactHit {
    long double distance;
    long double u;
    long double v;

    explicit ExactHit(const TriangleShot &shot) {
        const LongVec e1 = LongVec(shot.corners[0]) - LongVec(shot.corners[2]);
        const LongVec e2 = LongVec(shot.corners[1]) - LongVec(shot.corners[2]);
        const LongVec d(shot.direction);
        const LongVec s = LongVec(shot.origin) - LongVec(shot.corners[2]);
        const LongVec p = glm::cross(d, e2);
        const LongVec q = glm::cross(s, e1);
        const long double inverse = 1.0L / glm::dot(e1, p);
        distance = glm::dot(e2, q) * inverse;
        u = glm::dot(s, p) * inverse;
        v = glm::dot(d, q) * inverse;
    }
};

TEST(Triangle, IsAccurateToAFewRoundingsOfItsExtent) {
    // A corner's image is moved by at most 7 u M, M being the largest coordinate distance from the origin, and an edge
    // function rounds by u L^2, L being the longest edge, which needles feel most: with c the cosine of the angle to
    // the normal and h the least height, the distance is off by a few u (M + L^2/h) / c, and a weight by that / h.
    Random random(112);
    Tally wrongDistance("distances off by more than 16 u (M + L^2/h) / c", random.seed());
    Tally wrongWeight("weights off by more than 16 u (M + L^2/h) / (c h)", random.seed());
    double worstDistance = 0.0;
    double worstWeight = 0.0;
    for (int i = 0; i < 1'000'000; ++i) {
        const double scale = random.logUniform(1e-6, 1e6);
        const glm::dvec3 offset = random.inCube(scale * random.logUniform(1.0, 1e4));
        const glm::vec3 a(offset + random.inCube(scale));
        const glm::vec3 b(offset + random.inCube(scale));
        const glm::vec3 c(offset + random.inCube(scale));
        const double u = random.uniform(0.05, 0.9);
        const double v = random.uniform(0.05, 0.9) * (1.0 - u);
        const glm::dvec3 target = glm::dvec3(a) * u + glm::dvec3(b) * v + glm::dvec3(c) * (1.0 - u - v);
        const glm::vec3 origin(target + random.direction() * (scale * random.logUniform(1e-2, 1e3)));
        if (glm::dvec3(origin) == target)
            continue;
        const TriangleShot shot(a, b, c, origin, glm::vec3(glm::normalize(target - glm::dvec3(origin))));
        const glm::dvec3 area = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
        const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        const double height = glm::length(area) / longest;
        const double cosine = std::abs(glm::dot(glm::normalize(area), glm::dvec3(shot.direction)));
        glm::dvec3 reach(0.0);
        for (const glm::vec3 &corner : shot.corners)
            reach = glm::max(reach, glm::abs(glm::dvec3(corner) - glm::dvec3(origin)));
        const double unit = 0x1p-24 * (largestComponent(reach) + longest * longest / height) / cosine;
        if (!(unit < 1e-3 * height)) // ill-conditioned: nothing is promised
            continue;
        const ExactHit exact(shot);
        if (!(shot.hit.distance > 0)) {
            // Missed, or behind: only where the exact hit is at an edge, too.
            const long double least = std::min({exact.u, exact.v, 1.0L - exact.u - exact.v});
            wrongWeight.check(static_cast<double>(least) < 16.0 * unit / height ||
                                  exact.distance < 16.0 * unit,
                              [&] { return "missed: " + shot.text(); });
            continue;
        }
        const double distanceError = static_cast<double>(std::abs(shot.hit.distance - exact.distance)) / unit;
        const double weightError =
            static_cast<double>(std::max(std::abs(shot.hit.u - exact.u), std::abs(shot.hit.v - exact.v))) *
            height / unit;
        worstDistance = std::max(worstDistance, distanceError);
        worstWeight = std::max(worstWeight, weightError);
        wrongDistance.check(distanceError <= 16.0, [&] { return shot.text(); });
        wrongWeight.check(weightError <= 16.0, [&] { return shot.text(); });
    }
    fmt::print("    worst distance {:.2f} u (M + L^2/h) / c, worst weight {:.2f} of it / h\n", worstDistance,
               worstWeight);
    EXPECT_GT(wrongDistance.count(), 500'000u);
    wrongDistance.expectNone();
    wrongWeight.expectNone();
}

TEST(Triangle, RaysOfNanAndInfinityHitNothing) {
    Random random(113);
    Tally hits("NaN and infinite rays that hit something", random.seed());
    const PackedScene scenes[] = {
        hyalite::core::testing::packed(hyalite::core::testing::sceneOf(hyalite::core::testing::icosphere(2)),
                                       TreeKind::Sah, 2),
        hyalite::core::testing::packed(hyalite::core::testing::sceneOf(hyalite::core::testing::icosphere(2)),
                                       TreeKind::None),
        [] {
            Scene scene = hyalite::core::testing::sceneOf({});
            scene.spheres.push_back({{0, 0, 0}, 1.0, 0, false});
            scene.spheres.push_back({{3, 0, 0}, 1.0, 0, true});
            return hyalite::core::testing::packed(scene);
        }()};
    const float bad[] = {notANumber, infinity, -infinity};
    for (int i = 0; i < 200'000; ++i) {
        Ray<float> ray{glm::vec3(random.inCube(2.0)), glm::vec3(random.direction())};
        if (random.coin())
            ray.origin = latticePoint(random, 1);
        if (random.below(4) == 0)
            ray.direction = glm::vec3(latticePoint(random, 1));
        const bool isOriginBad = random.coin();
        glm::vec3 &vector = isOriginBad ? ray.origin : ray.direction;
        vector[static_cast<int>(random.below(3))] = bad[random.below(3)];
        if (random.coin())
            vector[static_cast<int>(random.below(3))] = bad[random.below(3)];
        const PackedScene &scene = scenes[random.below(3)];
        if (random.coin())
            ray.excluded = static_cast<std::uint32_t>(random.below(70));
        const Hit<float> hit = closestHit(scene, ray);
        hits.check(hit.primitive == layout::noPrimitive, [&] { return describe(ray, hit); });
        const Shadow shadow = castShadowRay(scene, ray, random.coin() ? 10.0f : bad[random.below(3)]);
        hits.check(!shadow.isBlocked && !shadow.isDimmed, [&] { return "shadow, " + describe(ray, hit); });
    }
    hits.expectNone();
}

TEST(Triangle, PointErrorBoundsTheRoundingOfThePoint) {
    // The bound holds for each coordinate, and along the normal, which is what offsetRayOrigin needs.
    Random random(114);
    Tally wrong("coordinates off by more than the bound", random.seed());
    Tally offPlane("points off their plane by more than the bound", random.seed());
    double worst = 0.0;
    double worstOffPlane = 0.0;
    for (int i = 0; i < 1'000'000; ++i) {
        const double scale = random.logUniform(1e-6, 1e6);
        const glm::dvec3 offset = random.inCube(scale * random.logUniform(1.0, 1e6));
        const glm::vec3 a(offset + random.inCube(scale));
        const glm::vec3 b(offset + random.inCube(scale));
        const glm::vec3 c(offset + random.inCube(scale));
        const float u = static_cast<float>(random.below(8) == 0 ? 0.0 : random.uniform());
        const float v = static_cast<float>(random.uniform() * (1.0 - static_cast<double>(u)));
        const long double w = 1.0L - static_cast<long double>(u) - static_cast<long double>(v);
        const glm::vec3 point = trianglePoint(a, b, c, u, v);
        const glm::vec3 bound = trianglePointError(a, b, c, u, v);
        const auto describePoint = [&] {
            return fmt::format("{} {} {} at {:a} {:a}", text(a), text(b), text(c), u, v);
        };
        const LongVec exact = LongVec(a) * static_cast<long double>(u) +
                              LongVec(b) * static_cast<long double>(v) + LongVec(c) * w;
        for (int axis = 0; axis < 3; ++axis) {
            const double error =
                static_cast<double>(std::abs(static_cast<long double>(point[axis]) - exact[axis]));
            if (bound[axis] > 0)
                worst = std::max(worst, error / static_cast<double>(bound[axis]));
            wrong.check(error <= static_cast<double>(bound[axis]), describePoint);
        }
        const LongVec area = glm::cross(LongVec(b) - LongVec(a), LongVec(c) - LongVec(a));
        if (glm::dot(area, area) == 0.0L)
            continue;
        const LongVec normal = glm::normalize(area);
        const double height = std::abs(static_cast<double>(glm::dot(normal, LongVec(point) - LongVec(a))));
        const double along = static_cast<double>(glm::dot(glm::abs(normal), LongVec(bound)));
        worstOffPlane = std::max(worstOffPlane, height / along);
        offPlane.check(height <= along, describePoint);
    }
    fmt::print("    worst coordinate: {:.3f} of the bound, worst height: {:.3f}\n", worst, worstOffPlane);
    wrong.expectNone();
    offPlane.expectNone();
}

} // namespace
} // namespace hyalite::core::reference
