// Functions of shaders/math/functions.glsl that have closed forms of their own.
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/leaves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hyalite::core::reference {
namespace {

TEST(FloatOf, IsTheNearestFloat) {
    hyalite::core::testing::Random random(811);
    const auto expectNearest = [](std::uint32_t x) {
        EXPECT_EQ(floatOf<float>(x), static_cast<float>(x)) << x;
        EXPECT_EQ(floatOf<double>(x), static_cast<double>(x)) << x;
    };
    for (const std::uint32_t x : {0u, 1u, 0xFFFFu, 0x10000u, 0xFFFFFFu, 0x1000001u, 0x80000000u, 0xFFFFFFFFu})
        expectNearest(x);
    // Near the middle between two floats, from 2^31 on, where without the highest bit it would be a tie.
    for (std::uint32_t cell = 0xC00000; cell < 0xC00400; ++cell)
        for (const std::uint32_t beside : {127u, 128u, 129u})
            expectNearest(cell * 256 + beside);
    for (int i = 0; i < 100000; ++i)
        expectNearest(static_cast<std::uint32_t>(random.bits()));
}

TEST(WithoutSubnormals, IsTheNumberOrZero) {
    const float smallest = std::numeric_limits<float>::min();
    for (const float x : {smallest, -smallest, 1.0f, -3e38f, std::numeric_limits<float>::infinity()})
        EXPECT_EQ(withoutSubnormals<float>(x), x);
    for (const float x : {std::nextafter(smallest, 0.0f), -std::nextafter(smallest, 0.0f),
                          std::numeric_limits<float>::denorm_min(), 0.0f})
        EXPECT_EQ(withoutSubnormals<float>(x), 0.0f);
    EXPECT_TRUE(std::isnan(withoutSubnormals<float>(std::numeric_limits<float>::quiet_NaN())));
}

TEST(WithoutTiny, KeepsWhatPicturesShow) {
    for (const float x : {1e-30f, -1e-30f, 1.0f, std::numeric_limits<float>::infinity()})
        EXPECT_EQ(withoutTiny<float>(x), x);
    for (const float x : {9e-31f, -9e-31f, std::numeric_limits<float>::min(), 0.0f})
        EXPECT_EQ(withoutTiny<float>(x), 0.0f);
    EXPECT_TRUE(std::isnan(withoutTiny<float>(std::numeric_limits<float>::quiet_NaN())));
}

} // namespace
} // namespace hyalite::core::reference
