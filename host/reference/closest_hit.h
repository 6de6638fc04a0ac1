// Nearest and any hits, in the plainest code: the kernels are checked against it.
//
// The nearest hit is defined without a tree: the smallest distance, and of equal distances the smallest primitive id.
#pragma once

#include "host/packing/packed_scene.h"
#include "host/reference/counting.h"
#include "host/reference/scene_view.h"

#include <array>
#include <cassert>

namespace hyalite::reference {

template <class Real> struct Ray {
    Vec3<Real> origin;
    Vec3<Real> direction;                         ///< unit length
    std::uint32_t excluded = layout::noPrimitive; ///< the primitive at the origin, which the ray cannot hit
};

template <class Real> struct Hit {
    Real distance = std::numeric_limits<Real>::max();
    std::uint32_t primitive = layout::noPrimitive; ///< its id
    std::uint32_t record = 0;                      ///< its index among the sphere or the triangle records
    Real u = 0;                                    ///< weights of a triangle's first and second vertex
    Real v = 0;
};

/// Whether the opacity texture cuts out the triangle at the hit.
template <class Real>
[[nodiscard]] bool isCutOut(const SceneView<Real> &scene, const layout::TriangleRecord &triangle,
                            std::uint32_t record, const TriangleHit<Real> &hit) {
    return (triangle.flags & layout::triangleIsCutOut) != 0 &&
           isCutAway<Real>(scene, triangle.materialIndex, record, hit.u, hit.v);
}

/// Calls visit(record, hit) for every triangle that the ray hits, unless it is cut out there, in subtrees whose box it
/// enters at or before `reach`, which is read again at each node. `visit` returns false to stop. `counter` counts the
/// work.
template <class Real, class Counter, class Visitor>
[[gnu::flatten]] // GCC would call the triangle test in some builds and inline it in others: a quarter of the time
void visitTriangles(const SceneView<Real> &scene, const Ray<Real> &ray, const Real &reach, Counter &counter,
                    Visitor &&visit) {
    if (!scene.hasTriangles)
        return;
    const BoxRay<Real> boxRay =
        makeBoxRay(ray.origin, ray.direction, scene.frame.boundsLower, scene.frame.boundsUpper);
    const TriangleRay<Real> triangleRay = makeTriangleRay(ray.origin, ray.direction);
    std::array<std::uint32_t, layout::maxTreeDepth + 1> waiting;
    std::size_t waitingCount = 0;
    waiting[waitingCount++] = 0;
    while (waitingCount > 0) {
        const std::uint32_t subtree = waiting[--waitingCount];
        if ((subtree & layout::leafFlag) == 0) {
            const layout::NodePair &node = scene.packed.nodes[subtree];
            counter.visitNode(node);
            const Vec2<Real> left =
                boxInterval(boxRay, Vec3<Real>(node.leftLower), Vec3<Real>(node.leftUpper));
            const Vec2<Real> right =
                boxInterval(boxRay, Vec3<Real>(node.rightLower), Vec3<Real>(node.rightUpper));
            const bool isLeftHit = node.left != layout::noNode && left.x <= lesser(left.y, reach);
            const bool isRightHit = node.right != layout::noNode && right.x <= lesser(right.y, reach);
            const bool isRightNearer = right.x < left.x;
            assert(waitingCount + 2 <= waiting.size());
            if (isRightHit && !isRightNearer)
                waiting[waitingCount++] = node.right;
            if (isLeftHit)
                waiting[waitingCount++] = node.left;
            if (isRightHit && isRightNearer)
                waiting[waitingCount++] = node.right;
            if (isLeftHit && isRightHit)
                counter.waitSubtrees(waitingCount - 1);
            continue;
        }
        for (std::uint32_t record = subtree & ~layout::leafFlag;; ++record) {
            const layout::TriangleRecord &triangle = scene.packed.triangles[record];
            counter.testTriangle();
            const TriangleHit<Real> hit = intersectTriangle(triangleRay, boxRay, Vec3<Real>(triangle.v0),
                                                            Vec3<Real>(triangle.v1), Vec3<Real>(triangle.v2));
            if (hit.distance > 0 && triangle.primitiveId != ray.excluded &&
                !isCutOut(scene, triangle, record, hit) && !visit(record, hit))
                return;
            if ((triangle.flags & layout::triangleEndsLeaf) != 0)
                break;
        }
    }
}

template <class Real, class Counter>
[[nodiscard]] Hit<Real> closestHit(const SceneView<Real> &scene, const Ray<Real> &ray, Counter &counter) {
    Hit<Real> nearest;
    for (std::uint32_t i = 0; i < scene.sphereShapes.size(); ++i) {
        const Real distance =
            intersectSphere(ray.origin, ray.direction, scene.sphereShapes[i], ray.excluded == i);
        if (distance > 0 && distance < nearest.distance)
            nearest = {distance, i, i};
    }
    visitTriangles(scene, ray, nearest.distance, counter,
                   [&](std::uint32_t record, const TriangleHit<Real> &hit) {
                       const std::uint32_t id = scene.packed.triangles[record].primitiveId;
                       if (hit.distance < nearest.distance ||
                           (hit.distance == nearest.distance && id < nearest.primitive))
                           nearest = {hit.distance, id, record, hit.u, hit.v};
                       return true;
                   });
    return nearest;
}

template <class Real> [[nodiscard]] Hit<Real> closestHit(const PackedScene &scene, const Ray<Real> &ray) {
    NoCounter counter;
    return closestHit(SceneView<Real>(scene), ray, counter);
}

/// Occlusion of a light.
struct Shadow {
    bool isBlocked = false; ///< by something opaque
    bool isDimmed = false;  ///< by glass; unspecified when blocked
};

/// Occlusion between the ray's origin and `length` along it.
template <class Real, class Counter>
[[nodiscard]] Shadow castShadowRay(const SceneView<Real> &scene, const Ray<Real> &ray, const Real &length,
                                   Counter &counter) {
    Shadow shadow;
    for (std::uint32_t i = 0; i < scene.sphereShapes.size(); ++i) {
        const Real distance =
            intersectSphere(ray.origin, ray.direction, scene.sphereShapes[i], ray.excluded == i);
        if (!(distance > 0 && distance < length))
            continue;
        if (scene.packed.spheres[i].isTransmissive != 0)
            shadow.isDimmed = true;
        else
            shadow.isBlocked = true;
    }
    if (shadow.isBlocked)
        return shadow;
    visitTriangles(scene, ray, length, counter, [&](std::uint32_t record, const TriangleHit<Real> &hit) {
        if (!(hit.distance < length))
            return true;
        if ((scene.packed.triangles[record].flags & layout::triangleIsTransmissive) != 0)
            shadow.isDimmed = true;
        else
            shadow.isBlocked = true;
        return !shadow.isBlocked;
    });
    return shadow;
}

template <class Real>
[[nodiscard]] Shadow castShadowRay(const PackedScene &scene, const Ray<Real> &ray, const Real &length) {
    NoCounter counter;
    return castShadowRay(SceneView<Real>(scene), ray, length, counter);
}

/// Whether anything, including glass but not the primitive `target`, is between the ray's origin and `length` along it.
template <class Real, class Counter>
[[nodiscard]] bool isAnythingBefore(const SceneView<Real> &scene, const Ray<Real> &ray, const Real &length,
                                    std::uint32_t target, Counter &counter) {
    bool isBlocked = false;
    for (std::uint32_t i = 0; i < scene.sphereShapes.size(); ++i) {
        const Real distance =
            intersectSphere(ray.origin, ray.direction, scene.sphereShapes[i], ray.excluded == i);
        isBlocked = isBlocked || (distance > 0 && distance < length && i != target);
    }
    if (isBlocked)
        return true;
    visitTriangles(scene, ray, length, counter, [&](std::uint32_t record, const TriangleHit<Real> &hit) {
        isBlocked = hit.distance < length && scene.packed.triangles[record].primitiveId != target;
        return !isBlocked;
    });
    return isBlocked;
}

} // namespace hyalite::reference
