#include "host/base/portable_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hyalite::core {
namespace {

TEST(PortableMath, IsThatOfTheLibrary) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> exponents(-60.0, 60.0);
    for (int i = 0; i < 10000; ++i) {
        const double x = exponents(random);
        EXPECT_NEAR(exp2Portable(x) / std::exp2(x), 1.0, 1e-15);
        EXPECT_NEAR(log2Portable(std::exp2(x)), x, 1e-13);
    }
    for (const double x : {0x1p-60, 0.5, 1.0, 2.0, 0x1p60})
        EXPECT_EQ(log2Portable(x), std::log2(x));
    EXPECT_NEAR(log2Portable(std::nextafter(1.0, 0.0)), std::log2(std::nextafter(1.0, 0.0)), 1e-30);
}

} // namespace
} // namespace hyalite::core
