// The hash of scenes and kernels against xxHash's own program.
#include "host/base/hash.h"

#include <gtest/gtest.h>

#include <array>
#include <string_view>
#include <vector>

namespace hyalite::core {
namespace {

TEST(HashBytes, IsXxh64) {
    struct Vector {
        std::size_t sizeBytes;
        std::uint64_t hash;
        std::uint64_t seeded; ///< with the seed 2654435761
    };
    // From libxxhash 0.8.1, for the bytes 1, 8, 15, 22...: each length ends in another way.
    constexpr std::array<Vector, 10> vectors{{{0, 0xef46db3751d8e999, 0xac75fda2929b17ef},
                                              {1, 0x8a4127811b21e730, 0x211ae13247ce135f},
                                              {3, 0xb6e6c910c2fd373a, 0x0ccdb2c7c2850613},
                                              {4, 0x22eda2cf6af4c124, 0x446be1f3228ed3c3},
                                              {7, 0x34084d91a233a751, 0x5410e6030daf84b3},
                                              {8, 0xc6f1803a5e0b3222, 0xb872c2fb02e71655},
                                              {31, 0x6ab1c40e29f50073, 0xbb6d29b38190a8ff},
                                              {32, 0x5a0756fbe9ecd3d1, 0x518cc93bc88a896},
                                              {33, 0xdc50cdc37bb9c183, 0x157ce0e9c56b5988},
                                              {100, 0xd248bfc5208b0b16, 0xbccf07579af475cd}}};
    for (const Vector &vector : vectors) {
        std::vector<std::byte> bytes;
        for (std::size_t i = 0; i < vector.sizeBytes; ++i)
            bytes.push_back(static_cast<std::byte>(i * 7 + 1));
        EXPECT_EQ(hashBytes(bytes), vector.hash) << vector.sizeBytes;
        EXPECT_EQ(hashBytes(bytes, 2654435761), vector.seeded) << vector.sizeBytes;
    }
}

TEST(HashText, HasSixteenDigits) { EXPECT_EQ(hashText(0xabc), "0000000000000abc"); }

// Vectors of the algorithm as others publish them, such as Wikipedia's article "MurmurHash".
TEST(MurmurHash3, IsThatOfThePublishedVectors) {
    EXPECT_EQ(murmurHash3(""), 0u);
    EXPECT_EQ(murmurHash3("test"), 0xba6bd213u);
    EXPECT_EQ(murmurHash3("Hello, world!"), 0xc0363e43u);
    EXPECT_EQ(murmurHash3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
    EXPECT_EQ(murmurHash3(std::string_view("\xff\xff\xff\xff", 4)), 0x76293b50u);
    EXPECT_EQ(murmurHash3(std::string_view("\x21\x43\x65\x87", 4)), 0xf55b516bu);
    EXPECT_EQ(murmurHash3(std::string_view("\x21\x43\x65", 3)), 0x7e4a8634u);
    EXPECT_EQ(murmurHash3(std::string_view("\x21\x43", 2)), 0xa0f7b07au);
    EXPECT_EQ(murmurHash3(std::string_view("\x21", 1)), 0x72661cf4u);
    EXPECT_EQ(murmurHash3(std::string_view("\0\0\0\0", 4)), 0x2362f9deu);
}

} // namespace
} // namespace hyalite::core
