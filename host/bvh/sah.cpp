#include "host/bvh/split.h"
#include "host/bvh/wide_box.h"

#include <algorithm>
#include <array>
#include <bit>

namespace hyalite {

namespace {

constexpr std::size_t binCount = 16;

/// What lies in one bin, or in several side by side.
struct Content {
    WideBox box;
    std::uint32_t count;

    static Content none() { return {WideBox::empty(), 0}; }
    void add(const Content &other) {
        box.extend(other.box);
        count += other.count;
    }
    [[nodiscard]] double cost() const { return box.halfArea() * count; }
};

/// The bins of one axis. Bins are valid only once they are cleared, and what is empty is not looked at: most ranges
/// have fewer triangles than there are bins.
struct Bins {
    std::array<Content, binCount> contents;
    std::uint32_t occupied; ///< a bit for each

    void add(std::size_t bin, const WideBox &triangle) {
        contents[bin].add({triangle, 1});
        occupied |= 1u << bin;
    }
};

/// Maps a centroid's coordinate to a bin. Extents that overflow or vanish map everything to bin 0, which never splits.
struct Binning {
    double lower;
    double scale;

    Binning(float lowest, float highest)
        : lower(lowest),
          scale(highest > lowest ? binCount * (1.0 - 1e-9) / (static_cast<double>(highest) - lowest) : 0.0) {}

    [[nodiscard]] std::size_t binOf(float coordinate) const {
        return static_cast<std::size_t>(static_cast<int>((static_cast<double>(coordinate) - lower) * scale));
    }
};

using Binnings = std::array<Binning, 3>;

Binnings binningsOf(std::span<const BuildTriangle> range) {
    WideBox centroids = WideBox::empty();
    for (const BuildTriangle &triangle : range)
        centroids.extendByCentroid(triangle);
    return {Binning(centroids.lower[0], centroids.upper[0]), Binning(centroids.lower[1], centroids.upper[1]),
            Binning(centroids.lower[2], centroids.upper[2])};
}

void fill(std::array<Bins, 3> &bins, std::span<const BuildTriangle> range, const Binnings &binnings) {
    const auto forAllAxes = [&](const BuildTriangle &triangle, const auto &use) {
        use(bins[0], binnings[0].binOf(triangle.centroid.x));
        use(bins[1], binnings[1].binOf(triangle.centroid.y));
        use(bins[2], binnings[2].binOf(triangle.centroid.z));
    };
    for (Bins &axis : bins)
        axis.occupied = 0;
    if (range.size() < binCount) {
        for (const BuildTriangle &triangle : range)
            forAllAxes(triangle, [](Bins &axis, std::size_t bin) { axis.contents[bin] = Content::none(); });
    } else {
        for (Bins &axis : bins)
            axis.contents.fill(Content::none());
    }
    for (const BuildTriangle &triangle : range)
        forAllAxes(triangle, [box = WideBox(triangle)](Bins &axis, std::size_t bin) { axis.add(bin, box); });
}

struct Candidate {
    double cost =
        std::numeric_limits<double>::infinity(); ///< of the triangle tests, times the parent's half area
    std::uint32_t largerCount = 0;               ///< triangles on the fuller side
    int axis = -1;
    std::size_t lastLeftBin = 0;

    /// Boxes without area cost nothing wherever they are cut: then halves are best.
    [[nodiscard]] bool isBetterThan(const Candidate &other) const {
        return cost < other.cost || (cost == other.cost && largerCount < other.largerCount);
    }
};

Candidate bestOnAxis(const Bins &bins, int axis, std::uint32_t triangleCount) {
    std::array<double, binCount> rightCosts; // of an occupied bin, other than the first, and all beyond it
    Content right = Content::none();
    for (std::uint32_t rest = bins.occupied; (rest & (rest - 1)) != 0;) {
        const auto bin = static_cast<std::size_t>(std::bit_width(rest)) - 1;
        rest ^= 1u << bin;
        right.add(bins.contents[bin]);
        rightCosts[bin] = right.cost();
    }
    Candidate best;
    Content left = Content::none();
    auto bin = static_cast<std::size_t>(std::countr_zero(bins.occupied));
    for (std::uint32_t rest = bins.occupied & (bins.occupied - 1); rest != 0; rest &= rest - 1) {
        const auto next = static_cast<std::size_t>(std::countr_zero(rest));
        left.add(bins.contents[bin]);
        const Candidate candidate{left.cost() + rightCosts[next],
                                  std::max(left.count, triangleCount - left.count), axis, bin};
        if (candidate.isBetterThan(best))
            best = candidate;
        bin = next;
    }
    return best;
}

Candidate bestCut(std::span<const BuildTriangle> range, const Binnings &binnings) {
    std::array<Bins, 3> bins;
    fill(bins, range, binnings);
    Candidate best;
    for (int axis = 0; axis < 3; ++axis) {
        const Candidate candidate =
            bestOnAxis(bins[static_cast<std::size_t>(axis)], axis, static_cast<std::uint32_t>(range.size()));
        if (candidate.isBetterThan(best))
            best = candidate;
    }
    return best;
}

/// What bestCut gives for two triangles, faster: every cut costs the same.
Candidate cutOfPair(std::span<const BuildTriangle> range) {
    int axis = 0;
    while (axis < 3 && range[0].centroid[axis] == range[1].centroid[axis])
        ++axis;
    if (axis == 3)
        return {};
    return {WideBox(range[0]).halfArea() + WideBox(range[1]).halfArea(), 1, axis, 0};
}

} // namespace

std::size_t splitBySah(std::span<BuildTriangle> range, const Box &box, std::size_t leafSize) {
    const Binnings binnings = binningsOf(range);
    const Candidate best = range.size() == 2 ? cutOfPair(range) : bestCut(range, binnings);
    const double area = box.halfArea();
    const double leafCost = triangleCost * static_cast<double>(range.size()) * area;
    const bool isLeafCheaper = leafCost <= nodeCost * area + triangleCost * best.cost;
    if (best.axis < 0 || (isLeafCheaper && range.size() <= leafSize))
        return 0;
    const Binning &binning = binnings[static_cast<std::size_t>(best.axis)];
    const auto right = std::partition(range.begin(), range.end(), [&](const BuildTriangle &triangle) {
        return binning.binOf(triangle.centroid[best.axis]) <= best.lastLeftBin;
    });
    return static_cast<std::size_t>(right - range.begin());
}

} // namespace hyalite
