// What an EXR stores its numbers as: types, compressions, and what they lose.
#include "host/image/exr.h"
#include "host/image/image_file.h"
#include "tests/fixtures/picture_fixture.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTestFile.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace hyalite::core {
namespace {

/// A picture with a layer of each kind, in an image that it is a part of.
class ExrTypes : public testing::PictureFiles {
  protected:
    ExrTypes() {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> light(0.0f, 2.0f);
        for (glm::vec3 &pixel : image.pixels())
            pixel = {light(random), light(random), light(random)};
        for (float &value : alpha)
            value = light(random) / 2.0f;
    }

    [[nodiscard]] Picture picture() const {
        Picture all(image);
        all.alpha = alpha;
        all.wholeWidth = 100;
        all.wholeHeight = 80;
        all.crop = {20, 20 + width, 10, 10 + height};
        const auto values = [this](int channelCount, float scale) {
            return [this, channelCount, scale](int y, std::span<float> row) {
                for (std::size_t i = 0; i < row.size(); ++i)
                    row[i] = scale * image.at(static_cast<int>(i) / channelCount,
                                              y)[static_cast<int>(i) % channelCount];
            };
        };
        all.layers.push_back({"albedo", "RGB", values(3, 0.5f), true});
        all.layers.push_back({"variance", "RGB", values(3, 0.01f)});
        all.layers.push_back({"Z", "", values(1, 1e6f)});
        all.layers.push_back({"uv", "UV", values(2, 0.5f)});
        all.layers.push_back({"normal", "XYZ", values(3, -0.5f)});
        Layer ids{"ids", "Y", {}};
        ids.fillWholeRow = [](int y, std::span<std::uint32_t> row) {
            for (std::size_t x = 0; x < row.size(); ++x)
                row[x] = idOf(x, y);
        };
        all.layers.push_back(ids);
        return all;
    }
    /// Among them numbers that float32 has not.
    static std::uint32_t idOf(std::size_t x, int y) {
        return 0xffffffffu - static_cast<std::uint32_t>(x) - 1000u * static_cast<std::uint32_t>(y);
    }

    std::filesystem::path writeWith(const ExrOptions &options) {
        AtomicFile file(folder / "a.exr");
        losses = writeExr(file, picture(), options);
        file.commit();
        return folder / "a.exr";
    }

    static constexpr int width = 61;
    static constexpr int height = 37;
    Image image{width, height};
    std::vector<float> alpha = std::vector<float>(static_cast<std::size_t>(width) * height);
    std::vector<std::string> losses;
};

std::map<std::string, Imf::PixelType> typesOf(const std::filesystem::path &path) {
    std::map<std::string, Imf::PixelType> types;
    const Imf::InputFile file(path.c_str());
    const Imf::ChannelList &channels = file.header().channels();
    for (Imf::ChannelList::ConstIterator i = channels.begin(); i != channels.end(); ++i)
        types.emplace(i.name(), i.channel().type);
    return types;
}

std::vector<float> valuesOf(const std::filesystem::path &path, const std::string &channel) {
    Imf::InputFile file(path.c_str());
    const Imath::Box2i window = file.header().dataWindow();
    const int size = (window.max.x - window.min.x + 1) * (window.max.y - window.min.y + 1);
    std::vector<float> values(static_cast<std::size_t>(size));
    Imf::FrameBuffer frameBuffer;
    frameBuffer.insert(channel, Imf::Slice::Make(Imf::FLOAT, values.data(), window));
    file.setFrameBuffer(frameBuffer);
    file.readPixels(window.min.y, window.max.y);
    return values;
}

TEST_F(ExrTypes, WholeNumbersStayExact) {
    for (const bool isHalf : {false, true})
        for (const auto &[name, compression] : exrCompressionNames) {
            const InputFile file(writeWith({isHalf, compression}));
            const std::vector<std::uint32_t> ids = readExrWhole(file, "ids");
            ASSERT_EQ(ids.size(), image.pixels().size()) << name;
            for (std::size_t i = 0; i < ids.size(); ++i)
                ASSERT_EQ(ids[i], idOf(i % width, static_cast<int>(i / width))) << name;
            EXPECT_EQ(typesOf(file.path()).at("ids.Y"), Imf::UINT);
        }
    const InputFile file(folder / "a.exr");
    for (const char *layer : {"variance", "Z"})
        EXPECT_THROW((void)readExrWhole(file, layer), Error) << layer;
}

TEST_F(ExrTypes, OnlyLightIsHalf) {
    const auto whole = typesOf(writeWith({}));
    for (const auto &[channel, type] : whole)
        EXPECT_EQ(type, channel == "ids.Y" ? Imf::UINT : Imf::FLOAT) << channel;
    const auto half = typesOf(writeWith({true}));
    EXPECT_EQ(half.size(), 17u);
    for (const auto &[channel, type] : half) {
        const bool isLight = channel.size() == 1 ? channel != "Z" : channel.starts_with("albedo");
        EXPECT_EQ(type, isLight ? Imf::HALF : channel == "ids.Y" ? Imf::UINT : Imf::FLOAT) << channel;
    }
    EXPECT_TRUE(losses.empty());
}

TEST_F(ExrTypes, HalvesAreTheNearest) {
    const InputFile file(writeWith({true}));
    const AlphaImage read = readExrWithAlpha(file);
    for (std::size_t i = 0; i < alpha.size(); ++i) {
        EXPECT_EQ(read.alpha[i], static_cast<float>(half(alpha[i])));
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_EQ(read.image.pixels()[i][channel], static_cast<float>(half(image.pixels()[i][channel])));
    }
    const Image depth = readExr(file, "Z");
    for (std::size_t i = 0; i < alpha.size(); ++i)
        EXPECT_EQ(depth.pixels()[i].x, 1e6f * image.pixels()[i].x) << "every bit";
}

TEST_F(ExrTypes, ValuesBeyondHalfAreItsLargestAndCounted) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    image.at(0, 0) = {65504.0f, 65505.0f, -7e4f};
    image.at(1, 0) = {infinity, -infinity, std::numeric_limits<float>::quiet_NaN()};
    const AlphaImage read = readExrWithAlpha(InputFile(writeWith({true})));
    EXPECT_EQ(read.image.at(0, 0), glm::vec3(65504.0f, 65504.0f, -65504.0f));
    EXPECT_EQ(read.image.at(1, 0).x, 65504.0f);
    EXPECT_EQ(read.image.at(1, 0).y, -65504.0f);
    EXPECT_TRUE(std::isnan(read.image.at(1, 0).z));
    // Of the colours four; of albedo, which is half of them, two.
    ASSERT_EQ(losses.size(), 1u);
    EXPECT_EQ(losses[0], "6 values are beyond 65504, the largest 16-bit float, and are stored as that");
    writeWith({});
    EXPECT_TRUE(losses.empty());
}

TEST_F(ExrTypes, TheHashIsThatOfTheFileWithEveryCompression) {
    for (const bool isHalf : {false, true})
        for (const auto &[name, compression] : exrCompressionNames) {
            const ExrOptions options{isHalf, compression};
            const AlphaImage read = readExrWithAlpha(InputFile(writeWith(options)));
            const std::string hash = exrPixelHash(picture(), options);
            EXPECT_EQ(hash, pixelHash(read.image, read.alpha)) << name << isHalf;
            const bool isExact = pixelHash(image, alpha) == hash;
            const bool isExpected = !isHalf && !isLossy(compression);
            EXPECT_TRUE(isExact == isExpected || name.starts_with("b44"))
                << name << isHalf; // floats are exact
        }
}

TEST_F(ExrTypes, CompressionsAreThoseOfOpenExr) {
    const std::map<std::string_view, Imf::Compression> wanted{
        {"none", Imf::NO_COMPRESSION},  {"rle", Imf::RLE_COMPRESSION},   {"zips", Imf::ZIPS_COMPRESSION},
        {"zip", Imf::ZIP_COMPRESSION},  {"piz", Imf::PIZ_COMPRESSION},   {"pxr24", Imf::PXR24_COMPRESSION},
        {"b44", Imf::B44_COMPRESSION},  {"b44a", Imf::B44A_COMPRESSION}, {"dwaa", Imf::DWAA_COMPRESSION},
        {"dwab", Imf::DWAB_COMPRESSION}};
    for (const auto &[name, compression] : exrCompressionNames)
        EXPECT_EQ(Imf::InputFile(writeWith({false, compression}).c_str()).header().compression(),
                  wanted.at(name))
            << name;
}

/// What is lost is found by reading, and is what the writer says.
TEST_F(ExrTypes, ALossyCompressionNamesTheDataThatItChanges) {
    const std::filesystem::path exact = folder / "exact.exr";
    std::filesystem::rename(writeWith({}), exact);
    for (const bool isHalf : {false, true})
        for (const auto &[name, compression] : exrCompressionNames) {
            const std::filesystem::path path = writeWith({isHalf, compression});
            std::string changed;
            for (const auto &[layer, channels] :
                 std::vector<std::pair<std::string, std::vector<std::string>>>{
                     {"variance", {"variance.R", "variance.G", "variance.B"}},
                     {"Z", {"Z"}},
                     {"uv", {"uv.U", "uv.V"}},
                     {"normal", {"normal.X", "normal.Y", "normal.Z"}}})
                if (std::ranges::any_of(channels, [&](const std::string &channel) {
                        return valuesOf(path, channel) != valuesOf(exact, channel);
                    }))
                    changed += (changed.empty() ? "" : ", ") + layer;
            const std::string told = losses.empty() ? "" : losses[0].substr(losses[0].find("changes ") + 8);
            EXPECT_EQ(told, changed) << name;
        }
}

TEST_F(ExrTypes, ItIsOnePart) {
    const std::string path = writeWith({true, ExrCompression::Piz}).string();
    bool isTiled = true;
    bool isDeep = true;
    bool isMultiPart = true;
    EXPECT_TRUE(Imf::isOpenExrFile(path.c_str(), isTiled, isDeep, isMultiPart));
    EXPECT_FALSE(isTiled || isDeep || isMultiPart);
}

TEST_F(ExrTypes, TheProjectionIsInTheHeader) {
    Picture all = picture();
    all.projection.emplace();
    for (std::size_t i = 0; i < 16; ++i) {
        all.projection->worldToCamera[i] = static_cast<double>(i);
        all.projection->worldToNdc[i] = 100.0 + static_cast<double>(i);
    }
    all.projection->screenWindowWidth = 1.5;
    const Imf::InputFile file(write("a.exr", all).c_str());
    EXPECT_EQ(Imf::worldToCamera(file.header())[3][1], 13.0f) << "row by row";
    EXPECT_EQ(Imf::worldToNDC(file.header())[0][2], 102.0f);
    EXPECT_EQ(file.header().screenWindowWidth(), 1.5f);
    const Imf::InputFile without(write("b.exr", picture()).c_str());
    EXPECT_FALSE(Imf::hasWorldToCamera(without.header()) || Imf::hasWorldToNDC(without.header()));
    EXPECT_EQ(without.header().screenWindowWidth(), 1.0f);
}

} // namespace
} // namespace hyalite::core
