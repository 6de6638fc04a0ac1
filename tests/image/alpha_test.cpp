// Pictures with alpha: what files keep, and how they are compared.
#include "host/image/alpha.h"
#include "host/image/comparison_json.h"
#include "host/image/exr.h"
#include "host/image/png.h"
#include "tests/fixtures/picture_fixture.h"

#include <png.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace hyalite::core {
namespace {

using AlphaPictures = testing::PictureFiles;

/// Premultiplied: opaque, half, clear, clear with light, nearly clear with light, more light than it covers.
struct Sample {
    Image image{6, 1};
    std::vector<float> alpha{1.0f, 0.5f, 0.0f, 0.0f, 0.001f, 0.25f};

    Sample() {
        image.pixels() = {
            glm::vec3(0.2f, 0.4f, 0.8f), glm::vec3(0.1f, 0.2f, 0.25f), glm::vec3(0.0f),
            glm::vec3(3.0f, 2.0f, 1.0f), glm::vec3(0.5f, 0.25f, 1e3f), glm::vec3(0.5f, 0.125f, 0.01f)};
    }
    [[nodiscard]] Picture picture() const {
        Picture all(image);
        all.alpha = alpha;
        return all;
    }
};

TEST_F(AlphaPictures, AnExrKeepsEveryBitOfIt) {
    const Image image = testing::randomBits(6, 1, 5);
    Sample sample;
    sample.image = image;
    const LoadedImage loaded = readImage(write("a.exr", sample.picture()));
    EXPECT_EQ(loaded.encoding, Encoding::Linear);
    EXPECT_TRUE(testing::sameBits(loaded.image, image)) << "premultiplied as it was";
    EXPECT_EQ(loaded.alpha, sample.alpha);
    EXPECT_TRUE(readImage(write("b.exr", image)).alpha.empty()) << "an opaque picture has no channel A";
}

TEST_F(AlphaPictures, APngIsStraight) {
    const Sample sample;
    const LoadedImage loaded = readImage(write("a.png", sample.picture()));
    EXPECT_EQ(loaded.encoding, Encoding::Display);
    const auto level = [](float value) { return static_cast<float>(encodeLevel(value)) / 255.0f; };
    const auto pixel = [&](int x) { return loaded.image.at(x, 0); };
    EXPECT_EQ(pixel(0), glm::vec3(level(0.2f), level(0.4f), level(0.8f)));
    EXPECT_EQ(pixel(1), glm::vec3(level(0.2f), level(0.4f), level(0.5f))) << "divided by alpha";
    for (const int clear : {2, 3, 4})
        EXPECT_EQ(pixel(clear), glm::vec3(0.0f)) << clear;
    EXPECT_EQ(pixel(5), glm::vec3(1.0f, level(0.5f), level(0.04f))) << "brighter than it is opaque: clipped";
    const std::vector<float> wanted{1.0f, 128.0f / 255.0f, 0.0f, 0.0f, 0.0f, 64.0f / 255.0f};
    EXPECT_EQ(loaded.alpha, wanted);
}

TEST_F(AlphaPictures, ExposureAndCurveOfAPngComeAfterTheDivision) {
    const Sample sample;
    Image straight(1, 1);
    straight.at(0, 0) = sample.image.at(1, 0) / 0.5f;
    for (const ToneCurve tone : {ToneCurve::Srgb, ToneCurve::Aces, ToneCurve::Agx}) {
        const std::vector<std::uint8_t> wanted = toneMap(straight, 1.5, tone);
        const std::vector<std::uint8_t> levels = pngLevels(sample.picture(), 1.5, tone);
        ASSERT_EQ(levels.size(), 24u);
        EXPECT_TRUE(std::equal(wanted.begin(), wanted.end(), levels.begin() + 4));
        EXPECT_EQ(levels[7], 128);
    }
}

TEST_F(AlphaPictures, EveryLevelOfAlphaIsReadAsItWasWritten) {
    Image image(256, 1);
    std::vector<float> alpha(256);
    for (std::size_t i = 0; i < 256; ++i) {
        alpha[i] = static_cast<float>(i) / 255.0f;
        image.pixels()[i] = glm::vec3(0.25f * alpha[i]);
    }
    Picture picture(image);
    picture.alpha = alpha;
    const LoadedImage loaded = readImage(write("a.png", picture));
    EXPECT_EQ(loaded.alpha, alpha);
    EXPECT_EQ(alphaLevel(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(alphaLevel(2.0f), 255);
    EXPECT_EQ(alphaLevel(-1.0f), 0);
}

TEST_F(AlphaPictures, FormatsWithoutAlphaSayThatTheyLoseIt) {
    const Sample sample;
    for (const auto &[name, format] : {std::pair{"HDR", ImageFormat::Hdr}, {"PFM", ImageFormat::Pfm}}) {
        AtomicFile file(folder / "a");
        const std::vector<std::string> losses = writeImage(file, format, sample.picture(), 0.0);
        ASSERT_EQ(losses.size(), 1u);
        EXPECT_NE(losses[0].find(std::string(name) + " has no alpha"), std::string::npos) << losses[0];
        EXPECT_TRUE(writeImage(file, format, sample.image, 0.0).empty());
    }
    EXPECT_TRUE(testing::sameBits(readImage(write("a.pfm", sample.picture())).image, sample.image));
}

/// A PNG by libpng itself.
std::filesystem::path storePng(const std::filesystem::path &path, int colourType, int bits,
                               std::vector<std::vector<png_byte>> rows, int width,
                               bool hasClearEntry = false) {
    FILE *file = std::fopen(path.c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(rows.size()), bits,
                 colourType, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    const std::array<png_color, 2> palette{{{255, 0, 0}, {0, 0, 255}}};
    const std::array<png_byte, 2> opacity{51, 255};
    if (hasClearEntry) {
        png_set_PLTE(png, info, palette.data(), 2);
        png_set_tRNS(png, info, opacity.data(), 2, nullptr);
    }
    png_write_info(png, info);
    for (std::vector<png_byte> &row : rows)
        png_write_row(png, row.data());
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
    return path;
}

TEST_F(AlphaPictures, PngsOfOtherProgramsHaveTheirs) {
    const LoadedImage deep = readImage(storePng(folder / "a.png", PNG_COLOR_TYPE_RGB_ALPHA, 16,
                                                {{0x12, 0x34, 0xff, 0xff, 0, 0, 0x80, 0x01}}, 1));
    EXPECT_EQ(deep.image.at(0, 0), glm::vec3(0x1234, 0xffff, 0) / 65535.0f);
    EXPECT_EQ(deep.alpha, std::vector<float>{0x8001 / 65535.0f});
    const LoadedImage grey =
        readImage(storePng(folder / "b.png", PNG_COLOR_TYPE_GRAY_ALPHA, 8, {{100, 7, 200, 255}}, 2));
    EXPECT_EQ(grey.image.at(0, 0), glm::vec3(100.0f / 255.0f)) << "straight";
    EXPECT_EQ(grey.alpha, (std::vector<float>{7.0f / 255.0f, 1.0f}));
    const LoadedImage palette =
        readImage(storePng(folder / "c.png", PNG_COLOR_TYPE_PALETTE, 8, {{0, 1}}, 2, true));
    EXPECT_EQ(palette.image.at(1, 0), glm::vec3(0.0f, 0.0f, 1.0f));
    EXPECT_EQ(palette.alpha, (std::vector<float>{0.2f, 1.0f}));
}

TEST_F(AlphaPictures, TheHashIsThatOfWhatIsReadBack) {
    const Sample sample;
    const LoadedImage exr = readImage(write("a.exr", sample.picture()));
    EXPECT_EQ(pixelHash(exr.image, exr.alpha), pixelHash(sample.image, sample.alpha));
    EXPECT_NE(pixelHash(exr.image, exr.alpha), pixelHash(sample.image));
    std::vector<float> other = sample.alpha;
    other[1] = 0.75f;
    EXPECT_NE(pixelHash(sample.image, other), pixelHash(sample.image, sample.alpha));
    const LoadedImage png = readImage(write("a.png", sample.picture()));
    EXPECT_EQ(pngLevels(png.image, png.alpha), pngLevels(sample.picture(), 0.0, ToneCurve::Gamma));
}

TEST_F(AlphaPictures, DisplayedIsAsThePngIsRead) {
    const Sample sample;
    const LoadedImage read = readImage(write("a.png", sample.picture()));
    const LoadedImage displayed = asDisplayed({sample.image, Encoding::Linear, sample.alpha});
    EXPECT_EQ(displayed.encoding, Encoding::Display);
    EXPECT_TRUE(testing::sameBits(displayed.image, read.image));
    EXPECT_EQ(displayed.alpha, read.alpha);
}

TEST(Alpha, IsComparedBesideColoursOverBlack) {
    Image image(2, 2);
    image.at(1, 1) = glm::vec3(0.5f);
    const LoadedImage a{image, Encoding::Linear, {1.0f, 0.5f, 0.0f, 1.0f}};
    LoadedImage b = a;
    EXPECT_TRUE(compareImages(a, b).identical());
    b.alpha[1] = 0.25f;
    b.alpha[2] = 0.125f;
    const ImageComparison comparison = compareImages(a, b);
    EXPECT_TRUE(comparison.pixels.identical());
    EXPECT_FALSE(comparison.identical());
    ASSERT_TRUE(comparison.alpha);
    EXPECT_EQ(comparison.alpha->differingPixelCount, 2u);
    EXPECT_EQ(comparison.alpha->maxAbsoluteDifference, 0.25);
    EXPECT_EQ(comparison.alpha->worstIndex, 1u);
    EXPECT_EQ(comparison.alpha->meanAbsoluteDifference, 0.375 / 4.0);
    const nlohmann::ordered_json json = comparisonToJson(comparison, a.image, b.image);
    EXPECT_EQ(json.at("identical"), false);
    EXPECT_EQ(json.at("alpha").at("maxDifference"), 0.25);
    EXPECT_EQ(json.at("alpha").at("worstPixel"), (nlohmann::json{{"x", 1}, {"y", 0}}));
    // Masked pixels do not count.
    EXPECT_TRUE(compareImages(a, b, 0.0, {1, 0, 0, 1}).identical());
}

TEST(Alpha, OfAnImageWithoutItIsOne) {
    Image image(2, 1);
    const LoadedImage opaque{image};
    const LoadedImage a{image, Encoding::Linear, {1.0f, 0.5f}};
    const ImageComparison comparison = compareImages(opaque, a);
    ASSERT_TRUE(comparison.alpha);
    EXPECT_FALSE(comparison.alpha->hasReference);
    EXPECT_TRUE(comparison.alpha->hasTest);
    EXPECT_EQ(comparison.alpha->maxAbsoluteDifference, 0.5);
    EXPECT_EQ(compareImages(a, opaque).alpha->maxAbsoluteDifference, 0.5);
    EXPECT_FALSE(compareImages(opaque, opaque).alpha);
    EXPECT_TRUE(compareImages(opaque, {image, Encoding::Linear, {1.0f, 1.0f}}).identical());
}

TEST(Alpha, StraightColoursAreComparedOverBlack) {
    Image a(1, 1);
    Image b(1, 1);
    a.at(0, 0) = glm::vec3(1.0f);
    b.at(0, 0) = glm::vec3(0.5f);
    EXPECT_TRUE(
        compareImages({a, Encoding::Display, {0.25f}}, {b, Encoding::Display, {0.5f}}).pixels.identical());
    EXPECT_TRUE(compareImages({a, Encoding::Display, {0.0f}}, {b, Encoding::Display, {0.0f}}).identical())
        << "what nobody sees";
    EXPECT_EQ(compareImages({a, Encoding::Linear, {0.25f}}, {b, Encoding::Linear, {0.5f}})
                  .pixels.maxAbsoluteDifference,
              0.5)
        << "premultiplied: over black as they are";
}

TEST(Alpha, ThatIsNotFiniteDiffersInfinitely) {
    constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> a{notANumber, 0.5f};
    const std::vector<float> b{0.5f, 0.5f};
    EXPECT_TRUE(compareAlpha(a, a, 2).identical());
    EXPECT_EQ(compareAlpha(a, b, 2).maxAbsoluteDifference, std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace hyalite::core
