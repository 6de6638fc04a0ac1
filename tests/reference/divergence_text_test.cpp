// What a divergence says of points: their coordinates in the file.
#include "host/reference/divergence.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

std::string firstValue(std::uint32_t quantity, const glm::dvec3 &origin) {
    const layout::TraceEvent a{quantity, 0, 1, 0, {1.0f, 2.0f, 0.5f}, 0};
    const layout::TraceEvent b{quantity, 0, 1, 0, {1.0f, 2.0f, 0.25f}, 0};
    return findDivergence({a}, {b}, 0, origin).value().valueA;
}

TEST(DivergenceText, HasPointsInTheCoordinatesOfTheFile) {
    const glm::dvec3 utm(500'000.0, 100.0, 5'400'000.0);
    for (const std::uint32_t point : {layout::traceRayOrigin, layout::traceSurfacePosition})
        EXPECT_EQ(firstValue(point, utm), "(500001 (0x3f800000), 102 (0x40000000), 5400000.5 (0x3f000000))");
    EXPECT_EQ(firstValue(layout::traceSurfacePosition, glm::dvec3(0.0)),
              firstValue(layout::traceSurfaceNormal, utm));
}

} // namespace
} // namespace hyalite::core
