#include "host/bvh/tree_statistics.h"

#include "host/bvh/split.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace hyalite::core {

BvhStatistics measureBvh(const Bvh &bvh) {
    BvhStatistics statistics;
    statistics.triangleCount = bvh.order.size();
    statistics.depth = bvh.depth;
    if (bvh.nodes.empty())
        return statistics;
    double nodesCost = 0.0;
    double trianglesCost = 0.0;
    for (const BvhNode &node : bvh.nodes) {
        const double area = node.box.halfArea();
        if (!node.isLeaf()) {
            ++statistics.innerCount;
            nodesCost += nodeCost * area;
            continue;
        }
        ++statistics.leafCount;
        trianglesCost += triangleCost * area * node.count;
        statistics.largestLeaf = std::max<std::size_t>(statistics.largestLeaf, node.count);
        const std::size_t bucket = static_cast<std::size_t>(std::bit_width(node.count - 1));
        ++statistics.leafHistogram[std::min(bucket, statistics.leafHistogram.size() - 1)];
    }
    const double rootArea = bvh.nodes.front().box.halfArea();
    if (rootArea > 0.0) {
        statistics.sahCost = (nodesCost + trianglesCost) / rootArea;
        statistics.trianglesTested = trianglesCost / rootArea / triangleCost;
    }
    statistics.meanLeaf =
        static_cast<double>(statistics.triangleCount) / static_cast<double>(statistics.leafCount);
    return statistics;
}

std::string findBvhFault(const Bvh &bvh, const std::vector<BuildTriangle> &triangles,
                         std::size_t droppedCount) {
    const std::size_t wantedCount = triangles.size() - droppedCount;
    if (bvh.order.size() != wantedCount)
        return fmt::format("{} triangles in the tree, {} in the scene", bvh.order.size(), wantedCount);
    std::vector<int> depths(bvh.nodes.size(), -1);
    std::vector<bool> isSeen(triangles.size(), false);
    std::size_t seenCount = 0;
    int depth = 0;
    if (!bvh.nodes.empty())
        depths[0] = 0;
    for (std::size_t i = 0; i < bvh.nodes.size(); ++i) {
        const BvhNode &node = bvh.nodes[i];
        if (depths[i] < 0)
            return fmt::format("node {} has no parent before it", i);
        depth = std::max(depth, depths[i]);
        if (!node.isLeaf()) {
            for (const std::size_t child : {std::size_t{node.first}, std::size_t{node.first} + 1}) {
                if (child <= i || child >= bvh.nodes.size() || depths[child] >= 0)
                    return fmt::format("node {}: child {} is out of range or shared", i, child);
                if (!node.box.contains(bvh.nodes[child].box))
                    return fmt::format("node {}: child {} reaches out of its box", i, child);
                depths[child] = depths[i] + 1;
            }
            continue;
        }
        for (std::size_t k = node.first; k < std::size_t{node.first} + node.count; ++k) {
            if (k >= bvh.order.size() || bvh.order[k] >= triangles.size() || isSeen[bvh.order[k]])
                return fmt::format("leaf {}: triangle {} is out of range or in two leaves", i, k);
            isSeen[bvh.order[k]] = true;
            ++seenCount;
            if (!node.box.contains(triangles[bvh.order[k]].box))
                return fmt::format("leaf {}: triangle {} reaches out of its box", i, bvh.order[k]);
        }
    }
    if (seenCount != wantedCount)
        return fmt::format("{} of {} triangles are in no leaf", wantedCount - seenCount, wantedCount);
    if (depth != bvh.depth)
        return fmt::format("the depth is {}, not {}", depth, bvh.depth);
    return {};
}

} // namespace hyalite::core
