#include "host/bvh/split.h"

#include <algorithm>
#include <array>

namespace hyalite {

namespace {

constexpr int binCount = 16;

struct Bin {
    Box box;
    std::size_t count = 0;
};

/// Maps a centroid's coordinate to a bin. Extents that overflow or vanish map everything to bin 0, which never splits.
struct Binning {
    double lower;
    double scale;

    Binning(float lowest, float highest)
        : lower(lowest),
          scale(highest > lowest ? binCount * (1.0 - 1e-9) / (static_cast<double>(highest) - lowest) : 0.0) {}

    [[nodiscard]] int binOf(float coordinate) const {
        return static_cast<int>((static_cast<double>(coordinate) - lower) * scale);
    }
};

struct Candidate {
    double cost =
        std::numeric_limits<double>::infinity(); ///< of the triangle tests, times the parent's half area
    std::size_t largerCount = 0;                 ///< triangles on the fuller side
    int axis = -1;
    int lastLeftBin = 0;

    /// Boxes without area cost nothing wherever they are cut: then halves are best.
    [[nodiscard]] bool isBetterThan(const Candidate &other) const {
        return cost < other.cost || (cost == other.cost && largerCount < other.largerCount);
    }
};

Candidate bestOnAxis(std::span<const BuildTriangle> range, int axis, const Binning &binning) {
    std::array<Bin, binCount> bins;
    for (const BuildTriangle &triangle : range) {
        Bin &bin = bins[static_cast<std::size_t>(binning.binOf(triangle.centroid[axis]))];
        bin.box.extend(triangle.box);
        ++bin.count;
    }
    std::array<double, binCount> rightCost{};
    Bin right;
    for (std::size_t i = binCount - 1; i > 0; --i) {
        right.box.extend(bins[i].box);
        right.count += bins[i].count;
        rightCost[i] = right.box.halfArea() * static_cast<double>(right.count);
    }
    Candidate best;
    Bin left;
    for (std::size_t i = 0; i + 1 < binCount; ++i) {
        left.box.extend(bins[i].box);
        left.count += bins[i].count;
        if (left.count == 0 || left.count == range.size())
            continue;
        const double cost = left.box.halfArea() * static_cast<double>(left.count) + rightCost[i + 1];
        const Candidate candidate{cost, std::max(left.count, range.size() - left.count), axis,
                                  static_cast<int>(i)};
        if (candidate.isBetterThan(best))
            best = candidate;
    }
    return best;
}

} // namespace

std::size_t splitBySah(std::span<BuildTriangle> range, const Box &box, std::size_t leafSize) {
    Box centroids;
    for (const BuildTriangle &triangle : range)
        centroids.extend(triangle.centroid);
    Candidate best;
    for (int axis = 0; axis < 3; ++axis) {
        const Candidate candidate =
            bestOnAxis(range, axis, Binning(centroids.lower[axis], centroids.upper[axis]));
        if (candidate.isBetterThan(best))
            best = candidate;
    }
    const double area = box.halfArea();
    const double leafCost = triangleCost * static_cast<double>(range.size()) * area;
    const bool isLeafCheaper = best.axis < 0 || leafCost <= nodeCost * area + triangleCost * best.cost;
    if (isLeafCheaper && range.size() <= leafSize)
        return 0;
    if (best.axis < 0)
        return splitAtMedian(range, box);
    const Binning binning(centroids.lower[best.axis], centroids.upper[best.axis]);
    const auto right = std::partition(range.begin(), range.end(), [&](const BuildTriangle &triangle) {
        return binning.binOf(triangle.centroid[best.axis]) <= best.lastLeftBin;
    });
    return static_cast<std::size_t>(right - range.begin());
}

} // namespace hyalite
