// divide and squareRoot of shaders/math/arithmetic.glsl, and the device's own, against IEEE 754.
#include "host/gpu/hard_inputs.h"
#include "tests/kernels/draw.h"
#include "tests/kernels/probe_device.h"
#include "tests/kernels/words.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hyalite::core::testing {
namespace {

using gpu::Arithmetic;

constexpr float smallestNormal = std::numeric_limits<float>::min();

std::uint32_t bitsOf(float x) { return std::bit_cast<std::uint32_t>(x); }

bool isSubnormal(float x) { return std::fpclassify(x) == FP_SUBNORMAL; }

/// Subnormal inputs may count as zeros; below 2^-126 a quotient may become a zero.
bool isRightQuotient(float a, float b, std::uint32_t result) {
    const float quotient = a / b;
    if (isSame({bitsOf(quotient), true}, result))
        return true;
    if (isSubnormal(a) || isSubnormal(b)) {
        const float flushedA = isSubnormal(a) ? std::copysign(0.0f, a) : a;
        const float flushedB = isSubnormal(b) ? std::copysign(0.0f, b) : b;
        return isSame({bitsOf(flushedA / flushedB), true}, result);
    }
    const bool isTiny = std::abs(double{a} / double{b}) < double{smallestNormal};
    return isTiny && result == bitsOf(std::copysign(0.0f, quotient));
}

bool isRightRoot(float x, std::uint32_t result) {
    if (isSame({bitsOf(std::sqrt(x)), true}, result))
        return true;
    return isSubnormal(x) && result == bitsOf(std::copysign(0.0f, x));
}

struct Pair {
    float a;
    float b;
};

/// Runs divide(a, b) for any number of pairs drawn by `next`, in dispatches of probeInputCount.
template <class Next> void expectQuotients(Arithmetic arithmetic, int dispatchCount, Next &&next) {
    Probe probe(probedQuotient, 2, 1, arithmetic);
    std::vector<std::uint32_t> inputs(2 * probeInputCount);
    std::size_t wrongCount = 0;
    for (int dispatch = 0; dispatch < dispatchCount; ++dispatch) {
        for (std::size_t i = 0; i < probeInputCount; ++i) {
            const Pair pair = next();
            inputs[2 * i] = bitsOf(pair.a);
            inputs[2 * i + 1] = bitsOf(pair.b);
        }
        const std::vector<std::uint32_t> results = probe.run(inputs);
        for (std::size_t i = 0; i < probeInputCount; ++i) {
            const float a = std::bit_cast<float>(inputs[2 * i]);
            const float b = std::bit_cast<float>(inputs[2 * i + 1]);
            if (!isRightQuotient(a, b, results[i]) && ++wrongCount < 5)
                ADD_FAILURE() << fmt::format("{:a} / {:a} is {:a}, not {:a}", a, b, a / b,
                                             std::bit_cast<float>(results[i]));
        }
    }
    EXPECT_EQ(wrongCount, 0u) << "seed " << Draw::seed;
}

template <class Next> void expectRoots(Arithmetic arithmetic, int dispatchCount, Next &&next) {
    Probe probe(probedRoot, 1, 1, arithmetic);
    std::vector<std::uint32_t> inputs(probeInputCount);
    std::size_t wrongCount = 0;
    for (int dispatch = 0; dispatch < dispatchCount; ++dispatch) {
        for (std::uint32_t &input : inputs)
            input = bitsOf(next());
        const std::vector<std::uint32_t> results = probe.run(inputs);
        for (std::size_t i = 0; i < probeInputCount; ++i) {
            const float x = std::bit_cast<float>(inputs[i]);
            if (!isRightRoot(x, results[i]) && ++wrongCount < 5)
                ADD_FAILURE() << fmt::format("sqrt({:a}) is {:a}, not {:a}", x, std::sqrt(x),
                                             std::bit_cast<float>(results[i]));
        }
    }
    EXPECT_EQ(wrongCount, 0u) << "seed " << Draw::seed;
}

/// Both signs of what IEEE 754 singles out, and neighbours.
std::vector<float> specialValues() {
    std::vector<float> values;
    for (const float x : {0.0f,
                          std::numeric_limits<float>::infinity(),
                          std::numeric_limits<float>::quiet_NaN(),
                          1.0f,
                          2.0f,
                          3.0f,
                          std::nextafter(1.0f, 0.0f),
                          std::nextafter(1.0f, 2.0f),
                          smallestNormal,
                          std::nextafter(smallestNormal, 1.0f),
                          2.0f * smallestNormal,
                          std::numeric_limits<float>::max(),
                          std::nextafter(std::numeric_limits<float>::max(), 0.0f),
                          0x1p127f,
                          0x1p-63f,
                          0x1p63f,
                          0x1p64f,
                          0x1p-126f,
                          0x1.fffffep-1f,
                          0x1.fffffep+63f,
                          std::numeric_limits<float>::denorm_min(),
                          std::nextafter(smallestNormal, 0.0f)}) {
        values.push_back(x);
        values.push_back(-x);
    }
    return values;
}

float withExponent(std::uint32_t word, std::uint32_t exponent) {
    return std::bit_cast<float>((word & 0x807FFFFFu) | exponent << 23);
}

class Division : public ::testing::TestWithParam<Arithmetic> {
  protected:
    void SetUp() override {
        if (GetParam() == Arithmetic::Native && !isDivisionNative())
            GTEST_SKIP() << "renders do not use this device's own / and sqrt";
    }
};

INSTANTIATE_TEST_SUITE_P(Both, Division, ::testing::Values(Arithmetic::Native, Arithmetic::Own),
                         [](const auto &test) {
                             return test.param == Arithmetic::Native ? "Native" : "Own";
                         });

TEST_P(Division, IsExactForSpecialValues) {
    const std::vector<float> values = specialValues();
    std::size_t i = 0;
    expectQuotients(GetParam(), 1, [&] {
        const std::size_t at = i++ % (values.size() * values.size());
        return Pair{values[at / values.size()], values[at % values.size()]};
    });
}

TEST_P(Division, IsExactForAllWords) {
    Draw draw;
    expectQuotients(GetParam(), 32, [&] {
        const float a = std::bit_cast<float>(draw.word());
        return Pair{a, std::bit_cast<float>(draw.word())};
    });
}

// 254 * 254 pairs of exponents, 16 times each.
TEST_P(Division, IsExactForAllExponents) {
    Draw draw;
    std::uint32_t i = 0;
    expectQuotients(GetParam(), 16, [&] {
        const std::uint32_t at = i++ % (254 * 254);
        const float a = withExponent(draw.word(), 1 + at / 254);
        return Pair{a, withExponent(draw.word(), 1 + at % 254)};
    });
}

// Every denominator's significand, by 1 and by a random numerator.
TEST_P(Division, IsExactForAllSignificands) {
    Draw draw;
    std::uint32_t significand = 0;
    expectQuotients(GetParam(), 128, [&] { return Pair{1.0f, withExponent(significand++, 127)}; });
    expectQuotients(GetParam(), 128, [&] {
        return Pair{withExponent(draw.word(), 127), withExponent(significand++, 127)};
    });
}

TEST_P(Division, IsExactNearHalfway) {
    const std::vector<layout::HardInput> hard = gpu::makeHardInputs(8 * probeInputCount);
    std::size_t i = 0;
    expectQuotients(GetParam(), 8, [&] {
        const layout::HardInput &input = hard[i++];
        return Pair{input.numerator, input.denominator};
    });
}

// Products of floats divided by a factor, and their neighbours: quotients that are floats, or nearly.
TEST_P(Division, IsExactNearFloats) {
    Draw draw;
    expectQuotients(GetParam(), 16, [&] {
        const float quotient = withExponent(draw.word() & ~0xFFFu, 100 + draw.index(50));
        const float b = withExponent(draw.word() & ~0xFFFu, 100 + draw.index(50));
        const float a = quotient * b;
        return Pair{std::bit_cast<float>(bitsOf(a) + draw.index(5) - 2u), b};
    });
}

class SquareRoot : public Division {};

INSTANTIATE_TEST_SUITE_P(Both, SquareRoot, ::testing::Values(Arithmetic::Native, Arithmetic::Own),
                         [](const auto &test) {
                             return test.param == Arithmetic::Native ? "Native" : "Own";
                         });

TEST_P(SquareRoot, IsExactForSpecialValues) {
    const std::vector<float> values = specialValues();
    std::size_t i = 0;
    expectRoots(GetParam(), 1, [&] { return values[i++ % values.size()]; });
}

TEST_P(SquareRoot, IsExactForAllWords) {
    Draw draw;
    expectRoots(GetParam(), 16, [&] { return std::bit_cast<float>(draw.word()); });
}

// All 2^24 inputs in [1, 4). The exponent's other bits only reach the result's exponent, which the next test covers: so
// this is a proof.
TEST_P(SquareRoot, IsExactForAllSignificands) {
    std::uint32_t word = bitsOf(1.0f);
    expectRoots(GetParam(), 256, [&] { return std::bit_cast<float>(word++); });
}

TEST_P(SquareRoot, IsExactForAllExponents) {
    Draw draw;
    std::uint32_t i = 0;
    expectRoots(GetParam(), 4, [&] { return withExponent(draw.word() & 0x7FFFFFu, 1 + i++ % 254); });
}

TEST_P(SquareRoot, IsExactNearHalfway) {
    const std::vector<layout::HardInput> hard = gpu::makeHardInputs(probeInputCount);
    std::size_t i = 0;
    expectRoots(GetParam(), 1, [&] { return hard[i++].square; });
}

// The distance from the middle between two floats, in units of the last place: in double, within 2^-27 of it.
double distanceFromHalfway(double exact) {
    int exponent = 0;
    const double significand = std::ldexp(std::frexp(std::abs(exact), &exponent), 24);
    return std::abs(significand - std::floor(significand) - 0.5);
}

TEST(HardInputs, LieNearTheMiddle) {
    for (const layout::HardInput &input : gpu::makeHardInputs(1000)) {
        EXPECT_LT(distanceFromHalfway(double{input.numerator} / double{input.denominator}), 0x1p-22);
        EXPECT_LT(distanceFromHalfway(std::sqrt(double{input.square})), 0x1p-12);
        EXPECT_TRUE(std::isnormal(input.numerator) && std::isnormal(input.denominator));
        EXPECT_TRUE(std::isnormal(input.square) && input.square > 0.0f);
        EXPECT_LT(distanceFromHalfway(double{input.addend} + double{input.otherAddend}), 0x1p-22);
        EXPECT_LT(distanceFromHalfway(double{input.addend} - double{input.otherAddend}), 0x1p-22);
        EXPECT_LT(distanceFromHalfway(double{input.factor} * double{input.otherFactor}), 0x1p-22);
        EXPECT_LT(distanceFromHalfway(static_cast<double>(input.integer)), 0x1p-6);
    }
}

} // namespace
} // namespace hyalite::core::testing
