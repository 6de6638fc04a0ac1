#include "host/bvh/split.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hyalite::core {

namespace {

/// Integer counterpart of Lanes: one for each axis, and an unused one.
using IntLanes = std::int32_t __attribute__((vector_size(16)));

constexpr std::size_t binCountMax = 16;

/// Small ranges use fewer bins: trees are no worse, and build time drops by a fifth.
std::size_t binCountFor(std::size_t triangleCount) { return std::min(binCountMax, 4 + triangleCount / 4); }

/// Maps centroids to bins, on all axes at once. Extents that overflow or vanish map everything to bin 0, which never
/// splits.
struct Binning {
    /// The fourth lane of a centroid is an index, which as a float is denormal and therefore slow. Subtracting 1 avoids
    /// that.
    Lanes lower{0.0f, 0.0f, 0.0f, 1.0f};
    Lanes scale{};

    Binning(const WideBox &centroids, std::size_t binCount) {
        for (int axis = 0; axis < 3; ++axis) {
            const float extent = centroids.upper[axis] - centroids.lower[axis];
            const float binsPerUnit =
                static_cast<float>(binCount) * 0.99999f / extent; // never binCount itself
            if (std::isfinite(extent) && std::isfinite(binsPerUnit)) {
                lower[axis] = centroids.lower[axis];
                scale[axis] = binsPerUnit;
            }
        }
    }

    [[nodiscard]] IntLanes binsOf(const BuildTriangle &triangle) const {
        return __builtin_convertvector((WideBox::centroidOf(triangle) - lower) * scale, IntLanes);
    }
    [[nodiscard]] int binOf(float coordinate, int axis) const {
        return static_cast<int>((coordinate - lower[axis]) * scale[axis]);
    }
};

/// The contents of each bin on each axis.
struct Bins {
    std::size_t count;
    std::array<std::array<WideBox, binCountMax>, 3> boxes;
    std::array<IntLanes, binCountMax> triangleCounts;

    explicit Bins(std::size_t binCount) : count(binCount) {
        for (std::size_t bin = 0; bin < count; ++bin) {
            for (auto &axis : boxes)
                axis[bin] = WideBox::empty();
            triangleCounts[bin] = IntLanes{};
        }
    }
    void add(const BuildTriangle &triangle, const Binning &binning) {
        const WideBox box(triangle);
        const IntLanes bins = binning.binsOf(triangle);
        for (int axis = 0; axis < 3; ++axis) {
            const auto bin = static_cast<std::size_t>(bins[axis]);
            boxes[static_cast<std::size_t>(axis)][bin].extend(box);
            ++triangleCounts[bin][axis];
        }
    }
    void add(std::span<const BuildTriangle> range, const Binning &binning) {
        for (const BuildTriangle &triangle : range)
            add(triangle, binning);
    }
    void add(const Bins &other) {
        for (std::size_t bin = 0; bin < count; ++bin) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                boxes[axis][bin].extend(other.boxes[axis][bin]);
            triangleCounts[bin] += other.triangleCounts[bin];
        }
    }
};

/// Neighbouring triangles often share a bin, and each update would wait for the one before. Half of them therefore go
/// to a second set of bins.
void fill(Bins &bins, std::span<const BuildTriangle> range, const Binning &binning) {
    constexpr std::size_t worthwhile = 64;
    if (range.size() < worthwhile) {
        bins.add(range, binning);
        return;
    }
    Bins others(bins.count);
    for (std::size_t i = 0; i + 1 < range.size(); i += 2) {
        bins.add(range[i], binning);
        others.add(range[i + 1], binning);
    }
    if (range.size() % 2 != 0)
        bins.add(range.back(), binning);
    bins.add(others);
}

/// One side of a cut, for a cut on each axis.
struct Side {
    std::array<WideBox, 3> boxes{WideBox::empty(), WideBox::empty(), WideBox::empty()};
    IntLanes triangleCounts{};

    void add(const Bins &bins, std::size_t bin) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            boxes[axis].extend(bins.boxes[axis][bin]);
        triangleCounts += bins.triangleCounts[bin];
    }
    /// Half areas times counts, with lengths in units of 1 / `unit`. NaN for an empty side, which is not a cut.
    [[nodiscard]] Lanes costs(float unit) const {
        const Lanes a = boxes[0].size() * unit;
        const Lanes b = boxes[1].size() * unit;
        const Lanes c = boxes[2].size() * unit;
        const Lanes xxyy = __builtin_shufflevector(a, b, 0, 4, 1, 5);
        const Lanes zz = __builtin_shufflevector(a, b, 2, 6, 2, 6);
        const Lanes x = __builtin_shufflevector(xxyy, c, 0, 1, 4, 4);
        const Lanes y = __builtin_shufflevector(xxyy, c, 2, 3, 5, 5);
        const Lanes z = __builtin_shufflevector(zz, c, 0, 1, 6, 6);
        return (x * y + y * z + z * x) * __builtin_convertvector(triangleCounts, Lanes);
    }
};

struct Cut {
    /// Expected triangle tests, times the half area of the parent.
    float cost = std::numeric_limits<float>::infinity();
    std::int32_t largerCount = 0; ///< triangles on the fuller side
    int axis = -1;
    int lastLeftBin = 0;

    /// Boxes without area cost nothing at any cut: then equal halves are best.
    [[nodiscard]] bool isBetterThan(const Cut &other) const {
        return cost < other.cost || (cost == other.cost && largerCount < other.largerCount);
    }
};

Cut bestCut(std::span<const BuildTriangle> range, const Binning &binning, std::size_t binCount, float unit) {
    Bins bins(binCount);
    fill(bins, range, binning);
    // Of each bin except the first, together with all bins after it.
    std::array<Lanes, binCountMax> rightCosts;
    Side right;
    for (std::size_t bin = binCount - 1; bin > 0; --bin) {
        right.add(bins, bin);
        rightCosts[bin] = right.costs(unit);
    }
    Side left;
    Lanes costs = Lanes{} + std::numeric_limits<float>::infinity();
    IntLanes largerCounts{};
    IntLanes lastLeftBins{};
    for (std::size_t bin = 0; bin + 1 < binCount; ++bin) {
        left.add(bins, bin);
        const Lanes cost = left.costs(unit) + rightCosts[bin + 1];
        const IntLanes rightCounts = static_cast<std::int32_t>(range.size()) - left.triangleCounts;
        const IntLanes larger = rightCounts > left.triangleCounts ? rightCounts : left.triangleCounts;
        const IntLanes isBetter = (cost < costs) | ((cost == costs) & (larger < largerCounts));
        costs = isBetter ? cost : costs;
        largerCounts = isBetter ? larger : largerCounts;
        lastLeftBins = isBetter ? IntLanes{} + static_cast<std::int32_t>(bin) : lastLeftBins;
    }
    Cut best;
    for (int axis = 0; axis < 3; ++axis) {
        const Cut cut{costs[axis], largerCounts[axis], axis, lastLeftBins[axis]};
        if (cut.isBetterThan(best))
            best = cut;
    }
    return best;
}

float halfArea(const WideBox &box, float unit) {
    const Lanes size = box.size() * unit;
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

/// A faster bestCut for two triangles, for which every cut costs the same.
Cut cutOfPair(std::span<const BuildTriangle> range, const Binning &binning, float unit) {
    const IntLanes first = binning.binsOf(range[0]);
    const IntLanes second = binning.binsOf(range[1]);
    for (int axis = 0; axis < 3; ++axis)
        if (first[axis] != second[axis])
            return {halfArea(WideBox(range[0]), unit) + halfArea(WideBox(range[1]), unit), 1, axis, 0};
    return {};
}

} // namespace

std::size_t splitBySah(std::span<BuildTriangle> range, const RangeBounds &bounds, std::size_t leafSize) {
    const std::size_t binCount = binCountFor(range.size());
    const Binning binning(bounds.centroids, binCount);
    // If the longest side is scaled to 1, areas of any scene are finite floats.
    const Lanes size = bounds.triangles.size();
    const float unit = 1.0f / std::max({size[0], size[1], size[2]});
    const Cut cut =
        range.size() == 2 ? cutOfPair(range, binning, unit) : bestCut(range, binning, binCount, unit);
    const double area = halfArea(bounds.triangles, unit);
    const double leafCost = triangleCost * static_cast<double>(range.size()) * area;
    const bool isLeafCheaper = leafCost <= nodeCost * area + triangleCost * static_cast<double>(cut.cost);
    if (cut.axis < 0 || (isLeafCheaper && range.size() <= leafSize))
        return 0;
    const auto right = std::partition(range.begin(), range.end(), [&](const BuildTriangle &triangle) {
        return binning.binOf(triangle.centroid[cut.axis], cut.axis) <= cut.lastLeftBin;
    });
    return static_cast<std::size_t>(right - range.begin());
}

} // namespace hyalite::core
