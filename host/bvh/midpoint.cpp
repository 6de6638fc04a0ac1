#include "host/bvh/split.h"

#include <algorithm>

namespace hyalite::core {

namespace {

int longestAxis(const Box &box) {
    const glm::dvec3 size = glm::dvec3(box.upper) - glm::dvec3(box.lower);
    if (size.x >= size.y && size.x >= size.z)
        return 0;
    return size.y >= size.z ? 1 : 2;
}

} // namespace

std::size_t splitAtMidpoint(std::span<BuildTriangle> range, const Box &box, std::size_t leafSize) {
    if (range.size() <= leafSize)
        return 0;
    const int axis = longestAxis(box);
    const float middle = box.lower[axis] / 2.0f + box.upper[axis] / 2.0f;
    const auto right = std::partition(range.begin(), range.end(), [=](const BuildTriangle &triangle) {
        return triangle.centroid[axis] < middle;
    });
    return right == range.end() ? 0 : static_cast<std::size_t>(right - range.begin());
}

std::size_t splitAtMedian(std::span<BuildTriangle> range, const Box &box) {
    const int axis = longestAxis(box);
    const auto middle = range.begin() + static_cast<std::ptrdiff_t>(range.size() / 2);
    std::nth_element(range.begin(), middle, range.end(), [=](const BuildTriangle &a, const BuildTriangle &b) {
        return a.centroid[axis] != b.centroid[axis] ? a.centroid[axis] < b.centroid[axis]
                                                    : a.inputIndex < b.inputIndex;
    });
    return range.size() / 2;
}

} // namespace hyalite::core
