// OpenEXR files as a whole come back as they were written, and can be written again.
#include "host/image/exr_picture.h"

#include "host/image/exr.h"
#include "tests/fixtures/picture_fixture.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace hyalite::core {
namespace {

using ExrPictures = testing::PictureFiles;

std::string bytesOf(const std::filesystem::path &path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Writes what was read.
void writeAgain(const ExrPicture &read, const std::filesystem::path &path) {
    Image colour(read.crop.width(), read.crop.height());
    for (std::size_t i = 0; i < colour.pixels().size(); ++i)
        colour.pixels()[i] = {read.find("R")->values[i], read.find("G")->values[i],
                              read.find("B")->values[i]};
    Picture picture(colour);
    picture.alpha = read.find("A")->values;
    picture.wholeWidth = read.wholeWidth;
    picture.wholeHeight = read.wholeHeight;
    picture.crop = read.crop;
    picture.layers = layersOf(read);
    picture.attributes = read.attributes;
    picture.projection = read.projection;
    AtomicFile file(path);
    EXPECT_TRUE(writeExr(file, picture, read.options).empty());
    file.commit();
}

TEST_F(ExrPictures, AreWrittenAgainToTheByte) {
    for (const bool isHalf : {false, true}) {
        const Image image = testing::randomBits(21, 33, 5);
        Image finite(21, 33);
        std::ranges::transform(image.pixels(), finite.pixels().begin(), [](const glm::vec3 &pixel) {
            return glm::vec3(pixel.x == pixel.x ? 0.25f : 3.0f, 0.1f, 7.0f);
        });
        Picture picture(finite);
        const std::vector<float> alpha(21 * 33, 0.5f);
        picture.alpha = alpha;
        picture.wholeWidth = 50;
        picture.wholeHeight = 40;
        picture.crop = {9, 30, 2, 35};
        const auto fill = [](int y, std::span<float> row) {
            for (std::size_t i = 0; i < row.size(); ++i)
                row[i] = static_cast<float>(y) / 3.0f + static_cast<float>(i);
        };
        picture.layers = {{"normal", "XYZ", fill}, {"Z", "", fill}, {"albedo", "RGB", fill, true}};
        picture.layers.push_back({"samples", "Y", {}});
        picture.layers.back().fillWholeRow = [](int y, std::span<std::uint32_t> row) {
            std::ranges::fill(row, 4000000000u + static_cast<std::uint32_t>(y));
        };
        picture.attributes = {{"software", "hyalite"}, {"settings.spp", "4"}};
        picture.projection = Projection{};
        picture.projection->worldToCamera[5] = 0.5;
        picture.projection->screenWindowWidth = 1.25;
        const std::filesystem::path path = folder / "a.exr";
        AtomicFile file(path);
        EXPECT_TRUE(writeExr(file, picture, {isHalf, ExrCompression::Piz}).empty());
        file.commit();
        const ExrPicture read = readExrPicture(InputFile(path));
        EXPECT_EQ(read.crop, picture.crop);
        EXPECT_EQ(read.options, (ExrOptions{isHalf, ExrCompression::Piz}));
        EXPECT_EQ(read.find("samples.Y")->wholeValues[21], 4000000001u);
        EXPECT_EQ(read.find("normal.Y")->values[1], 4.0f);
        EXPECT_EQ(read.find("albedo.G")->isHalf, isHalf);
        EXPECT_FALSE(read.find("Z")->isHalf);
        EXPECT_EQ(read.find("nothing"), nullptr);
        writeAgain(read, folder / "b.exr");
        EXPECT_EQ(bytesOf(folder / "b.exr"), bytesOf(path));
    }
}

TEST_F(ExrPictures, WhoseDataLeaveTheDisplayAreRefused) {
    Imf::Header header(Imath::Box2i({0, 0}, {3, 3}), Imath::Box2i({0, 0}, {4, 3}));
    header.channels().insert("R", Imf::Channel(Imf::FLOAT));
    const std::filesystem::path path = folder / "a.exr";
    {
        Imf::OutputFile file(path.c_str(), header);
        std::vector<float> values(20);
        Imf::FrameBuffer frameBuffer;
        frameBuffer.insert("R", Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow()));
        file.setFrameBuffer(frameBuffer);
        file.writePixels(4);
    }
    try {
        static_cast<void>(readExrPicture(InputFile(path)));
        FAIL();
    } catch (const Error &error) {
        EXPECT_NE(std::string(error.what()).find("data window leaves its display window"), std::string::npos)
            << error.what();
    }
}

} // namespace
} // namespace hyalite::core
