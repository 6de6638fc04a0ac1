#include "host/image/exr.h"
#include "tests/fixtures/picture_fixture.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <utility>
#include <vector>

namespace hyalite::core {
namespace {

using Exr = testing::PictureFiles;

/// What the library itself finds in a file.
std::vector<std::string> channelsOf(const Imf::InputFile &file) {
    std::vector<std::string> names;
    const Imf::ChannelList &channels = file.header().channels();
    for (Imf::ChannelList::ConstIterator i = channels.begin(); i != channels.end(); ++i) {
        EXPECT_EQ(i.channel().type, Imf::FLOAT) << i.name();
        names.emplace_back(i.name());
    }
    return names;
}

std::vector<float> valuesOf(Imf::InputFile &file, const std::string &channel) {
    const Imath::Box2i window = file.header().dataWindow();
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    const auto height = static_cast<std::size_t>(window.max.y - window.min.y + 1);
    std::vector<float> values(width * height);
    Imf::FrameBuffer frameBuffer;
    frameBuffer.insert(channel, Imf::Slice::Make(Imf::FLOAT, values.data(), window));
    file.setFrameBuffer(frameBuffer);
    file.readPixels(window.min.y, window.max.y);
    return values;
}

TEST_F(Exr, ColoursKeepEveryBit) {
    const Image image = testing::randomBits(37, 53, 11);
    Imf::InputFile file(write("a.exr", image).c_str());
    EXPECT_EQ(channelsOf(file), (std::vector<std::string>{"B", "G", "R"}));
    for (int channel = 0; channel < 3; ++channel) {
        const std::vector<float> values = valuesOf(file, std::string(1, "RGB"[channel]));
        ASSERT_EQ(values.size(), image.pixels().size());
        for (std::size_t i = 0; i < values.size(); ++i)
            ASSERT_EQ(std::bit_cast<std::uint32_t>(values[i]),
                      std::bit_cast<std::uint32_t>(image.pixels()[i][channel]));
    }
}

TEST_F(Exr, TheDataWindowIsTheCrop) {
    const Image image(3, 2);
    Picture picture(image);
    picture.wholeWidth = 640;
    picture.wholeHeight = 480;
    picture.crop = {10, 13, 470, 472};
    const Imf::InputFile file(write("a.exr", picture).c_str());
    EXPECT_EQ(file.header().displayWindow(), Imath::Box2i({0, 0}, {639, 479}));
    EXPECT_EQ(file.header().dataWindow(), Imath::Box2i({10, 470}, {12, 471}));
}

TEST_F(Exr, LayersHaveTheirNamesAndRows) {
    const Image image(2, 70); // more rows than are written at once
    Picture picture(image);
    picture.layers.push_back({"normal", "XYZ", [](int y, std::span<float> row) {
                                  for (std::size_t i = 0; i < row.size(); ++i)
                                      row[i] = static_cast<float>(100 * y) + static_cast<float>(i);
                              }});
    picture.layers.push_back({"depth", "", [](int y, std::span<float> row) {
                                  std::fill(row.begin(), row.end(), static_cast<float>(-y));
                              }});
    Imf::InputFile file(write("a.exr", picture).c_str());
    EXPECT_EQ(channelsOf(file),
              (std::vector<std::string>{"B", "G", "R", "depth", "normal.X", "normal.Y", "normal.Z"}));
    const std::vector<float> depth = valuesOf(file, "depth");
    const std::vector<float> normalY = valuesOf(file, "normal.Y");
    for (std::size_t y = 0; y < 70; ++y) {
        EXPECT_EQ(depth[2 * y + 1], -static_cast<float>(y));
        EXPECT_EQ(normalY[2 * y], static_cast<float>(100 * y + 1));
        EXPECT_EQ(normalY[2 * y + 1], static_cast<float>(100 * y + 4));
    }
}

TEST_F(Exr, AttributesAreStringsAndPrimariesAreTold) {
    const Image image(1, 1);
    Picture picture(image);
    picture.attributes = {{"software", "hyalite"}, {"commandLine", "render \xff\n'a b'"}};
    const Imf::InputFile file(write("a.exr", picture).c_str());
    EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("software").value(), "hyalite");
    EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("commandLine").value(),
              "render \xff\n'a b'");
    EXPECT_EQ(file.header().typedAttribute<Imf::ChromaticitiesAttribute>("chromaticities").value().red,
              Imath::V2f(0.64f, 0.33f));
}

TEST_F(Exr, ThePictureAloneMakesTheBytes) {
    const Image image = testing::randomBits(50, 50, 3);
    write("a.exr", image);
    write("b.exr", image);
    EXPECT_EQ(load("a.exr"), load("b.exr"));
}

/// A file as other programs write it.
void writeByLibrary(const std::filesystem::path &path, Imf::Header header,
                    const std::vector<std::pair<std::string, Imf::PixelType>> &channels) {
    for (const auto &[name, type] : channels)
        header.channels().insert(name, Imf::Channel(type));
    const Imath::Box2i window = header.dataWindow();
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    const auto height = static_cast<std::size_t>(window.max.y - window.min.y + 1);
    Imf::OutputFile file(path.c_str(), header);
    Imf::FrameBuffer frameBuffer;
    std::vector<std::vector<std::uint32_t>> values;
    for (const auto &[name, type] : channels) {
        std::vector<std::uint32_t> &words = values.emplace_back(width * height); // wide enough for all types
        for (std::size_t i = 0; i < words.size(); ++i) {
            const float value = static_cast<float>(values.size()) + static_cast<float>(i % 4) * 0.25f;
            words[i] = type == Imf::FLOAT  ? std::bit_cast<std::uint32_t>(value)
                       : type == Imf::HALF ? half(value).bits()
                                           : static_cast<std::uint32_t>(value);
        }
        frameBuffer.insert(name, Imf::Slice::Make(type, words.data(), window, 4, 4 * width));
    }
    file.setFrameBuffer(frameBuffer);
    file.writePixels(static_cast<int>(height));
}

Imf::Header sized(int width, int height, Imf::Compression compression = Imf::ZIP_COMPRESSION) {
    return {width, height, 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y, compression};
}

const std::vector<std::pair<std::string, Imf::PixelType>> halfRgba{
    {"R", Imf::HALF}, {"G", Imf::HALF}, {"B", Imf::HALF}, {"A", Imf::HALF}};

TEST_F(Exr, WhatIsWrittenIsReadToTheBit) {
    const Image image = testing::randomBits(37, 53, 12);
    Picture picture(image);
    picture.wholeWidth = picture.wholeHeight = 1000;
    picture.crop = {100, 137, 500, 553};
    picture.layers.push_back({"variance", "RGB", [&](int y, std::span<float> row) {
                                  for (int x = 0; x < 37; ++x)
                                      for (int channel = 0; channel < 3; ++channel)
                                          row[static_cast<std::size_t>(3 * x + channel)] =
                                              image.at(x, 52 - y)[channel];
                              }});
    picture.layers.push_back({"samples", "", [](int y, std::span<float> row) {
                                  std::fill(row.begin(), row.end(), static_cast<float>(y));
                              }});
    const std::filesystem::path path = write("a.exr", picture);
    const LoadedImage loaded = readImage(path);
    EXPECT_EQ(loaded.encoding, Encoding::Linear);
    EXPECT_TRUE(testing::sameBits(loaded.image, image));
    const InputFile file(path);
    const Image variance = readExr(file, "variance");
    for (int x = 0; x < 37; ++x)
        EXPECT_EQ(std::bit_cast<std::uint32_t>(variance.at(x, 9).y),
                  std::bit_cast<std::uint32_t>(image.at(x, 43).y));
    EXPECT_EQ(readExr(file, "samples").at(5, 17), glm::vec3(17.0f));
    try {
        (void)readExr(file, "albedo");
        ADD_FAILURE();
    } catch (const Error &error) {
        EXPECT_NE(std::string(error.what())
                      .find("no channels albedo.R, albedo.G and albedo.B, but B, G, R, samples"),
                  std::string::npos)
            << error.what();
    }
}

TEST_F(Exr, FilesOfOtherProgramsAreRead) {
    for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
        const std::filesystem::path path = folder / "a.exr";
        writeByLibrary(path, sized(40, 300, static_cast<Imf::Compression>(compression)), halfRgba);
        const Image image = readImage(path).image;
        ASSERT_EQ(image.width(), 40);
        ASSERT_EQ(image.height(), 300);
        for (const int y : {0, 31, 32, 299})
            for (int x = 0; x < 40; ++x)
                for (int channel = 0; channel < 3; ++channel)
                    // B44 and DWA lose a little.
                    ASSERT_NEAR(image.at(x, y)[channel],
                                static_cast<float>(channel + 1) + static_cast<float>(x % 4) * 0.25f,
                                compression < 5 ? 0.0f : 0.1f)
                        << compression;
    }
}

TEST_F(Exr, GreyAndIntegersAreRead) {
    const std::filesystem::path path = folder / "a.exr";
    writeByLibrary(path, sized(4, 1), {{"Y", Imf::FLOAT}});
    EXPECT_EQ(readImage(path).image.at(2, 0), glm::vec3(1.5f));
    writeByLibrary(path, sized(4, 1), {{"R", Imf::UINT}, {"G", Imf::FLOAT}, {"B", Imf::HALF}});
    EXPECT_EQ(readImage(path).image.at(3, 0), glm::vec3(1.0f, 2.75f, 3.75f));
}

/// R, G and B of a part or a file: `first`, `first` + 1 and `first` + 2, and a quarter more with each column modulo 4.
struct Rgb {
    static constexpr int width = 70;
    static constexpr int height = 50;
    explicit Rgb(float first) {
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = first + static_cast<float>(i % 3) + static_cast<float>(i / 3 % width % 4) * 0.25f;
    }
    [[nodiscard]] Imf::FrameBuffer frameBuffer() {
        const Imath::Box2i window({0, 0}, {width - 1, height - 1});
        Imf::FrameBuffer buffer;
        for (std::size_t channel = 0; channel < 3; ++channel)
            buffer.insert(std::string(1, "RGB"[channel]),
                          Imf::Slice::Make(Imf::FLOAT, values.data() + channel, window, 12, 12 * width));
        return buffer;
    }
    void expectIn(const Image &image) const {
        ASSERT_EQ(image.width(), width);
        ASSERT_EQ(image.height(), height);
        EXPECT_EQ(std::memcmp(image.pixels().data(), values.data(), sizeof values), 0);
    }
    std::array<float, std::size_t{3} * width * height> values{};
};

Imf::Header rgbHeader() {
    Imf::Header header = sized(Rgb::width, Rgb::height);
    for (const char *name : {"R", "G", "B"})
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    return header;
}

TEST_F(Exr, TilesAreRead) {
    Rgb rgb(1.0f);
    for (const Imf::LevelMode levels : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS}) {
        const std::filesystem::path path = folder / "tiled.exr";
        {
            Imf::Header header = rgbHeader();
            header.setTileDescription(Imf::TileDescription(32, 16, levels));
            Imf::TiledOutputFile file(path.c_str(), header);
            file.setFrameBuffer(rgb.frameBuffer());
            for (int level = 0; level < file.numLevels(); ++level)
                file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
        }
        rgb.expectIn(readImage(path).image);
        std::string bytes = load("tiled.exr");
        // The smaller images come last, and are not read.
        for (std::size_t size = 100; size < bytes.size() / (levels == Imf::ONE_LEVEL ? 1 : 2); size += 997)
            expectBad(store("a.exr", bytes.substr(0, size)), ": ");
        const std::size_t tiles = bytes.find(std::string("tiles\0tiledesc\0", 15));
        ASSERT_NE(tiles, std::string::npos);
        for (const char *side :
             {"\x01\0\0\0\x01\0\0\0", "\xff\xff\xff\x7f\xff\xff\xff\x7f", "\0\0\0\0\0\0\0\0"}) {
            std::string damaged = bytes;
            damaged.replace(tiles + 19, 8, side, 8);
            expectBad(store("a.exr", damaged), ": ");
        }
    }
}

TEST_F(Exr, PartsAreFoundByLayer) {
    const std::filesystem::path path = folder / "parts.exr";
    Rgb beauty(1.0f);
    Rgb albedo(5.0f);
    {
        std::vector<Imf::Header> headers{rgbHeader(), rgbHeader()};
        headers[0].setName("beauty");
        headers[0].setType(Imf::SCANLINEIMAGE);
        headers[1].setName("albedo");
        headers[1].setType(Imf::SCANLINEIMAGE);
        Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 2);
        for (int i = 0; i < 2; ++i) {
            Imf::OutputPart part(file, i);
            part.setFrameBuffer((i == 0 ? beauty : albedo).frameBuffer());
            part.writePixels(Rgb::height);
        }
    }
    beauty.expectIn(readImage(path).image);
    albedo.expectIn(readExr(InputFile(path), "albedo"));
    EXPECT_FALSE(hasExrLayer(InputFile(path), "normal"));
    const std::string bytes = load("parts.exr");
    for (std::size_t size = 8; size < bytes.size() / 2; size += size < 1000 ? 13 : 997)
        expectBad(store("a.exr", bytes.substr(0, size)), ": ");
}

TEST_F(Exr, KindsThatAreNotReadAreNamed) {
    const std::filesystem::path path = folder / "a.exr";
    writeByLibrary(path, sized(4, 1), {{"Z", Imf::FLOAT}, {"depth\x1b", Imf::FLOAT}});
    expectBad(path, "no channels R, G and B, but Z, depth\uFFFD");
    Imf::Header huge = sized(4, 1);
    huge.dataWindow() = Imath::Box2i({0, 0}, {40000, 0});
    writeByLibrary(path, huge, halfRgba);
    expectBad(path, "its size is 40001 x 1");
    {
        Imf::Header luminance = sized(64, 64);
        luminance.channels().insert("Y", Imf::Channel(Imf::HALF, 1, 1));
        luminance.channels().insert("RY", Imf::Channel(Imf::HALF, 2, 2));
        const Imf::OutputFile file(path.c_str(), luminance);
    }
    expectBad(path, "subsampled 2 x 2");
}

TEST_F(Exr, DamagedFilesAreRefused) {
    const Image image = testing::randomBits(9, 40, 3);
    Picture picture(image);
    picture.attributes = {{"comments", "text"}};
    write("good.exr", picture);
    const std::string good = load("good.exr");
    for (std::size_t size = 0; size < good.size(); size += size < 400 ? 7 : 500)
        expectBad(store("a.exr", good.substr(0, size)), ": ");
    const auto damaged = [&](std::size_t position, const std::string &bytes) {
        std::string text = good;
        text.replace(position, bytes.size(), bytes);
        return store("a.exr", text);
    };
    using namespace std::string_literals;
    expectBad(damaged(4, "\3"), "OpenEXR of version 3");
    expectBad(damaged(5, "\x10"), ": ");
    expectBad(damaged(5, "\x02"), ": ");
    expectBad(damaged(5, "\x08"), "OpenEXR with deep pixels");
    expectBad(damaged(6, "\x01"), "is unknown");
    // A text of 2 GiB in a file of some KiB.
    const std::size_t comments = good.find("comments\0string\0"s);
    ASSERT_NE(comments, std::string::npos);
    expectBad(damaged(comments + 16, "\xff\xff\xff\x7f"), "cut short");
    // The library reads channels up to an empty name, and one byte of compression, whatever their sizes say.
    expectBad(damaged(good.find("channels\0chlist\0"s) + 16, "\x38"), "attribute channels is damaged");
    expectBad(damaged(good.find("compression\0compression\0"s) + 24, "\2"),
              "attribute compression is damaged");
    const std::size_t window = good.find("dataWindow\0box2i\0"s);
    ASSERT_NE(window, std::string::npos);
    expectBad(damaged(window + 33, "\xff\x7f"), ": "); // rows that are not there
    expectRefused(damaged(window + 29, "\xff\x3f\0\0\xff\x3f"s), "MiB to read", ErrorKind::LimitExceeded);
    std::string padded = good.substr(0, 8) + "x\0y\0\0\0\x20\0"s + std::string(2 << 20, 'x') + good.substr(8);
    expectBad(store("a.exr", padded), "longer than 1048576");
}

TEST_F(Exr, AFullDiskIsReportedByTheWriter) {
    const Image image = testing::randomBits(50, 50, 3);
    AtomicFile file(folder / "a.exr");
    EXPECT_EQ(signal(SIGXFSZ, SIG_IGN), SIG_DFL);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    for (const rlim_t limit : {0u, 100u, 5000u}) {
        const rlimit small{limit, before.rlim_max};
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
        try {
            writeImage(file, ImageFormat::Exr, image, 0.0);
            ADD_FAILURE() << limit;
        } catch (const Error &error) {
            EXPECT_EQ(error.kind, ErrorKind::OutputNotWritten);
            EXPECT_NE(std::string(error.what()).find("a.exr"), std::string::npos) << error.what();
        }
    }
    EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    signal(SIGXFSZ, SIG_DFL);
}

} // namespace
} // namespace hyalite::core
