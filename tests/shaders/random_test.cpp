#include "tests/fixtures/leaves.h"

#include "tests/fixtures/geometry_fixture.h"

#include <array>
#include <set>

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::Random;
using hyalite::core::testing::Tally;

TEST(Random, SamplesAreStratifiedInEveryElementaryInterval) {
    // A scrambled (0, 2)-sequence: of the first 2^k samples there is one in each box of 2^-a x 2^-b with a + b = k.
    Random random(301);
    Tally wrong("elementary intervals without exactly one sample", random.seed());
    for (int trial = 0; trial < 60; ++trial) {
        const glm::uvec2 pixel(random.below(32768), random.below(32768));
        const auto seed = static_cast<std::uint32_t>(trial % 3 == 0 ? 0 : random.bits());
        const int most = trial < 3 ? 12 : 8;
        std::vector<Vec2<float>> samples;
        for (std::uint32_t i = 0; i < 1u << most; ++i)
            samples.push_back(samplePixel<float>(layout::samplerSobol, pixel, i, seed));
        for (int k = 0; k <= most; ++k) {
            const std::size_t count = std::size_t{1} << k;
            for (int a = 0; a <= k; ++a) {
                const int b = k - a;
                std::vector<int> inBox(count, 0);
                for (std::size_t i = 0; i < count; ++i) {
                    const auto x = static_cast<std::size_t>(std::ldexp(samples[i].x, a));
                    const auto y = static_cast<std::size_t>(std::ldexp(samples[i].y, b));
                    ++inBox[(x << b) + y];
                }
                wrong.check(std::ranges::all_of(inBox, [](int inside) { return inside == 1; }), [&] {
                    return fmt::format("pixel {} {}, seed {}, {} x {} boxes", pixel.x, pixel.y, seed, 1 << a,
                                       1 << b);
                });
            }
        }
    }
    wrong.expectNone();
}

TEST(Random, EveryAlignedBlockOfSamplesIsStratifiedToo) {
    // Samples 2^k j to 2^k (j+1) - 1: what a resumed render adds is as good as what it began with.
    Random random(302);
    for (int trial = 0; trial < 200; ++trial) {
        const glm::uvec2 pixel(random.below(512), random.below(512));
        const std::uint32_t begin = static_cast<std::uint32_t>(random.below(4096)) * 16;
        std::set<std::pair<int, int>> boxes;
        for (std::uint32_t i = begin; i < begin + 16; ++i) {
            const Vec2<float> sample = samplePixel<float>(layout::samplerSobol, pixel, i, 7);
            boxes.insert({static_cast<int>(sample.x * 4.0f), static_cast<int>(sample.y * 4.0f)});
        }
        EXPECT_EQ(boxes.size(), 16u) << "seed " << random.seed() << ", trial " << trial;
    }
}

TEST(Random, SamplesLieInTheHalfOpenUnitSquare) {
    Random random(303);
    Tally wrong("samples outside of [0, 1)^2", random.seed());
    for (int i = 0; i < 1'000'000; ++i) {
        const glm::uvec2 pixel(static_cast<std::uint32_t>(random.bits()),
                               static_cast<std::uint32_t>(random.bits()));
        const auto index = static_cast<std::uint32_t>(random.bits());
        const auto seed = static_cast<std::uint32_t>(random.bits());
        const Vec2<float> sample = samplePixel<float>(layout::samplerSobol, pixel, index, seed);
        wrong.check(sample.x >= 0 && sample.x < 1 && sample.y >= 0 && sample.y < 1);
        const Vec2<double> wide = samplePixel<double>(layout::samplerSobol, pixel, index, seed);
        wrong.check(wide == Vec2<double>(sample));
    }
    wrong.expectNone();
    EXPECT_EQ(unitFloat<float>(0), 0.0f);
    EXPECT_EQ(unitFloat<float>(0xFFu), 0.0f);
    EXPECT_EQ(unitFloat<float>(0x100u), 0x1p-24f);
    EXPECT_EQ(unitFloat<float>(0x80000000u), 0.5f);
    EXPECT_EQ(unitFloat<float>(0xFFFFFFFFu), 1.0f - 0x1p-24f);
    EXPECT_EQ(unitFloat<double>(0xFFFFFFFFu), 1.0 - 0x1p-24);
}

TEST(Random, TheCentreSamplerKnowsOnlyTheCentre) {
    for (std::uint32_t i = 0; i < 100; ++i)
        EXPECT_EQ(samplePixel<float>(layout::samplerCentre, {i, 3 * i}, i, 5 * i), Vec2<float>(0.5f));
}

TEST(Random, OwenScrambleIsABijection) {
    // On the top 16 bits, which by nesting depend on nothing else; and no two of a million inputs collide.
    Random random(304);
    for (int trial = 0; trial < 8; ++trial) {
        const auto key = static_cast<std::uint32_t>(random.bits());
        std::vector<bool> isTaken(1u << 16, false);
        for (std::uint32_t x = 0; x < 1u << 16; ++x) {
            const std::uint32_t image = owenScramble(x << 16, key) >> 16;
            EXPECT_FALSE(isTaken[image]) << "key " << key;
            isTaken[image] = true;
        }
        std::vector<std::uint32_t> images;
        const auto start = static_cast<std::uint32_t>(random.bits());
        for (std::uint32_t i = 0; i < 100'000; ++i)
            images.push_back(owenScramble(start + i, key));
        std::sort(images.begin(), images.end());
        EXPECT_EQ(std::adjacent_find(images.begin(), images.end()), images.end()) << "key " << key;
    }
}

TEST(Random, OwenScrambleKeepsWhatIsNestedNested) {
    // Two inputs agree in exactly as many leading bits as their images do.
    Random random(305);
    Tally wrong("prefixes that are not kept", random.seed());
    for (int i = 0; i < 1'000'000; ++i) {
        const auto key = static_cast<std::uint32_t>(random.bits());
        const auto x = static_cast<std::uint32_t>(random.bits());
        const int common = static_cast<int>(random.below(32));
        const std::uint32_t firstDifferent = 0x80000000u >> common;
        const std::uint32_t y =
            x ^ firstDifferent ^ (static_cast<std::uint32_t>(random.bits()) & (firstDifferent - 1));
        wrong.check(std::countl_zero(owenScramble(x, key) ^ owenScramble(y, key)) == common);
    }
    wrong.expectNone();
}

TEST(Random, OwenScrambleFlipsEachBitHalfOfTheTime) {
    // Given everything above it, a bit is flipped for about half of all keys: within 5 standard deviations of 8192
    // keys.
    Random random(306);
    for (const std::uint32_t x : {0u, 0xFFFFFFFFu, 0x12345678u}) {
        std::array<int, 32> flips{};
        for (int i = 0; i < 8192; ++i) {
            const std::uint32_t change = owenScramble(x, static_cast<std::uint32_t>(random.bits())) ^ x;
            for (std::size_t bit = 0; bit < 32; ++bit)
                flips[bit] += static_cast<int>(change >> bit & 1u);
        }
        for (std::size_t bit = 0; bit < 32; ++bit)
            EXPECT_NEAR(flips[bit], 4096, 5 * 45.3)
                << "bit " << bit << " of " << x << ", seed " << random.seed();
    }
}

TEST(Random, ReverseBitsMirrorsThem) {
    EXPECT_EQ(bitfieldReverse(1u), 0x80000000u);
    EXPECT_EQ(bitfieldReverse(0x80000000u), 1u);
    EXPECT_EQ(bitfieldReverse(0x12345678u), 0x1E6A2C48u);
    for (int bit = 0; bit < 32; ++bit)
        EXPECT_EQ(bitfieldReverse(1u << bit), 1u << (31 - bit));
    Random random(307);
    for (int i = 0; i < 1000; ++i) {
        const auto x = static_cast<std::uint32_t>(random.bits());
        EXPECT_EQ(bitfieldReverse(bitfieldReverse(x)), x);
    }
}

/// Sobol's second dimension by its definition: the primitive polynomial x + 1 with m1 = 1, so that
/// m_k = 2 m_{k-1} xor m_{k-1}, and v_k = m_k 2^(32-k). Joe and Kuo, "Notes on generating Sobol sequences", 2008.
std::uint32_t sobolByDefinition(std::uint32_t index) {
    std::uint64_t m = 1;
    std::uint32_t point = 0;
    for (int k = 1; k <= 32; ++k) {
        if ((index >> (k - 1) & 1u) != 0)
            point ^= static_cast<std::uint32_t>(m << (32 - k));
        m = (2 * m) ^ m;
    }
    return point;
}

TEST(Random, TheSecondSobolCoordinateFollowsItsDirectionNumbers) {
    // The first points of the sequence, by hand: 0, 1/2, 3/4, 1/4, 5/8, 1/8, 3/8, 7/8.
    const std::uint32_t eighths[] = {0, 4, 6, 2, 5, 1, 3, 7};
    for (std::uint32_t i = 0; i < 8; ++i)
        EXPECT_EQ(secondSobolCoordinate(bitfieldReverse(i)), eighths[i] << 29) << i;
    Random random(308);
    Tally wrong("coordinates unlike Sobol's", random.seed());
    for (std::uint32_t i = 0; i < 70'000; ++i)
        wrong.check(secondSobolCoordinate(bitfieldReverse(i)) == sobolByDefinition(i));
    for (int i = 0; i < 200'000; ++i) {
        const auto index = static_cast<std::uint32_t>(random.bits());
        wrong.check(secondSobolCoordinate(bitfieldReverse(index)) == sobolByDefinition(index));
    }
    for (int bit = 0; bit < 32; ++bit)
        wrong.check(secondSobolCoordinate(bitfieldReverse(1u << bit)) == sobolByDefinition(1u << bit));
    wrong.expectNone();
}

/// pcg3d in 64 bits with explicit reductions, as printed in the paper's listing.
glm::uvec3 pcg3dByDefinition(const glm::uvec3 &keys) {
    constexpr std::uint64_t modulus = std::uint64_t{1} << 32;
    std::uint64_t x = (keys.x * std::uint64_t{1664525} + 1013904223) % modulus;
    std::uint64_t y = (keys.y * std::uint64_t{1664525} + 1013904223) % modulus;
    std::uint64_t z = (keys.z * std::uint64_t{1664525} + 1013904223) % modulus;
    for (int round = 0; round < 2; ++round) {
        x = (x + y * z % modulus) % modulus;
        y = (y + z * x % modulus) % modulus;
        z = (z + x * y % modulus) % modulus;
        if (round == 0) {
            x ^= x / 65536;
            y ^= y / 65536;
            z ^= z / 65536;
        }
    }
    return {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z)};
}

TEST(Random, HashIsPcg3d) {
    EXPECT_EQ(hashKeys({0, 0, 0}), glm::uvec3(0x9bafd7c6u, 0xa8e88a6bu, 0x3f15482cu));
    EXPECT_EQ(hashKeys({1, 2, 3}), glm::uvec3(0xfa9f79a6u, 0x48f2f44cu, 0x596f5ab1u));
    EXPECT_EQ(hashKeys({0xFFFFFFFFu, 0x80000000u, 512u}), glm::uvec3(0xa2ac2c45u, 0xf4f99204u, 0x013ee1e6u));
    Random random(309);
    for (int i = 0; i < 100'000; ++i) {
        const glm::uvec3 keys(static_cast<std::uint32_t>(random.bits()),
                              static_cast<std::uint32_t>(random.bits()),
                              static_cast<std::uint32_t>(random.bits()));
        ASSERT_EQ(hashKeys(keys), pcg3dByDefinition(keys)) << "seed " << random.seed();
    }
}

TEST(Random, PixelsAndSeedsDiffer) {
    std::set<std::pair<float, float>> firstSamples;
    constexpr std::uint32_t side = 64;
    for (std::uint32_t seed = 0; seed < 4; ++seed) {
        for (std::uint32_t y = 0; y < side; ++y) {
            for (std::uint32_t x = 0; x < side; ++x) {
                const Vec2<float> sample = samplePixel<float>(layout::samplerSobol, {x, y}, 0, seed);
                firstSamples.insert({sample.x, sample.y});
            }
        }
    }
    EXPECT_EQ(firstSamples.size(), 4 * side * side);
}

TEST(Random, NeighbouringPixelsAreUncorrelated) {
    double product = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    constexpr std::uint32_t side = 256;
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const double here =
                static_cast<double>(samplePixel<float>(layout::samplerSobol, {x, y}, 0, 0).x) - 0.5;
            const double right =
                static_cast<double>(samplePixel<float>(layout::samplerSobol, {x + 1, y}, 0, 0).x) - 0.5;
            product += here * right;
            sum += here;
            squares += here * here;
        }
    }
    const double count = side * side;
    // Independent: standard deviations 1/sqrt(12 n) of the mean, about 1/(12 sqrt(n)) of the products' mean.
    EXPECT_NEAR(sum / count, 0.0, 5.0 / std::sqrt(12.0 * count));
    EXPECT_NEAR(squares / count, 1.0 / 12.0, 5.0 * 0.0745 / std::sqrt(count));
    EXPECT_NEAR(product / count, 0.0, 5.0 / (12.0 * std::sqrt(count)));
}

TEST(Random, MeanAndVarianceWithinAPixelAreThoseOfTheUniformSquare) {
    Random random(310);
    for (int trial = 0; trial < 20; ++trial) {
        const glm::uvec2 pixel(random.below(4096), random.below(4096));
        Vec2<double> sum(0.0);
        Vec2<double> squares(0.0);
        double product = 0.0;
        constexpr int count = 4096;
        for (std::uint32_t i = 0; i < count; ++i) {
            const Vec2<double> sample = samplePixel<double>(layout::samplerSobol, pixel, i, 1);
            sum += sample;
            squares += sample * sample;
            product += (sample.x - 0.5) * (sample.y - 0.5);
        }
        // Stratified: far better than the 1/64 of random points.
        for (int axis = 0; axis < 2; ++axis) {
            EXPECT_NEAR(sum[axis] / count, 0.5, 1e-4) << "seed " << random.seed();
            EXPECT_NEAR(squares[axis] / count, 1.0 / 3.0, 2e-4) << "seed " << random.seed();
        }
        EXPECT_NEAR(product / count, 0.0, 1e-3) << "seed " << random.seed();
    }
}

} // namespace
} // namespace hyalite::core::reference
