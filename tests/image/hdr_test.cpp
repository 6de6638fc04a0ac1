#include "tests/fixtures/picture_fixture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STBI_ONLY_HDR
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace hyalite::core {
namespace {

using Hdr = testing::PictureFiles;

/// The picture as another reader sees it.
Image readByStb(const std::filesystem::path &path) {
    int width = 0;
    int height = 0;
    int channelCount = 0;
    const std::unique_ptr<float, void (*)(void *)> values(
        stbi_loadf(path.c_str(), &width, &height, &channelCount, 3), stbi_image_free);
    EXPECT_NE(values, nullptr) << stbi_failure_reason();
    Image image(width, height);
    if (values)
        std::copy_n(values.get(), image.pixels().size() * 3, &image.pixels().front().x);
    return image;
}

/// A step of the format at a colour.
float stepAt(const glm::vec3 &colour) {
    int exponent = 0;
    const float mantissa = std::frexp(std::max({colour.x, colour.y, colour.z}), &exponent);
    return std::ldexp(1.0f, exponent - (mantissa * 256.0f < 255.5f ? 8 : 7)); // 256 is one too many
}

TEST_F(Hdr, ValuesAreRoundedToTheNearest) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> exponents(-100.0f, 100.0f);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    Image image(200, 100);
    for (glm::vec3 &pixel : image.pixels())
        pixel = std::exp2(exponents(random)) * glm::vec3(uniform(random), uniform(random), uniform(random));
    const Image read = readByStb(write("a.hdr", image));
    ASSERT_EQ(read.pixels().size(), image.pixels().size());
    double signedError = 0.0;
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
        for (int channel = 0; channel < 3; ++channel) {
            const float step = stepAt(image.pixels()[i]);
            const float error = read.pixels()[i][channel] - image.pixels()[i][channel];
            ASSERT_LE(std::abs(error),
                      step * (0.5f + 1.0f / 256.0f)); // in the last step before a power of two
            signedError += static_cast<double>(error / step);
        }
    EXPECT_NEAR(signedError / static_cast<double>(3 * image.pixels().size()), 0.0, 0.01);
}

TEST_F(Hdr, RowsOfEveryWidthComeBack) {
    // Plain below 8 pixels; runs end at 127, plain stretches at 128.
    for (const int width : {1, 2, 7, 8, 9, 126, 127, 128, 129, 254, 255, 256, 257, 700}) {
        Image image(width, 6);
        for (int x = 0; x < width; ++x) {
            image.at(x, 0) = glm::vec3(1.0f);                                          // one run
            image.at(x, 1) = glm::vec3(static_cast<float>(128 + x % 128), 0.0f, 0.0f); // no run
            image.at(x, 2) = glm::vec3(static_cast<float>(1 + x / 2 % 2)); // pairs: too short for runs
            image.at(x, 3) = glm::vec3(static_cast<float>(1 + x / 3 % 2));
            image.at(x, 4) = glm::vec3(0.5f, x % 131 < 128 ? static_cast<float>(x % 2) : 1.0f, 0.25f);
            image.at(x, 5) = glm::vec3(x < 5 ? 2.0f : 3.0f);
        }
        EXPECT_TRUE(testing::sameBits(readByStb(write("a.hdr", image)), image)) << width;
    }
}

TEST_F(Hdr, WhatTheFormatCannotHoldIsBounded) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float largest = std::numeric_limits<float>::max();
    Image image(1, 6);
    image.at(0, 0) = {-1.0f, std::numeric_limits<float>::quiet_NaN(), 1.0f};
    image.at(0, 1) = {infinity, 1.0f, -infinity};
    image.at(0, 2) = {largest, 0.0f, 0.0f};
    image.at(0, 3) = glm::vec3(1e-42f);        // denormal
    image.at(0, 4) = {0x0.fffp0f, 0.0f, 0.0f}; // rounded up to the next power of two
    image.at(0, 5) = {std::ldexp(1.0f, -120), 0.0f, 0.0f};
    const Image read = readByStb(write("a.hdr", image));
    const float formatLargest = std::ldexp(255.0f, 119);
    EXPECT_EQ(read.at(0, 0), glm::vec3(0.0f, 0.0f, 1.0f));
    EXPECT_EQ(read.at(0, 1), glm::vec3(formatLargest, 0.0f, 0.0f));
    EXPECT_EQ(read.at(0, 2), glm::vec3(formatLargest, 0.0f, 0.0f));
    EXPECT_EQ(read.at(0, 3), glm::vec3(0.0f));
    EXPECT_EQ(read.at(0, 4), glm::vec3(1.0f, 0.0f, 0.0f));
    EXPECT_EQ(read.at(0, 5), image.at(0, 5));
}

TEST_F(Hdr, WhatIsWrittenIsReadAsAnotherReaderReadsIt) {
    for (const int width : {1, 7, 8, 130, 700}) {
        Image image = testing::randomBits(width, 20, static_cast<std::uint32_t>(width));
        for (int x = 0; x < width; ++x)
            image.at(x, 3) = glm::vec3(0.25f);
        const std::filesystem::path path = write("a.hdr", image);
        const LoadedImage loaded = readImage(path);
        EXPECT_EQ(loaded.encoding, Encoding::Linear);
        EXPECT_TRUE(testing::sameBits(loaded.image, readByStb(path))) << width;
    }
}

const std::string head = "#?RADIANCE\n# a comment\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n";

TEST_F(Hdr, OldRunsAreRead) {
    using namespace std::string_literals;
    // A pixel, 3 times more; another, 0 + 256 times more.
    const Image image =
        readImage(
            store("a.hdr", head + "-Y 1 +X 261\n\x80\x40\x20\x81\1\1\1\3\x40\x80\x40\x82\1\1\1\0\1\1\1\1"s))
            .image;
    ASSERT_EQ(image.width(), 261);
    for (int x = 0; x < 261; ++x)
        EXPECT_EQ(image.at(x, 0), x < 4 ? glm::vec3(1.0f, 0.5f, 0.25f) : glm::vec3(1.0f, 2.0f, 1.0f)) << x;
}

TEST_F(Hdr, LineEndsOfOtherSystemsAndOtherNamesAreRead) {
    EXPECT_EQ(readImage(store("a.pic", "#?RGBE\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n-Y 1 +X 1\n\x80\x40\x20\x81"))
                  .image.at(0, 0),
              glm::vec3(1.0f, 0.5f, 0.25f));
}

TEST_F(Hdr, HasAnyOrientation) {
    using namespace std::string_literals;
    const auto pixel = [](int level) { return std::string(3, static_cast<char>(16 * level)) + "\x80"s; };
    // Three columns, two rows: 1 2 3 above 4 5 6.
    const std::array<std::pair<const char *, std::array<int, 6>>, 8> orientations{{
        {"-Y 2 +X 3", {1, 2, 3, 4, 5, 6}},
        {"-Y 2 -X 3", {3, 2, 1, 6, 5, 4}},
        {"+Y 2 +X 3", {4, 5, 6, 1, 2, 3}},
        {"+Y 2 -X 3", {6, 5, 4, 3, 2, 1}},
        {"+X 3 -Y 2", {1, 4, 2, 5, 3, 6}},
        {"+X 3 +Y 2", {4, 1, 5, 2, 6, 3}},
        {"-X 3 -Y 2", {3, 6, 2, 5, 1, 4}},
        {"-X 3 +Y 2", {6, 3, 5, 2, 4, 1}},
    }};
    for (const auto &[size, order] : orientations) {
        std::string bytes = "#?RADIANCE\n\n"s + size + "\n";
        for (const int level : order)
            bytes += pixel(level);
        const Image image = readImage(store("a.hdr", bytes)).image;
        ASSERT_EQ(image.width(), 3) << size;
        ASSERT_EQ(image.height(), 2) << size;
        for (int i = 0; i < 6; ++i)
            EXPECT_EQ(image.at(i % 3, i / 3).x, static_cast<float>(i + 1) / 16.0f) << size << ' ' << i;
    }
}

TEST_F(Hdr, DamagedFilesAreRefused) {
    using namespace std::string_literals;
    const std::string good = head + "-Y 2 +X 8\n" + "\2\2\0\x08\x88\x80\x88\x40\x88\x20\x88\x81"s +
                             "\2\2\0\x08\4abcd\x84z\x88\x40\x88\x20\x88\x81"s;
    EXPECT_EQ(readImage(store("good.hdr", good)).image.at(7, 0), glm::vec3(1.0f, 0.5f, 0.25f));
    for (std::size_t size = 2; size < good.size(); ++size)
        expectBad(store("a.hdr", good.substr(0, size)), "cut short");
    EXPECT_EQ(readImage(store("padded.hdr", good + "x")).image.at(7, 0), glm::vec3(1.0f, 0.5f, 0.25f));
    const auto refused = [&](const std::string &text, const std::string &found) {
        expectBad(store("a.hdr", text), found);
    };
    refused("#?RADIANCE\nFORMAT=32-bit_rle_xyze\x1b\n\n-Y 1 +X 1\n....", "FORMAT=32-bit_rle_xyze\uFFFD;");
    for (const char *size :
         {"Y 1 +X 1", "-Y 1 -Y 1", "*Y 1 +X 1", "-Z 1 +X 1", "-Y 1 +X", "-Y 1 +X 1 ", "-Y 1234567 +X 1", ""})
        refused(head + size + "\n....", "allowed: -Y HEIGHT +X WIDTH");
    refused(head + "-Y 0 +X 1\n", "its size is 1 x 0");
    refused(head + "-Y 1 +X -1\n....", "its size is -1 x 1");
    refused(head + "-Y 1 +X 32769\n", "a side may have 1 to 32768");
    refused(head + "-Y 32768 +X 32768\n", "an image 268435456");
    expectRefused(store("a.hdr", head + "-Y 8192 +X 8192\n" + std::string(32768, 0)), "772 MiB to read",
                  ErrorKind::LimitExceeded);
    refused(head + "-Y 8192 +X 8192\n", "cut short");
    refused(head + "-Y 1 +X 8\n\2\2\0\x08\x89z"s, "runs of its row 0");
    refused(head + "-Y 1 +X 8\n\2\2\0\x08\0z"s, "runs of its row 0");
    refused(head + "-Y 1 +X 2\n\1\1\1\1", "runs of its row 0");
    refused(head + "-Y 1 +X 2\n\x80\x40\x20\x81\1\1\1\2", "runs of its row 0");
    refused("#?" + std::string(70000, 'x'), "longer than 65536");
}

TEST_F(Hdr, BytesAreThoseOfTheFormat) {
    Image image(1, 2);
    image.at(0, 0) = {1.0f, 0.5f, 0.0f}; // top: first in the file
    using namespace std::string_literals;
    write("a.hdr", image);
    EXPECT_EQ(load("a.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 1\n\x80\x40\x00\x81\0\0\0\0"s);
}

} // namespace
} // namespace hyalite::core
