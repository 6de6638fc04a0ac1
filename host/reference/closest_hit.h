// Nearest and any hits, in the plainest code: the kernels are checked against it.
//
// The nearest hit is defined without a tree: the smallest distance, and of equal distances the smallest primitive id.
#pragma once

#include "host/packing/packed_scene.h"
#include "host/reference/counting.h"
#include "host/reference/scene_view.h"

#include <array>
#include <cassert>

namespace hyalite::core::reference {

/// Random-number key of an alpha test: pixel, sample and ray.
struct AlphaTestKeys {
    glm::uvec2 pixel{0}; ///< of the whole image
    std::uint32_t sampleIndex = 0;
    /// As in alphaTestNumber(): twice the number of the segment, or 1 more for a shadow ray.
    std::uint32_t vertex = 0;
};

template <class Real> struct Ray {
    Vec3<Real> origin;
    Vec3<Real> direction;                         ///< unit length
    std::uint32_t excluded = layout::noPrimitive; ///< the primitive at the origin, which the ray cannot hit
    AlphaTestKeys keys{};
};

template <class Real> [[nodiscard]] Hit<Real> noHit() {
    return {std::numeric_limits<Real>::max(), layout::noPrimitive, 0, Real(0), Real(0), layout::noInstance};
}

/// Whether the triangle is not there for the ray: it is culled, or its alpha test fails.
template <class Real>
[[nodiscard]] bool isPassed(const SceneView<Real> &scene, const Ray<Real> &ray,
                            const TriangleRecord<Real> &triangle, std::uint32_t record,
                            const TriangleHit<Real> &hit) {
    if ((triangle.flags & layout::triangleIsCulled) != 0 && hit.isBehind)
        return true;
    if ((triangle.flags & layout::triangleIsAlphaTested) == 0)
        return false;
    const Real choice = alphaTestNumber<Real>(ray.keys.pixel, scene.frame.seed, ray.keys.sampleIndex,
                                              ray.keys.vertex, triangle.primitiveId);
    return isPassed<Real>(scene, triangle.materialIndex, record, hit.u, hit.v, choice);
}

template <class Real> [[nodiscard]] bool isSphere(const TriangleRecord<Real> &primitive) {
    return (primitive.flags & layout::triangleIsSphere) != 0;
}

/// A ray in the scene's tree or, if there are instances, in that of a mesh where an instance places it.
template <class Real, bool hasInstances, bool hasSpheres> class TreeRay {
  public:
    TreeRay(const SceneView<Real> &scene, const Ray<Real> &ray)
        : scene_(scene), ray_(ray),
          boxRay_(makeBoxRay(ray.origin, ray.direction, scene.frame.boundsLower, scene.frame.boundsUpper)),
          triangleRay_(makeTriangleRay(ray.origin, ray.direction)) {}

    /// An index of an instance, or layout::noInstance.
    [[nodiscard]] std::uint32_t instance() const { return instance_; }

    void enter(std::uint32_t instance) {
        instance_ = instance;
        if (instance == layout::noInstance)
            return;
        place_ = scene_.fetchInstance(instance);
        placedRay_ = makePlacedBoxRay(boxRay_, place_);
    }

    [[nodiscard]] Vec2<Real> interval(const Vec3<Real> &lower, const Vec3<Real> &upper) const {
        if (!hasInstances || instance_ == layout::noInstance)
            return boxInterval(boxRay_, lower, upper);
        return placedBoxInterval<Real>(placedRay_, Real(0.5) * (lower + upper), Real(0.5) * (upper - lower));
    }

    [[nodiscard]] TriangleRecord<Real> triangle(std::uint32_t record) const {
        const TriangleRecord<Real> triangle = scene_.fetchTriangle(record);
        return !hasInstances || instance_ == layout::noInstance ? triangle : placedTriangle(place_, triangle);
    }

    /// The distance is not positive where the ray does not hit the primitive.
    [[nodiscard]] TriangleHit<Real> meet(const TriangleRecord<Real> &primitive) const {
        const bool isExcluded = primitive.primitiveId == ray_.excluded;
        if (hasSpheres && isSphere(primitive)) {
            const Real distance =
                intersectBoxedSphere<Real>(boxRay_, ray_.direction, primitive.v0, primitive.v1.x, isExcluded);
            return {distance, Real(0), Real(0), false};
        }
        if (isExcluded)
            return {Real(0), Real(0), Real(0), false};
        return intersectTriangle(triangleRay_, boxRay_, primitive.v0, primitive.v1, primitive.v2);
    }

  private:
    const SceneView<Real> &scene_;
    const Ray<Real> &ray_;
    BoxRay<Real> boxRay_;
    TriangleRay<Real> triangleRay_;
    std::uint32_t instance_ = layout::noInstance;
    InstanceRecord<Real> place_{};
    PlacedBoxRay<Real> placedRay_{};
};

/// A triangle, or a sphere in the tree, that a ray hits.
template <class Real> struct Candidate {
    TriangleRecord<Real> triangle; ///< in world space
    std::uint32_t record;          ///< its index among the triangle or the sphere records
    std::uint32_t instance;        ///< or layout::noInstance
    TriangleHit<Real> hit;
};

/// visitTriangles of a scene with a tree. There is no code for what it does not hold: that for instances would take 5 %
/// of the time.
template <bool hasInstances, bool hasSpheres, class Real, class Counter, class Visitor>
[[gnu::flatten]] // GCC would call the triangle test in some builds and inline it in others: a quarter of the time
void visitTree(const SceneView<Real> &scene, const Ray<Real> &ray, const Real &reach, Counter &counter,
               const Visitor &visit) {
    TreeRay<Real, hasInstances, hasSpheres> treeRay(scene, ray);
    std::array<std::uint32_t, 2 * layout::maxTreeDepth + 1> waiting;
    std::size_t waitingCount = 0;
    waiting[waitingCount++] = 0;
    while (waitingCount > 0) {
        std::uint32_t subtree = waiting[--waitingCount];
        if (hasInstances && subtree == layout::leaveInstance) {
            treeRay.enter(layout::noInstance);
            continue;
        }
        if (hasInstances && layout::isInstance(subtree)) {
            treeRay.enter(layout::instanceOf(subtree));
            waiting[waitingCount++] = layout::leaveInstance;
            counter.waitSubtrees(waitingCount);
            subtree = scene.packed.instances[treeRay.instance()].root;
        }
        if ((subtree & layout::leafFlag) == 0) {
            const layout::NodePair &node = scene.packed.nodes[subtree];
            counter.visitNode(node);
            const Vec2<Real> left = treeRay.interval(node.leftLower, node.leftUpper);
            const Vec2<Real> right = treeRay.interval(node.rightLower, node.rightUpper);
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
            const TriangleRecord<Real> triangle = treeRay.triangle(record);
            counter.testTriangle();
            const TriangleHit<Real> hit = treeRay.meet(triangle);
            const std::uint32_t found = hasSpheres && isSphere(triangle) ? triangle.primitiveId : record;
            if (hit.distance > 0 && !isPassed(scene, ray, triangle, record, hit) &&
                !visit(Candidate<Real>{triangle, found, treeRay.instance(), hit}))
                return;
            if ((triangle.flags & layout::triangleEndsLeaf) != 0)
                break;
        }
    }
}

/// Calls visit(candidate) for every triangle that the ray hits, unless it passes it, in subtrees whose box it
/// enters at or before `reach`, which is read again at each node. `visit` returns false to stop. `counter` counts the
/// work.
template <class Real, class Counter, class Visitor>
void visitTriangles(const SceneView<Real> &scene, const Ray<Real> &ray, const Real &reach, Counter &counter,
                    const Visitor &visit) {
    if (scene.packed.treeSpheres != layout::treeHasTriangles)
        visitTree<true, true>(scene, ray, reach, counter, visit);
    else if (!scene.packed.instances.empty())
        visitTree<true, false>(scene, ray, reach, counter, visit);
    else if (scene.hasTriangles)
        visitTree<false, false>(scene, ray, reach, counter, visit);
}

template <class Real, class Counter>
[[nodiscard]] Hit<Real> closestHit(const SceneView<Real> &scene, const Ray<Real> &ray, Counter &counter) {
    Hit<Real> nearest = noHit<Real>();
    for (std::uint32_t i = 0; i < scene.sphereShapes.size(); ++i) {
        const std::uint32_t id = scene.packed.loopSpheres[i].primitiveId;
        const Real distance =
            intersectSphere(ray.origin, ray.direction, scene.sphereShapes[i], ray.excluded == id);
        if (distance > 0 && distance < nearest.distance)
            nearest = {distance, id, id, Real(0), Real(0), layout::noInstance};
    }
    visitTriangles(scene, ray, nearest.distance, counter, [&](const Candidate<Real> &found) {
        const TriangleHit<Real> &hit = found.hit;
        const std::uint32_t id = found.triangle.primitiveId;
        if (hit.distance < nearest.distance || (hit.distance == nearest.distance && id < nearest.primitive))
            nearest = {hit.distance, id, found.record, hit.u, hit.v, found.instance};
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
        const layout::SphereRecord &sphere = scene.packed.loopSpheres[i];
        const Real distance = intersectSphere(ray.origin, ray.direction, scene.sphereShapes[i],
                                              ray.excluded == sphere.primitiveId);
        if (!(distance > 0 && distance < length))
            continue;
        if (sphere.isTransmissive != 0)
            shadow.isDimmed = true;
        else
            shadow.isBlocked = true;
    }
    if (shadow.isBlocked)
        return shadow;
    visitTriangles(scene, ray, length, counter, [&](const Candidate<Real> &found) {
        if (!(found.hit.distance < length))
            return true;
        if ((found.triangle.flags & layout::triangleIsTransmissive) != 0)
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
        const std::uint32_t id = scene.packed.loopSpheres[i].primitiveId;
        const Real distance =
            intersectSphere(ray.origin, ray.direction, scene.sphereShapes[i], ray.excluded == id);
        isBlocked = isBlocked || (distance > 0 && distance < length && id != target);
    }
    if (isBlocked)
        return true;
    visitTriangles(scene, ray, length, counter, [&](const Candidate<Real> &found) {
        isBlocked = found.hit.distance < length && found.triangle.primitiveId != target;
        return !isBlocked;
    });
    return isBlocked;
}

} // namespace hyalite::core::reference
