#include "host/bvh/bvh.h"
#include "host/bvh/split.h"
#include "host/bvh/wide_box.h"
#include "host/error.h"
#include "shaders/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <exception>
#include <memory>

namespace hyalite {

namespace {

Box boxOf(std::span<const BuildTriangle> range) {
    WideBox box = WideBox::empty();
    for (const BuildTriangle &triangle : range)
        box.extend(WideBox(triangle));
    return box.box();
}

/// Halving is forced as soon as it is the only way to stay within the depth that traversal stacks have room for.
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
};

/// A part of the tree while it is built: a leaf, two branches, or everything below it in one piece.
struct Branch {
    BvhNode node;                 ///< complete for a leaf
    std::unique_ptr<Branch> left; ///< null where there is one piece
    std::unique_ptr<Branch> right;
    std::vector<BvhNode> below; ///< numbered from 0
    int deepest = 0;            ///< inner nodes above its deepest leaf
};

/// Builds large branches as OpenMP tasks and small ones in one go. Which are small depends on the triangles alone, and
/// so does the tree: threads decide only who builds what.
class Builder {
  public:
    Builder(TreeKind kind, std::span<BuildTriangle> triangles, int leafSize)
        : split_(kind == TreeKind::Sah ? splitBySah : splitAtMidpoint), triangles_(triangles),
          leafSize_(static_cast<std::size_t>(leafSize)) {}

    Bvh build() {
        const auto count = static_cast<std::uint32_t>(triangles_.size());
        Branch root;
        root.node.box = boxOf(triangles_);
#pragma omp parallel if (count > smallBranch)
#pragma omp single
        grow(root, 0, count, 0);
        if (failure_)
            std::rethrow_exception(failure_);
        Bvh bvh;
        bvh.nodes.reserve(nodeCountOf(root));
        bvh.nodes.emplace_back();
        join(root, 0, bvh);
        return bvh;
    }

  private:
    static constexpr std::uint32_t smallBranch = 4096; ///< triangles

    /// Reorders the triangles from `begin` to `end`; returns where the right child's begin, or `begin` for a leaf.
    std::uint32_t divide(const Box &box, std::uint32_t begin, std::uint32_t end, int depth) const {
        const std::span<BuildTriangle> range = triangles_.subspan(begin, end - begin);
        std::size_t leftCount = 0;
        if (range.size() > 1) {
            if (!mustHalve(range.size(), depth))
                leftCount = split_(range, box, leafSize_);
            else if (range.size() > leafSize_)
                leftCount = splitAtMedian(range, box);
        }
        return begin + static_cast<std::uint32_t>(leftCount);
    }

    [[nodiscard]] Box boxOfRange(std::uint32_t begin, std::uint32_t end) const {
        return boxOf(triangles_.subspan(begin, end - begin));
    }

    /// Nothing may leave a task but through failure_.
    void grow(Branch &branch, std::uint32_t begin, std::uint32_t end, int depth) {
        try {
            if (end - begin <= smallBranch)
                growInOnePiece(branch, begin, end, depth);
            else
                growInTwo(branch, begin, end, depth);
        } catch (...) {
#pragma omp critical(hyaliteBuildFailure)
            failure_ = std::current_exception();
        }
    }

    void growInTwo(Branch &branch, std::uint32_t begin, std::uint32_t end, int depth) {
        branch.deepest = depth;
        const std::uint32_t middle = divide(branch.node.box, begin, end, depth);
        if (middle == begin) {
            branch.node.first = begin;
            branch.node.count = end - begin;
            return;
        }
        branch.left = std::make_unique<Branch>();
        branch.right = std::make_unique<Branch>();
        Branch *const left = branch.left.get();
#pragma omp task default(none) firstprivate(left, begin, middle, depth)
        {
            left->node.box = boxOfRange(begin, middle);
            grow(*left, begin, middle, depth + 1);
        }
        branch.right->node.box = boxOfRange(middle, end);
        grow(*branch.right, middle, end, depth + 1);
    }

    /// Depth-first with an explicit stack.
    void growInOnePiece(Branch &branch, std::uint32_t begin, std::uint32_t end, int depth) const {
        // The branch's own node stands in front while its children are numbered from 0.
        std::vector<BvhNode> &nodes = branch.below;
        std::vector<Task> tasks{{rootNode, begin, end, depth}};
        while (!tasks.empty()) {
            const Task task = tasks.back();
            tasks.pop_back();
            branch.deepest = std::max(branch.deepest, task.depth);
            const auto node = [&]() -> BvhNode & {
                return task.node == rootNode ? branch.node : nodes[task.node];
            };
            const std::uint32_t middle = divide(node().box, task.begin, task.end, task.depth);
            if (middle == task.begin) {
                node().first = task.begin;
                node().count = task.end - task.begin;
                continue;
            }
            const auto left = static_cast<std::uint32_t>(nodes.size());
            node().first = left;
            nodes.push_back({boxOfRange(task.begin, middle), 0, 0});
            nodes.push_back({boxOfRange(middle, task.end), 0, 0});
            tasks.push_back({left + 1, middle, task.end, task.depth + 1});
            tasks.push_back({left, task.begin, middle, task.depth + 1});
        }
    }

    static std::size_t nodeCountOf(const Branch &branch) {
        return branch.left ? 1 + nodeCountOf(*branch.left) + nodeCountOf(*branch.right)
                           : 1 + branch.below.size();
    }

    /// Numbers the nodes of a branch, depth first, and puts them behind those of `bvh`; its own one into `slot`.
    static void join(Branch &branch, std::size_t slot, Bvh &bvh) {
        const auto first = static_cast<std::uint32_t>(bvh.nodes.size());
        bvh.depth = std::max(bvh.depth, branch.deepest);
        if (!branch.node.isLeaf())
            branch.node.first = first;
        bvh.nodes[slot] = branch.node;
        if (branch.left) {
            bvh.nodes.resize(first + 2);
            join(*branch.left, first, bvh);
            join(*branch.right, first + 1, bvh);
            return;
        }
        for (BvhNode node : branch.below) {
            if (!node.isLeaf())
                node.first += first;
            bvh.nodes.push_back(node);
        }
        branch.below = {};
    }

    static constexpr std::uint32_t rootNode = std::numeric_limits<std::uint32_t>::max();

    SplitFunction split_;
    std::span<BuildTriangle> triangles_;
    std::size_t leafSize_;
    std::exception_ptr failure_; ///< of any task
};

} // namespace

double Box::halfArea() const {
    if (isEmpty())
        return 0.0;
    const glm::dvec3 size = glm::dvec3(upper) - glm::dvec3(lower);
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

std::vector<BuildTriangle> buildTriangles(const Scene &scene) {
    const std::size_t count = triangleCount(scene);
    // Ids and leaf references keep one bit for the leaf flag and the first ids for spheres.
    constexpr std::size_t most = layout::leafFlag - layout::firstTriangleId - 1;
    if (count > most)
        throw Error(ExitCode::LimitExceeded,
                    fmt::format("the scene has {} triangles; at most {} can be addressed", count, most));
    std::vector<BuildTriangle> triangles;
    triangles.reserve(count);
    for (const TriangleMesh &mesh : scene.meshes) {
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
    return triangles;
}

Bvh buildBvh(TreeKind kind, std::vector<BuildTriangle> triangles, int leafSize) {
    assert(leafSize >= 1);
    Bvh bvh;
    if (kind != TreeKind::None && !triangles.empty())
        bvh = Builder(kind, triangles, leafSize).build();
    else if (!triangles.empty())
        bvh.nodes.push_back({boxOf(triangles), 0, static_cast<std::uint32_t>(triangles.size())});
    bvh.order.reserve(triangles.size());
    for (const BuildTriangle &triangle : triangles)
        bvh.order.push_back(triangle.inputIndex);
    return bvh;
}

} // namespace hyalite
