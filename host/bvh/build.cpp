#include "host/base/error.h"
#include "host/bvh/bvh.h"
#include "host/bvh/duplicates.h"
#include "host/bvh/joined_triangles.h"
#include "host/bvh/split.h"
#include "host/bvh/tree_spheres.h"
#include "host/leaves/leaves.h"
#include "host/scene/instances.h"
#include "shaders/layout/layout.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <exception>
#include <memory>
#include <utility>

namespace hyalite::core {

namespace {

constexpr std::uint32_t noInstances = std::numeric_limits<std::uint32_t>::max();

/// Halving is forced once nothing else can keep the tree within the depth of the traversal stack.
bool mustHalve(std::size_t count, int depth) {
    constexpr int deepest = static_cast<int>(layout::maxTreeDepth) - 1;
    return depth + static_cast<int>(std::bit_width(count)) >= deepest;
}

/// A node whose range of triangles is still to be divided.
struct Task {
    std::uint32_t node;
    std::uint32_t begin;
    std::uint32_t end;
    int depth; ///< inner nodes above

    [[nodiscard]] std::size_t size() const { return end - begin; }

    [[nodiscard]] Task child(std::uint32_t childNode, std::uint32_t childBegin,
                             std::uint32_t childEnd) const {
        return {childNode, childBegin, childEnd, depth + 1};
    }
};

/// A part of the tree during the build: a leaf, an inner node with two branches, or a whole subtree in one array.
struct Branch {
    BvhNode node;                 ///< complete for a leaf
    std::unique_ptr<Branch> left; ///< null if the subtree is in `below`
    std::unique_ptr<Branch> right;
    std::vector<BvhNode> below; ///< numbered from 0
    int deepest = 0;            ///< inner nodes above its deepest leaf
};

/// Builds large branches as OpenMP tasks and small ones serially. The division depends on the triangles only, and so
/// does the tree; the thread count has no influence.
class Builder {
  public:
    /// Input indices from `firstInstance` on are those of instances.
    Builder(TreeKind kind, std::span<BuildTriangle> triangles, const JoinedItems &isJoined,
            std::uint32_t firstInstance, int leafSize)
        : kind_(kind), triangles_(triangles), isJoined_(isJoined), firstInstance_(firstInstance),
          leafSize_(static_cast<std::size_t>(leafSize)) {}

    Bvh build() {
        const auto count = static_cast<std::uint32_t>(triangles_.size());
        Branch root;
#pragma omp parallel if (count > smallBranch)
#pragma omp single
        grow(root, {rootNode, 0, count, 0});
        if (failure_)
            std::rethrow_exception(failure_);
        Bvh bvh;
        bvh.depth = depthOf(root);
        bvh.nodes.resize(nodeCountOf(root));
#pragma omp parallel if (count > smallBranch)
#pragma omp single
        join(root, 0, 1, bvh.nodes);
        return bvh;
    }

  private:
    static constexpr std::uint32_t smallBranch = 4096; ///< triangles

    [[nodiscard]] std::span<BuildTriangle> trianglesOf(const Task &task) const {
        return triangles_.subspan(task.begin, task.size());
    }

    /// An instance, or a pair of triangles, has a leaf of its own.
    [[nodiscard]] std::size_t leafSizeFor(std::span<const BuildTriangle> range) const {
        const auto isAlone = [&](const BuildTriangle &triangle) {
            return triangle.inputIndex >= firstInstance_ || isPair(isJoined_, triangle);
        };
        return range.size() <= leafSize_ && std::ranges::any_of(range, isAlone) ? 1 : leafSize_;
    }

    [[nodiscard]] std::size_t split(std::span<BuildTriangle> range, const RangeBounds &bounds) const {
        return kind_ == TreeKind::Sah ? splitBySah(range, bounds, leafSizeFor(range))
                                      : splitAtMidpoint(range, bounds.triangles.box(), leafSizeFor(range));
    }

    /// Finds the task's box and reorders its triangles; returns where the right child's begin, or the task's begin for
    /// a leaf.
    std::uint32_t divide(Box &box, const Task &task) const {
        const RangeBounds bounds(trianglesOf(task));
        box = bounds.triangles.box();
        std::size_t leftCount = 0;
        if (task.size() > 1 && !mustHalve(task.size(), task.depth))
            leftCount = split(trianglesOf(task), bounds);
        if (leftCount == 0 && task.size() > leafSizeFor(trianglesOf(task)))
            leftCount = splitAtMedian(trianglesOf(task), box);
        return task.begin + static_cast<std::uint32_t>(leftCount);
    }

    /// Exceptions leave a task only through failure_.
    void grow(Branch &branch, const Task &task) {
        try {
            if (task.size() <= smallBranch)
                growInOnePiece(branch, task);
            else
                growInTwo(branch, task);
        } catch (...) {
#pragma omp critical(hyaliteBuildFailure)
            failure_ = std::current_exception();
        }
    }

    void growInTwo(Branch &branch, const Task &task) {
        branch.deepest = task.depth;
        const std::uint32_t middle = divide(branch.node.box, task);
        if (middle == task.begin) {
            branch.node.first = task.begin;
            branch.node.count = task.end - task.begin;
            return;
        }
        branch.left = std::make_unique<Branch>();
        branch.right = std::make_unique<Branch>();
        Branch *const left = branch.left.get();
        const Task leftTask = task.child(rootNode, task.begin, middle);
        const Task rightTask = task.child(rootNode, middle, task.end);
#pragma omp task default(none) firstprivate(left, leftTask)
        grow(*left, leftTask);
        grow(*branch.right, rightTask);
    }

    /// Depth-first with an explicit stack.
    void growInOnePiece(Branch &branch, const Task &whole) const {
        // The root of the branch is in front while its children are numbered from 0.
        std::vector<BvhNode> &nodes = branch.below;
        std::vector<Task> tasks{whole};
        while (!tasks.empty()) {
            const Task task = tasks.back();
            tasks.pop_back();
            branch.deepest = std::max(branch.deepest, task.depth);
            const auto node = [&]() -> BvhNode & {
                return task.node == rootNode ? branch.node : nodes[task.node];
            };
            const std::uint32_t middle = divide(node().box, task);
            if (middle == task.begin) {
                node().first = task.begin;
                node().count = task.end - task.begin;
                continue;
            }
            const auto left = static_cast<std::uint32_t>(nodes.size());
            node().first = left;
            const Task leftTask = task.child(left, task.begin, middle);
            const Task rightTask = task.child(left + 1, middle, task.end);
            nodes.resize(nodes.size() + 2);
            tasks.push_back(rightTask);
            tasks.push_back(leftTask);
        }
    }

    static std::size_t nodeCountOf(const Branch &branch) {
        return branch.left ? 1 + nodeCountOf(*branch.left) + nodeCountOf(*branch.right)
                           : 1 + branch.below.size();
    }

    static int depthOf(const Branch &branch) {
        return branch.left ? std::max(depthOf(*branch.left), depthOf(*branch.right)) : branch.deepest;
    }

    /// Numbers the nodes of a branch depth first: its root goes into `slot`, the others to `first` and beyond. Large
    /// branches are tasks.
    static void join(Branch &branch, std::uint32_t slot, std::uint32_t first, std::span<BvhNode> nodes) {
        if (!branch.node.isLeaf())
            branch.node.first = first;
        nodes[slot] = branch.node;
        if (branch.left) {
            Branch *const left = branch.left.get();
            // It shrinks as it is joined.
            const auto leftCount = static_cast<std::uint32_t>(nodeCountOf(*left));
#pragma omp task default(none) firstprivate(left, first, nodes)
            join(*left, first, first + 2, nodes);
            join(*branch.right, first + 1, first + 1 + leftCount, nodes);
            return;
        }
        std::uint32_t at = first;
        for (BvhNode node : branch.below) {
            if (!node.isLeaf())
                node.first += first;
            nodes[at++] = node;
        }
        branch.below = {};
    }

    static constexpr std::uint32_t rootNode = std::numeric_limits<std::uint32_t>::max();

    TreeKind kind_;
    std::span<BuildTriangle> triangles_;
    const JoinedItems &isJoined_;
    std::uint32_t firstInstance_;
    std::size_t leafSize_;
    std::exception_ptr failure_; ///< of any task
};

/// Fills bvh.order, and counts in leaves both triangles of a pair.
void orderTriangles(std::span<const BuildTriangle> items, const JoinedItems &isJoined, Bvh &bvh) {
    bvh.order.reserve(isJoined.empty() ? items.size() : 2 * items.size());
    std::vector<std::uint32_t> positions; // in the order
    positions.reserve(items.size() + 1);
    for (const BuildTriangle &item : items) {
        positions.push_back(static_cast<std::uint32_t>(bvh.order.size()));
        bvh.order.push_back(item.inputIndex);
        if (isPair(isJoined, item))
            bvh.order.push_back(item.inputIndex + 1);
    }
    positions.push_back(static_cast<std::uint32_t>(bvh.order.size()));
    if (isJoined.empty())
        return;
    for (BvhNode &node : bvh.nodes)
        if (node.isLeaf()) {
            const std::uint32_t begin = positions[node.first];
            node.count = positions[node.first + node.count] - begin;
            node.first = begin;
        }
}

/// `items` begins with triangles of `meshes`.
Bvh buildTree(TreeKind kind, std::span<const TriangleMesh> meshes, std::vector<BuildTriangle> items,
              std::uint32_t firstInstance, int leafSize) {
    assert(leafSize >= 1 && (kind != TreeKind::None || firstInstance == noInstances));
    Bvh bvh;
    if (items.empty())
        return bvh;
    JoinedItems isJoined;
    if (kind == TreeKind::Sah && leafSize > 1)
        isJoined = joinTriangles(meshes, items);
    if (kind == TreeKind::None)
        bvh.nodes.push_back(
            {RangeBounds(items).triangles.box(), 0, static_cast<std::uint32_t>(items.size())});
    else
        bvh = Builder(kind, items, isJoined, firstInstance, leafSize).build();
    bvh.firstInstance = firstInstance;
    orderTriangles(items, isJoined, bvh);
    return bvh;
}

void addTriangles(const TriangleMesh &mesh, std::vector<BuildTriangle> &triangles) {
    for (const MeshTriangle &corner : mesh.triangles) {
        const glm::vec3 &a = mesh.positions[corner.positions.x];
        const glm::vec3 &b = mesh.positions[corner.positions.y];
        const glm::vec3 &c = mesh.positions[corner.positions.z];
        BuildTriangle triangle;
        triangle.box.extend(a);
        triangle.box.extend(b);
        triangle.box.extend(c);
        triangle.centroid = a / 3.0f + b / 3.0f + c / 3.0f;
        triangle.inputIndex = static_cast<std::uint32_t>(triangles.size());
        triangles.push_back(triangle);
    }
}

/// The box by which kernels confine hits: the same operations (shaders/geometry/sphere.glsl), on the packed numbers.
Box boxOf(const Sphere &sphere) {
    const glm::vec3 centre(sphere.centre);
    const auto radius = static_cast<float>(sphere.radius);
    const glm::vec3 margin = leaves::sphereBoxMargin(centre, radius);
    return {centre - radius - margin, centre + radius + margin};
}

void addSpheres(const Scene &scene, std::span<const std::uint32_t> spheres,
                std::vector<BuildTriangle> &items) {
    items.reserve(items.size() + spheres.size());
    for (const std::uint32_t index : spheres) {
        const Sphere &sphere = scene.spheres[index];
        items.push_back({boxOf(sphere), glm::vec3(sphere.centre), static_cast<std::uint32_t>(items.size())});
    }
}

Box boxOf(std::span<const glm::vec3> points) {
    Box box;
    for (const glm::vec3 &point : points)
        box.extend(point);
    return box;
}

/// The vertices of each prototype that its triangles use.
std::vector<std::vector<glm::vec3>> pointsOfPrototypes(const Scene &scene) {
    std::vector<std::vector<glm::vec3>> points;
    for (const TriangleMesh &mesh : scene.prototypes) {
        std::vector<bool> isUsed(mesh.positions.size(), false);
        for (const MeshTriangle &triangle : mesh.triangles)
            for (glm::length_t corner = 0; corner < 3; ++corner)
                isUsed[triangle.positions[corner]] = true;
        points.emplace_back();
        for (std::size_t i = 0; i < isUsed.size(); ++i)
            if (isUsed[i])
                points.back().push_back(mesh.positions[i]);
    }
    return points;
}

/// A box around the places of all points of a box, rounded as placedPoint rounds them.
Box placedBox(const Placement &placement, const Box &box) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr double roundings =
        6.0 / 16777216.0; // 5 of placedPoint (shaders/geometry/instance.glsl), and one here
    const glm::dvec3 middle = (glm::dvec3(box.lower) + glm::dvec3(box.upper)) / 2.0;
    const glm::dvec3 half = (glm::dvec3(box.upper) - glm::dvec3(box.lower)) / 2.0;
    const glm::dvec3 slack =
        placedExtent(placement, glm::dvec3(glm::max(glm::abs(box.lower), glm::abs(box.upper)))) * roundings;
    Box placed;
    for (glm::length_t i = 0; i < 3; ++i) {
        const glm::dvec3 row(placement.rows[static_cast<std::size_t>(i)]);
        const double centre = glm::dot(row, middle) + static_cast<double>(placement.offset[i]);
        const double reach = glm::dot(glm::abs(row), half) + slack[i];
        placed.lower[i] = std::nextafter(static_cast<float>(centre - reach), -infinity);
        placed.upper[i] = std::nextafter(static_cast<float>(centre + reach), infinity);
    }
    return placed;
}

/// The box of all primitives of the tree, exactly as if instances were flattened. `boxes` enclose the instances; only
/// those that reach beyond what is known so far are looked at point by point.
Box exactBounds(const Scene &scene, std::span<const std::uint32_t> spheres,
                const std::vector<std::vector<glm::vec3>> &points, std::span<const Box> boxes) {
    Box bounds;
    for (const TriangleMesh &mesh : scene.meshes)
        for (const MeshTriangle &triangle : mesh.triangles)
            for (glm::length_t corner = 0; corner < 3; ++corner)
                bounds.extend(mesh.positions[triangle.positions[corner]]);
    for (const std::uint32_t index : spheres)
        bounds.extend(boxOf(scene.spheres[index]));
    const auto look = [&](std::size_t i) {
        const Instance &instance = scene.instances[i];
        if (!bounds.contains(boxes[i]))
            for (const glm::vec3 &point : points[instance.prototype])
                bounds.extend(placedPoint(instance.toWorld, point));
    };
    for (glm::length_t axis = 0; axis < 3; ++axis) { // first those that reach farthest
        const auto lowest =
            std::ranges::min_element(boxes, {}, [&](const Box &box) { return box.lower[axis]; });
        look(static_cast<std::size_t>(lowest - boxes.begin()));
        const auto highest =
            std::ranges::max_element(boxes, {}, [&](const Box &box) { return box.upper[axis]; });
        look(static_cast<std::size_t>(highest - boxes.begin()));
    }
    for (std::size_t i = 0; i < boxes.size(); ++i)
        look(i);
    return bounds;
}

} // namespace

double Box::halfArea() const {
    if (isEmpty())
        return 0.0;
    const glm::dvec3 size = glm::dvec3(upper) - glm::dvec3(lower);
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

std::vector<BuildTriangle> buildTriangles(const Scene &scene) {
    const std::size_t count = triangleCount(scene);
    // Leaf references keep two bits for flags.
    constexpr std::size_t most = layout::instanceFlag - layout::minFirstTriangleId - 1;
    if (count > most)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("the scene has {} triangles; at most {} can be addressed", count, most));
    std::vector<BuildTriangle> triangles;
    triangles.reserve(count);
    for (const TriangleMesh &mesh : scene.meshes)
        addTriangles(mesh, triangles);
    return triangles;
}

std::vector<BuildTriangle> buildItems(const Scene &scene) {
    std::vector<BuildTriangle> items = buildTriangles(scene);
    const std::vector<std::uint32_t> spheres = spheresInTree(scene);
    addSpheres(scene, spheres, items);
    if (scene.instances.empty())
        return items;
    const std::vector<std::vector<glm::vec3>> points = pointsOfPrototypes(scene);
    std::vector<Box> own;
    own.reserve(points.size());
    for (const std::vector<glm::vec3> &ofPrototype : points)
        own.push_back(boxOf(ofPrototype));
    std::vector<Box> boxes;
    boxes.reserve(scene.instances.size());
    for (const Instance &instance : scene.instances)
        boxes.push_back(placedBox(instance.toWorld, own[instance.prototype]));
    const Box bounds = exactBounds(scene, spheres, points, boxes);
    items.reserve(items.size() + boxes.size());
    for (const Box &box : boxes) {
        const Box inside{glm::max(box.lower, bounds.lower), glm::min(box.upper, bounds.upper)};
        items.push_back(
            {inside, inside.lower / 2.0f + inside.upper / 2.0f, static_cast<std::uint32_t>(items.size())});
    }
    return items;
}

Bvh buildBvh(TreeKind kind, std::vector<BuildTriangle> triangles, int leafSize) {
    return buildTree(kind, {}, std::move(triangles), noInstances, leafSize);
}

Bvh buildBvh(TreeKind kind, const Scene &scene, int leafSize) {
    std::vector<BuildTriangle> items = buildItems(scene);
    dropDuplicates(scene, items);
    std::vector<std::uint32_t> spheres = spheresInTree(scene);
    const std::size_t firstInstance = triangleCount(scene) + spheres.size();
    Bvh bvh = buildTree(kind, scene.meshes, std::move(items),
                        scene.instances.empty() ? noInstances : static_cast<std::uint32_t>(firstInstance),
                        leafSize);
    bvh.spheres = std::move(spheres);
    for (const TriangleMesh &prototype : scene.prototypes) {
        std::vector<BuildTriangle> triangles;
        addTriangles(prototype, triangles);
        bvh.prototypes.push_back(
            buildTree(kind, std::span(&prototype, 1), std::move(triangles), noInstances, leafSize));
    }
    return bvh;
}

} // namespace hyalite::core
