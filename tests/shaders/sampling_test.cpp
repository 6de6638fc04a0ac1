// Each way of drawing directions and points has the density that it says it has.
#include "host/reference/scene_view.h"

#include "tests/fixtures/geometry_fixture.h"

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::Random;

constexpr double pi = std::numbers::pi;

/// Chi-square of counts that ought to be equal, as a number of standard deviations of a normal distribution (Wilson and
/// Hilferty, 1931).
double chiSquareDeviations(const std::vector<int> &counts) {
    double total = 0.0;
    for (const int count : counts)
        total += count;
    const double expected = total / static_cast<double>(counts.size());
    double chiSquare = 0.0;
    for (const int count : counts)
        chiSquare += (count - expected) * (count - expected) / expected;
    const double freedom = static_cast<double>(counts.size()) - 1.0;
    const double spread = 2.0 / (9.0 * freedom);
    return (std::cbrt(chiSquare / freedom) - (1.0 - spread)) / std::sqrt(spread);
}

/// Maps samples back to the unit square by the cumulative distributions of what they ought to be, and expects that to
/// be filled evenly.
template <class Draw> void expectUniform(std::uint64_t seed, const Draw &draw) {
    constexpr int side = 24;
    std::vector<int> counts(side * side, 0);
    Random random(seed);
    for (int i = 0; i < 200 * side * side; ++i) {
        const Vec2<double> back = draw(Vec2<float>(unitFloats<float>(
            {static_cast<std::uint32_t>(random.bits()), static_cast<std::uint32_t>(random.bits())})));
        const int x = std::clamp(static_cast<int>(back.x * side), 0, side - 1);
        const int y = std::clamp(static_cast<int>(back.y * side), 0, side - 1);
        ++counts[static_cast<std::size_t>(y * side + x)];
    }
    EXPECT_LT(chiSquareDeviations(counts), 4.0) << "seed " << seed;
}

double atan2Turns(double x, double y) {
    const double turns = std::atan2(y, x) / (2.0 * pi);
    return turns < 0.0 ? turns + 1.0 : turns;
}

TEST(Functions, SineAndCosine) {
    for (int i = 0; i <= 1 << 16; ++i) {
        const float turns = static_cast<float>(i) / 65536.0f;
        const SineCosine<float> angle = sineCosine(turns);
        ASSERT_NEAR(angle.sine, std::sin(2.0 * pi * turns), 1.2e-7) << turns;
        ASSERT_NEAR(angle.cosine, std::cos(2.0 * pi * turns), 1.2e-7) << turns;
    }
}

TEST(Functions, Decay) {
    EXPECT_EQ(expNegative(0.0f), 1.0f);
    EXPECT_EQ(expNegative(86.0f), 0.0f);
    EXPECT_EQ(expNegative(std::numeric_limits<float>::infinity()), 0.0f);
    for (float x = 0.0f; x < 86.0f; x += 0.0037f)
        ASSERT_NEAR(expNegative(x) / std::exp(-static_cast<double>(x)), 1.0, 2e-7 * (1.0 + x)) << x;
}

TEST(Sampling, FramesAreOrthonormal) {
    Random random(501);
    for (int i = 0; i < 10000; ++i) {
        const glm::vec3 n(random.direction());
        const Frame<float> f = makeOrthonormalBasis(n);
        EXPECT_NEAR(dotProduct(f.x, f.y), 0.0f, 2e-6f);
        EXPECT_NEAR(dotProduct(f.x, n), 0.0f, 2e-6f);
        EXPECT_NEAR(dotProduct(crossProduct(f.x, f.y), n), 1.0f, 2e-6f);
    }
    EXPECT_TRUE(std::isfinite(makeOrthonormalBasis(glm::vec3(0, 0, -1)).x.x));
}

TEST(Sampling, CosineHasItsDensity) {
    const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, -0.5f, 0.7f));
    const Frame<float> f = makeOrthonormalBasis(normal);
    expectUniform(502, [&](const Vec2<float> &u) {
        const Vec3<float> d = sampleCosine(normal, u);
        const double cosine = dotProduct(d, normal);
        return Vec2<double>(1.0 - cosine * cosine, atan2Turns(dotProduct(d, f.x), dotProduct(d, f.y)));
    });
    EXPECT_FLOAT_EQ(pdfCosine(1.0f), static_cast<float>(1.0 / pi));
}

TEST(Sampling, TriangleIsUniformOverItsArea) {
    expectUniform(503, [](const Vec2<float> &u) {
        const Vec2<float> weights = sampleTriangle(u); // of the corners (1,0), (0,1), (0,0)
        const double root = 1.0 - weights.x;
        return Vec2<double>(root * root, root > 0.0 ? weights.y / root : 0.0);
    });
}

TEST(Sampling, ConeIsUniformOverItsSolidAngle) {
    const glm::vec3 axis = glm::normalize(glm::vec3(-0.2f, 0.1f, -0.9f));
    const Frame<float> f = makeOrthonormalBasis(axis);
    for (const float squaredRadius : {0.99f, 0.3f, 1e-3f}) {
        const float height = coneHeight(squaredRadius, 1.0f);
        EXPECT_NEAR(height, 1.0 - std::sqrt(1.0 - static_cast<double>(squaredRadius)), 3e-7);
        EXPECT_NEAR(pdfCone(height) * (2.0 * pi * height), 1.0, 1e-6);
        expectUniform(504, [&](const Vec2<float> &u) {
            const Vec3<float> d = sampleCone(axis, height, u);
            const double x = dotProduct(d, f.x);
            const double y = dotProduct(d, f.y);
            const double below = (x * x + y * y) / (1.0 + dotProduct(d, axis));
            return Vec2<double>(below / height, atan2Turns(x, y));
        });
    }
}

TEST(Sampling, SphereIsUniformOverItsArea) {
    expectUniform(505, [](const Vec2<float> &u) {
        const Vec3<float> d = sampleSphere(u);
        return Vec2<double>(0.5 - 0.5 * d.z, atan2Turns(d.x, d.y));
    });
}

TEST(Sampling, WeightsOfTheTwoTechniquesAddUpToOne) {
    Random random(506);
    for (int i = 0; i < 1000; ++i) {
        const float a = static_cast<float>(random.logUniform(1e-6, 1e6));
        const float b = static_cast<float>(random.logUniform(1e-6, 1e6));
        EXPECT_NEAR(powerHeuristic(a, b) + powerHeuristic(b, a), 1.0f, 3e-7f);
        EXPECT_NEAR(powerHeuristic(a, b), a / (a + b * (static_cast<double>(b) / a)), 1e-5);
    }
    EXPECT_EQ(powerHeuristic(2.0f, 0.0f), 1.0f);
    EXPECT_EQ(powerHeuristic(1e30f, 1e30f), 0.5f);
}

TEST(Random, PairsOfDimensionsAreIndependent) {
    // One point in each of 16x16 boxes of two coordinates of different pairs would be a pattern: they are like noise.
    std::vector<int> counts(256, 0);
    for (std::uint32_t pixel = 0; pixel < 64; ++pixel)
        for (std::uint32_t i = 0; i < 1024; ++i) {
            const auto x = sampleBits(pairKeys({pixel, 5}, 1, 3), i).x >> 28;
            const auto y = sampleBits(pairKeys({pixel, 5}, 1, 4), i).x >> 28;
            ++counts[y * 16 + x];
        }
    EXPECT_LT(std::abs(chiSquareDeviations(counts)), 4.0);
}

} // namespace
} // namespace hyalite::core::reference
