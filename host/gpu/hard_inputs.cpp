#include "host/gpu/hard_inputs.h"

#include <cmath>
#include <cstdint>
#include <random>

namespace hyalite::gpu {

namespace {

using Generator = std::mt19937; // the same numbers on every machine, unlike the distributions

constexpr std::int64_t one = std::int64_t{1} << 23; // 1.0 as a significand

/// A float of magnitude 2^-30 to 2^30 with this significand, and the exponent's lowest bit left as asked.
float scale(std::int64_t significand, int exponent) {
    return std::ldexp(static_cast<float>(significand), exponent - 23);
}

/// Draws an odd B and solves 2^k A = c (mod B) for odd c: then 2^k A = N B + c, where N is odd, as B and c are. With
/// k = 25 and A < B, or k = 24 and A >= B, N has 25 bits: the quotient is N/2, but for c / 2B.
void drawQuotient(Generator &generator, HardInput &input) {
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
/// k = 25 or 26, M = (z^2 - c) / 2^k is an integer: its root, times a power of two, is z/2, but for c / 4z.
void drawSquare(Generator &generator, std::size_t index, HardInput &input) {
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

} // namespace

std::vector<HardInput> makeHardInputs(std::size_t count) {
    Generator generator(20);
    std::vector<HardInput> inputs(count);
    for (std::size_t i = 0; i < count; ++i) {
        drawQuotient(generator, inputs[i]);
        drawSquare(generator, i, inputs[i]);
    }
    return inputs;
}

} // namespace hyalite::gpu
