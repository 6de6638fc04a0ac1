#include "tests/fixtures/leaves.h"

#include "host/reference/closest_hit.h"
#include "tests/fixtures/geometry_fixture.h"

#include <optional>

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::Random;
using hyalite::core::testing::Tally;
using hyalite::core::testing::text;

/// A unit cube with its corner at the origin, outward normals.
TriangleMesh unitCube() {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < 8; ++i)
        mesh.positions.push_back({i & 1u, i >> 1 & 1u, i >> 2 & 1u});
    for (const glm::uvec3 &corner : std::initializer_list<glm::uvec3>{{0, 2, 1},
                                                                      {1, 2, 3},
                                                                      {4, 5, 6},
                                                                      {5, 7, 6},
                                                                      {0, 4, 2},
                                                                      {2, 4, 6},
                                                                      {1, 3, 5},
                                                                      {3, 7, 5},
                                                                      {0, 1, 4},
                                                                      {1, 5, 4},
                                                                      {2, 6, 3},
                                                                      {3, 6, 7}})
        mesh.triangles.push_back({corner});
    return mesh;
}

/// Where a ray meets a triangle, and the unit normal of the triangle in double.
struct Landing {
    std::uint32_t record;
    std::uint32_t primitive;
    Surface<float> surface;
    glm::dvec3 normal;
};

glm::dvec3 exactNormal(const layout::TriangleRecord &t) {
    return glm::normalize(
        glm::cross(glm::dvec3(t.v1) - glm::dvec3(t.v0), glm::dvec3(t.v2) - glm::dvec3(t.v0)));
}

std::optional<Landing> land(const PackedScene &scene, Random &random, double size) {
    const layout::TriangleRecord &aimed = scene.triangles[random.below(scene.triangles.size())];
    const double u = random.uniform();
    const double v = random.uniform() * (1.0 - u);
    const glm::dvec3 target =
        glm::dvec3(aimed.v0) * u + glm::dvec3(aimed.v1) * v + glm::dvec3(aimed.v2) * (1.0 - u - v);
    const glm::vec3 origin(target + random.direction() * (size * random.logUniform(1e-2, 1e2)));
    if (glm::dvec3(origin) == target)
        return std::nullopt;
    const Ray<float> ray{origin, glm::vec3(glm::normalize(target - glm::dvec3(origin)))};
    const Hit<float> hit = closestHit(scene, ray);
    if (hit.primitive == layout::noPrimitive)
        return std::nullopt;
    const layout::TriangleRecord &triangle = scene.triangles[hit.record];
    return Landing{hit.record, hit.primitive,
                   triangleSurface<float>(triangle, scene.normals[hit.record], hit.u, hit.v),
                   exactNormal(triangle)};
}

glm::vec3 leavingDirection(Random &random, const glm::dvec3 &normal, double minCosine) {
    for (;;) {
        const glm::dvec3 any = random.direction();
        if (std::abs(glm::dot(any, normal)) > minCosine)
            return glm::vec3(glm::dot(any, normal) < 0 ? -any : any);
    }
}

TEST(OffsetRayOrigin, ARayLeavingAConvexMeshNeverMeetsItAgain) {
    // The shapes stay convex when their corners are rounded. With the triangle that the ray starts on excluded, and
    // without: the offset alone suffices.
    Random random(601);
    Tally again("convex spawns that meet the mesh again", random.seed());
    Tally againUnexcluded("the same without exclusion", random.seed());
    std::vector<std::pair<PackedScene, double>> meshes;
    for (const TriangleMesh &mesh : {hyalite::core::testing::tetrahedron(), unitCube()}) {
        for (const auto &[scale, offset] : {std::pair(1.0, glm::dvec3(0.0)),
                                            {1.0, {1e3, -1e3, 1e3}},
                                            {64.0, {1e6, 2e6, -1e6}},
                                            {1e-6, {0, 0, 0}},
                                            {1e-6, {1e-3, 0, 0}},
                                            {1e6, {0, 0, 0}},
                                            {1e6, {1e8, 0, 1e7}},
                                            {1e-6, {-1, 0, 0}}})
            meshes.emplace_back(hyalite::core::testing::packed(hyalite::core::testing::sceneOf(
                                    hyalite::core::testing::placed(mesh, scale, offset))),
                                scale);
    }
    while (again.count() < 1'000'000) {
        const auto &[scene, scale] = meshes[random.below(meshes.size())];
        const std::optional<Landing> landing = land(scene, random, scale);
        if (!landing)
            continue;
        const glm::vec3 direction = leavingDirection(random, landing->normal, 1e-5);
        Surface<float> surface = landing->surface;
        const glm::vec3 origin = offsetRayOrigin(surface, direction);
        const auto describe = [&] {
            return fmt::format("size {}, from {} along {}", scale, text(origin), text(direction));
        };
        again.check(closestHit(scene, Ray<float>{origin, direction, landing->primitive}).primitive ==
                        layout::noPrimitive,
                    describe);
        againUnexcluded.check(
            closestHit(scene, Ray<float>{origin, direction}).primitive == layout::noPrimitive, describe);
    }
    again.expectNone();
    againUnexcluded.expectNone();
}

TEST(OffsetRayOrigin, ARayIntoAConvexMeshMeetsItsOtherSide) {
    Random random(602);
    Tally wrong("rays into a cube that do not come out where they should", random.seed());
    for (const auto &[scale, offset] :
         {std::pair(1.0, glm::dvec3(0.0)), {1.0, {1e3, -1e3, 1e3}}, {1e6, {0, 0, 0}}, {1e-6, {0, 0, 0}}}) {
        const PackedScene scene = hyalite::core::testing::packed(
            hyalite::core::testing::sceneOf(hyalite::core::testing::placed(unitCube(), scale, offset)));
        for (int i = 0; i < 100'000; ++i) {
            const std::optional<Landing> landing = land(scene, random, scale);
            if (!landing)
                continue;
            const glm::vec3 direction = -leavingDirection(random, landing->normal, 1e-3);
            const glm::vec3 origin = offsetRayOrigin(landing->surface, direction);
            const Hit<float> hit = closestHit(scene, Ray<float>{origin, direction, landing->primitive});
            // Where the ray leaves the cube, from the slabs.
            double leave = std::numeric_limits<double>::infinity();
            for (int axis = 0; axis < 3; ++axis) {
                if (direction[axis] == 0.0f)
                    continue;
                const double face =
                    direction[axis] > 0 ? scene.frame.boundsUpper[axis] : scene.frame.boundsLower[axis];
                leave = std::min(leave, (face - static_cast<double>(origin[axis])) /
                                            static_cast<double>(direction[axis]));
            }
            // Next to an edge rounding tells whether the ray is in at all.
            const double slack = 1e-3 * scale;
            int facesNear = 0;
            for (int axis = 0; axis < 3; ++axis)
                facesNear += std::min(std::abs(origin[axis] - scene.frame.boundsLower[axis]),
                                      std::abs(origin[axis] - scene.frame.boundsUpper[axis])) <
                                     static_cast<float>(slack)
                                 ? 1
                                 : 0;
            if (leave < slack || facesNear > 1)
                continue;
            wrong.check(hit.primitive != layout::noPrimitive &&
                            std::abs(static_cast<double>(hit.distance) - leave) < slack,
                        [&] {
                            return fmt::format("size {}, from {} along {}: {} not {}", scale, text(origin),
                                               text(direction), hit.distance, leave);
                        });
        }
    }
    wrong.expectNone();
}

TEST(OffsetRayOrigin, AFloorOfManyTrianglesDoesNotShadowItself) {
    // Floors parallel to two axes, close to the third one's 0 compared with their extent: the rounding of a point's
    // height is next to nothing then, that of the distance to the neighbour in the same plane is not.
    Random random(605);
    Tally anywhere("points of a floor in its own shadow", random.seed());
    Tally atEdges("points at the edges of a floor's triangles in its own shadow", random.seed());
    for (const double height : {0.0, 1e-3, 0.5, 100.0}) {
        for (const double extent : {1.0, 10.0, 1000.0}) {
            for (const int cells : {1, 16}) {
                TriangleMesh mesh;
                const float side = static_cast<float>(2.0 * extent / cells);
                for (int i = 0; i < cells; ++i)
                    for (int k = 0; k < cells; ++k)
                        hyalite::core::testing::addQuad(
                            mesh,
                            {-static_cast<float>(extent) + static_cast<float>(i) * side,
                             static_cast<float>(height),
                             -static_cast<float>(extent) + static_cast<float>(k) * side},
                            {0, 0, side}, {side, 0, 0});
                const PackedScene scene =
                    hyalite::core::testing::packed(hyalite::core::testing::sceneOf(mesh));
                for (int i = 0; i < 20'000; ++i) {
                    const bool isAtEdge = random.coin();
                    const layout::TriangleRecord &aimed =
                        scene.triangles[random.below(scene.triangles.size())];
                    const glm::dvec3 target =
                        isAtEdge ? glm::mix(glm::dvec3(aimed.v0), glm::dvec3(aimed.v2), random.uniform())
                                 : glm::dvec3(random.uniform(-extent, extent), height,
                                              random.uniform(-extent, extent));
                    const glm::vec3 eye(random.uniform(-extent, extent),
                                        height + extent * random.uniform(0.1, 1.0),
                                        random.uniform(-extent, extent));
                    const Ray<float> ray{eye, glm::vec3(glm::normalize(target - glm::dvec3(eye)))};
                    const Hit<float> hit = closestHit(scene, ray);
                    if (hit.primitive == layout::noPrimitive) // past the rim
                        continue;
                    const Surface<float> surface = triangleSurface<float>(
                        scene.triangles[hit.record], scene.normals[hit.record], hit.u, hit.v);
                    const glm::dvec3 light(random.uniform(-extent, extent), height + extent,
                                           random.uniform(-extent, extent));
                    const glm::vec3 toLight(glm::normalize(light - glm::dvec3(surface.position)));
                    const Ray<float> shadowRay{offsetRayOrigin(surface, toLight), toLight, hit.primitive};
                    (isAtEdge ? atEdges : anywhere)
                        .check(!castShadowRay(scene, shadowRay, static_cast<float>(extent)).isBlocked, [&] {
                            return fmt::format("height {}, extent {}, {} cells: from {} along {}", height,
                                               extent, cells, text(shadowRay.origin), text(toLight));
                        });
                }
            }
        }
    }
    anywhere.expectNone();
    atEdges.expectNone();
}

TEST(OffsetRayOrigin, LeavesAnyTriangleOnTheSideThatTheRayGoesTo) {
    // Triangles of any size and place; how far they are from being slivers is their height over their longest side.
    Random random(603);
    Tally wrongSide("spawn points on the wrong side of the plane", random.seed());
    Tally excluded("rays that meet the excluded triangle that they leave", random.seed());
    Tally unexcluded("rays that meet the triangle that they leave, without exclusion", random.seed());
    Tally far("spawn points farther off than 64 u of the coordinates", random.seed());
    while (wrongSide.count() < 1'000'000) {
        const double scale = random.logUniform(1e-6, 1e6);
        const double reach = scale * random.logUniform(1.0, 1e4);
        PackedScene scene;
        scene.hasTriangles = true;
        const glm::dvec3 centre = random.inCube(reach);
        layout::TriangleRecord triangle{};
        triangle.v0 = glm::vec3(centre + random.inCube(scale));
        triangle.v1 = glm::vec3(centre + random.inCube(scale));
        triangle.v2 = glm::vec3(centre + random.inCube(scale));
        triangle.primitiveId = layout::minFirstTriangleId;
        triangle.flags = layout::triangleEndsLeaf;
        const double longest = std::max({glm::distance(glm::dvec3(triangle.v0), glm::dvec3(triangle.v1)),
                                         glm::distance(glm::dvec3(triangle.v1), glm::dvec3(triangle.v2)),
                                         glm::distance(glm::dvec3(triangle.v2), glm::dvec3(triangle.v0))});
        const double height = glm::length(glm::cross(glm::dvec3(triangle.v1) - glm::dvec3(triangle.v0),
                                                     glm::dvec3(triangle.v2) - glm::dvec3(triangle.v0))) /
                              longest;
        if (!(height > 1e-2 * longest))
            continue;
        scene.triangles.push_back(triangle);
        scene.normals.push_back({});
        layout::NodePair root{};
        root.leftLower = scene.frame.boundsLower = glm::min(glm::min(triangle.v0, triangle.v1), triangle.v2);
        root.leftUpper = scene.frame.boundsUpper = glm::max(glm::max(triangle.v0, triangle.v1), triangle.v2);
        root.left = layout::leafFlag;
        root.right = layout::noNode;
        scene.nodes.push_back(root);
        const std::optional<Landing> landing = land(scene, random, scale);
        if (!landing)
            continue;
        const glm::vec3 outward = leavingDirection(random, landing->normal, 1e-4);
        const glm::vec3 direction = random.coin() ? outward : -outward; // both sides
        const double side = glm::dot(glm::dvec3(direction), landing->normal) > 0 ? 1.0 : -1.0;
        const glm::vec3 origin = offsetRayOrigin(landing->surface, direction);
        const auto describe = [&] {
            return fmt::format("{} {} {}, from {} along {}, height/length {}", text(triangle.v0),
                               text(triangle.v1), text(triangle.v2), text(origin), text(direction),
                               height / longest);
        };
        const double above = side * glm::dot(glm::dvec3(origin) - glm::dvec3(triangle.v0), landing->normal);
        wrongSide.check(above >= 0.0, describe);
        far.check(above <= 64.0 * 0x1p-24 * (2.0 * (reach + scale)), describe);
        excluded.check(closestHit(scene, Ray<float>{origin, direction, landing->primitive}).primitive ==
                           layout::noPrimitive,
                       describe);
        unexcluded.check(closestHit(scene, Ray<float>{origin, direction}).primitive == layout::noPrimitive,
                         describe);
    }
    wrongSide.expectNone();
    far.expectNone();
    excluded.expectNone();
    unexcluded.expectNone();
}

// ---- Normals

layout::TriangleRecord triangleOf(const glm::vec3 &a, const glm::vec3 &b, const glm::vec3 &c) {
    layout::TriangleRecord triangle{};
    triangle.v0 = a;
    triangle.v1 = b;
    triangle.v2 = c;
    return triangle;
}

TEST(TriangleSurface, TheGeometricNormalFollowsTheWinding) {
    const layout::NormalRecord none{};
    const Surface<float> front =
        triangleSurface<float>(triangleOf({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), none, 0.25f, 0.25f);
    EXPECT_EQ(front.geometricNormal, glm::vec3(0, 0, 1)) << "counter-clockwise seen from +z";
    EXPECT_EQ(front.normal, glm::vec3(0, 0, 1));
    EXPECT_EQ(front.position, glm::vec3(0.25f, 0.5f, 0));
    const Surface<float> back =
        triangleSurface<float>(triangleOf({0, 0, 0}, {0, 1, 0}, {1, 0, 0}), none, 0.25f, 0.25f);
    EXPECT_EQ(back.geometricNormal, glm::vec3(0, 0, -1));
    for (const layout::TriangleRecord &t :
         hyalite::core::testing::packed(hyalite::core::testing::sceneOf(unitCube())).triangles) {
        const Surface<float> surface = triangleSurface<float>(t, none, 0.3f, 0.3f);
        EXPECT_GT(glm::dot(surface.normal, surface.position - glm::vec3(0.5f)), 0.0f);
    }
}

TEST(TriangleSurface, SmoothNormalsAreBlendedAndOfUnitLength) {
    Random random(604);
    Tally wrong("blended normals unlike the blend", random.seed());
    for (int i = 0; i < 100'000; ++i) {
        const layout::TriangleRecord triangle =
            triangleOf(glm::vec3(random.inCube(1)), glm::vec3(random.inCube(1)), glm::vec3(random.inCube(1)));
        const glm::dvec3 around = random.direction();
        layout::NormalRecord normals{};
        normals.n0 = glm::vec3(glm::normalize(around + random.inCube(0.3)));
        normals.n1 = glm::vec3(glm::normalize(around + random.inCube(0.3)));
        normals.n2 = glm::vec3(glm::normalize(around + random.inCube(0.3)));
        const float u = static_cast<float>(random.uniform());
        const float v = static_cast<float>(random.uniform()) * (1.0f - u);
        const Surface<float> surface = triangleSurface<float>(triangle, normals, u, v);
        const double w = 1.0 - static_cast<double>(u) - static_cast<double>(v);
        const glm::dvec3 blend =
            glm::normalize(glm::dvec3(normals.n0) * static_cast<double>(u) +
                           glm::dvec3(normals.n1) * static_cast<double>(v) + glm::dvec3(normals.n2) * w);
        wrong.check(glm::distance(glm::dvec3(surface.normal), blend) < 1e-6 &&
                    std::abs(glm::length(glm::dvec3(surface.geometricNormal)) - 1.0) < 3e-7);
        // The geometric normal is turned to the side of the shading normal.
        wrong.check(dotProduct(surface.geometricNormal, surface.normal) >= 0 &&
                    std::abs(std::abs(glm::dot(glm::dvec3(surface.geometricNormal), exactNormal(triangle))) -
                             1.0) < 1e-3);
    }
    wrong.expectNone();
}

TEST(TriangleSurface, NormalsThatCancelFallBackToTheGeometricOne) {
    const layout::TriangleRecord triangle = triangleOf({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    layout::NormalRecord normals{};
    normals.n0 = {1, 0, 0};
    normals.n1 = {-1, 0, 0};
    normals.n2 = {0, 1, 0};
    EXPECT_EQ(triangleSurface<float>(triangle, normals, 0.5f, 0.5f).normal, glm::vec3(0, 0, 1));
    EXPECT_EQ(triangleSurface<float>(triangle, layout::NormalRecord{}, 0.5f, 0.25f).normal,
              glm::vec3(0, 0, 1));
}

TEST(TriangleSurface, WithoutAreaHasNoNormalAndNoNan) {
    const Surface<float> surface = triangleSurface<float>(triangleOf({1, 1, 1}, {1, 1, 1}, {2, 2, 2}),
                                                          layout::NormalRecord{}, 0.5f, 0.25f);
    EXPECT_EQ(surface.geometricNormal, glm::vec3(0.0f));
    EXPECT_EQ(surface.normal, glm::vec3(0.0f));
    EXPECT_EQ(offsetRayOrigin(surface, {0, 0, 1}), surface.position);
}

TEST(TriangleSurface, HasAUnitNormalAtEverySizeThatASceneMayHave) {
    // Coordinates go up to 1e15 and framed meshes down to a diagonal of 1e-12: neither may turn black.
    for (int exponent = -14; exponent <= 15; ++exponent) {
        const float size = std::pow(10.0f, static_cast<float>(exponent));
        const Surface<float> surface = triangleSurface<float>(
            triangleOf({0, 0, 0}, {size, 0, 0}, {0, size, 0}), layout::NormalRecord{}, 0.25f, 0.25f);
        EXPECT_NEAR(surface.geometricNormal.z, 1.0f, 1e-6f) << "size " << size;
        const Surface<double> wide = triangleSurface<double>(
            triangleOf({0, 0, 0}, {size, 0, 0}, {0, size, 0}), layout::NormalRecord{}, 0.25, 0.25);
        EXPECT_NEAR(wide.geometricNormal.z, 1.0, 1e-12) << "size " << size;
    }
}

} // namespace
} // namespace hyalite::core::reference
