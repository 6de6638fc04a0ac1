#include "host/gpu/hard_inputs.h"

#include <cmath>
#include <cstdint>
#include <random>

namespace hyalite::core::gpu {

namespace {

using Generator = std::mt19937; // the same numbers on every machine, unlike the distributions

constexpr std::int64_t one = std::int64_t{1} << 23; // 1.0 as a significand

/// A float of magnitude 2^-30 to 2^30 with this significand, and the exponent's lowest bit left as asked.
float scale(std::int64_t significand, int exponent) {
    return std::ldexp(static_cast<float>(significand), exponent - 23);
}

/// Draws an odd B and solves 2^k A = c (mod B) for odd c: then 2^k A = N B + c, where N is odd, as B and c are. With
/// k = 25 and A < B, or k = 24 and A >= B, N has 25 bits: the quotient is N/2, except for c / 2B.
void drawQuotient(Generator &generator, layout::HardInput &input) {
    for (;;) {
        const std::int64_t b = one + (generator() % one | 1);
        const bool isBelowOne = generator() % 2 == 0;
        constexpr std::int64_t offsets[4] = {1, -1, 3, -3};
        std::int64_t a = offsets[generator() % 4];
        for (int halvings = isBelowOne ? 25 : 24; halvings > 0; --halvings)
            a = (a % 2 == 0 ? a : a + b) / 2;
        a = (a % b + b) % b;
        if (!isBelowOne)
            a += b;
        if (a < one || a >= 2 * one)
            continue;
        const int exponentA = static_cast<int>(generator() % 61) - 30;
        const int exponentB = static_cast<int>(generator() % 61) - 30;
        input.numerator = scale(generator() % 2 == 0 ? a : -a, exponentA);
        input.denominator = scale(generator() % 2 == 0 ? b : -b, exponentB);
        return;
    }
}

/// Draws c = 1 (mod 8) and solves z^2 = c (mod 2^k) bit by bit; the other roots are -z and these plus 2^(k-1). With
/// k = 25 or 26, M = (z^2 - c) / 2^k is an integer: its root, times a power of two, is z/2, except for c / 4z.
void drawSquare(Generator &generator, std::size_t index, layout::HardInput &input) {
    for (;;) {
        const std::int64_t magnitude = 8 * static_cast<std::int64_t>(generator() % (index + 1));
        const std::int64_t c = generator() % 2 == 0 ? 1 + magnitude : -7 - magnitude;
        const bool isOdd = generator() % 2 == 0; // the exponent
        const int k = isOdd ? 26 : 25;
        const std::int64_t modulus = std::int64_t{1} << k;
        std::int64_t z = 1;
        for (int bit = 3; bit < k; ++bit)
            if ((((z * z - c) >> bit) & 1) != 0)
                z += std::int64_t{1} << (bit - 1);
        if (generator() % 2 == 0)
            z = -z;
        if (generator() % 2 == 0)
            z += modulus / 2;
        z = (z % modulus + modulus) % modulus;
        const std::int64_t significand = (z * z - c) / modulus;
        if (significand < one || significand >= 2 * one)
            continue;
        const int exponent = 2 * (static_cast<int>(generator() % 31) - 15);
        input.square = scale(significand, exponent + (isOdd ? 1 : 0));
        return;
    }
}

/// Draws a float, and half of its last place except for -1, 0 or 1 in the half's own last place, so that the sum and
/// the difference are hard to round.
void drawSum(Generator &generator, layout::HardInput &input) {
    const std::int64_t a = one + generator() % one;
    const std::int64_t b = one + generator() % 3 - 1;
    const int exponent = static_cast<int>(generator() % 61) - 30;
    input.addend = scale(generator() % 2 == 0 ? a : -a, exponent);
    input.otherAddend = scale(generator() % 2 == 0 ? b : -b, exponent - 24);
}

/// Draws an odd B and solves A B = 2^23 + c (mod 2^24) for c = -1, 0, 1. Where the product has 48 bits, its upper 24
/// are the float, and the lower ones half of its last place, except for c.
void drawProduct(Generator &generator, layout::HardInput &input) {
    constexpr std::int64_t modulus = 2 * one;
    for (;;) {
        const std::int64_t b = one + (generator() % one | 1);
        std::int64_t inverse = b; // of b, by Newton's iteration from 3 right bits on
        for (int rightBits = 3; rightBits < 24; rightBits *= 2)
            inverse = inverse * ((2 - b * inverse) % modulus) % modulus;
        const std::int64_t c = generator() % 3;
        const std::int64_t a = ((one - 1 + c) * inverse % modulus + modulus) % modulus;
        if (a < one || a * b < (std::int64_t{1} << 47))
            continue;
        input.factor = scale(generator() % 2 == 0 ? a : -a, static_cast<int>(generator() % 61) - 30);
        input.otherFactor = scale(generator() % 2 == 0 ? b : -b, static_cast<int>(generator() % 61) - 30);
        return;
    }
}

/// Draws 24 bits above a one and six zeros, except for -1, 0 or 1.
void drawInteger(Generator &generator, layout::HardInput &input) {
    const auto magnitude =
        static_cast<std::int32_t>((one + generator() % one) * 128 + 64 + generator() % 3 - 1);
    input.integer = generator() % 2 == 0 ? magnitude : -magnitude;
}

} // namespace

std::vector<layout::HardInput> makeHardInputs(std::size_t count) {
    Generator generator(20);
    std::vector<layout::HardInput> inputs(count);
    for (std::size_t i = 0; i < count; ++i) {
        drawQuotient(generator, inputs[i]);
        drawSquare(generator, i, inputs[i]);
        drawSum(generator, inputs[i]);
        drawProduct(generator, inputs[i]);
        drawInteger(generator, inputs[i]);
    }
    return inputs;
}

} // namespace hyalite::core::gpu
