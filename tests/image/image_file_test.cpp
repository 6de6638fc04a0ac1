#include "host/image/image_file.h"

#include "host/base/error.h"
#include "host/image/png.h"
#include "host/image/tone_map.h"
#include "tests/fixtures/temporary_folder.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <random>
#include <string>

#include <sys/stat.h>
#include <unistd.h>

namespace hyalite::core {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

class ImageFileTest : public ::testing::Test {
  protected:
    [[nodiscard]] fs::path write(ImageFormat format, const Image &image, double exposureStops = 0.0) const {
        const fs::path path = folder / "written";
        AtomicFile file(path);
        writeImage(file, format, image, exposureStops);
        file.commit();
        return path;
    }

    [[nodiscard]] fs::path store(const std::string &bytes) const {
        const fs::path path = folder / "stored";
        std::ofstream(path, std::ios::binary) << bytes;
        return path;
    }

    [[nodiscard]] Image readBytes(const std::string &bytes) const { return readImage(store(bytes)).image; }

    void expectBad(const fs::path &path, const std::string &found) const {
        try {
            (void)readImage(path);
            ADD_FAILURE() << "read, but should have said: " << found;
        } catch (const Error &error) {
            EXPECT_EQ(error.kind, ErrorKind::BadInput);
            EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(found), std::string::npos) << error.what();
        }
    }

    void expectBadBytes(const std::string &bytes, const std::string &found) const {
        expectBad(store(bytes), found);
    }

    const testing::TemporaryFolder temporary_;
    const fs::path &folder = temporary_.path;
};

std::string load(const fs::path &path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

Image randomImage(int width, int height, std::uint32_t seed) {
    std::mt19937 random(seed);
    Image image(width, height);
    for (glm::vec3 &pixel : image.pixels())
        for (int channel = 0; channel < 3; ++channel)
            pixel[channel] = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    return image;
}

bool sameBits(const Image &a, const Image &b) {
    return a.width() == b.width() && a.height() == b.height() &&
           std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size() * sizeof(glm::vec3)) == 0;
}

// A PNG written by hand: stored (not compressed) deflate blocks, bitwise CRC.

std::string big32(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes += static_cast<char>((value >> shift) & 0xffu);
    return bytes;
}

std::string chunk(const std::string &type, const std::string &data) {
    std::uint32_t crc = 0xffffffffu;
    for (const char c : type + data) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
    }
    return big32(static_cast<std::uint32_t>(data.size())) + type + data + big32(~crc);
}

/// With another last byte, which belongs to a checksum.
std::string spoilt(std::string bytes) {
    bytes.back() = static_cast<char>(bytes.back() ^ 1);
    return bytes;
}

std::string zlibStored(const std::string &raw) {
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    for (const char c : raw) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<std::uint32_t>(raw.size());
    std::string bytes = "\x78\x01\x01"s;
    for (const std::uint32_t word : {size, ~size}) {
        bytes += static_cast<char>(word & 0xffu);
        bytes += static_cast<char>((word >> 8) & 0xffu);
    }
    return bytes + raw + big32(b << 16 | a);
}

const std::string pngSignature = "\x89PNG\r\n\x1a\n";

std::string header(std::uint32_t width, std::uint32_t height, char bitDepth, char colourType,
                   char interlace = 0) {
    return chunk("IHDR", big32(width) + big32(height) + bitDepth + colourType + "\0\0"s + interlace);
}

std::string png(const std::string &headerChunk, const std::string &rows, const std::string &between = "") {
    return pngSignature + headerChunk + between + chunk("IDAT", zlibStored(rows)) + chunk("IEND", "");
}

TEST_F(ImageFileTest, FormatsAreKnownByTheirExtensions) {
    EXPECT_EQ(imageFormatOf("a/b.c/out.png"), ImageFormat::Png);
    EXPECT_EQ(imageFormatOf("OUT.PnG"), ImageFormat::Png);
    EXPECT_EQ(imageFormatOf("out.PFM"), ImageFormat::Pfm);
    EXPECT_EQ(imageFormatOf("out.Exr"), ImageFormat::Exr);
    EXPECT_EQ(imageFormatOf("out.hdr"), ImageFormat::Hdr);
    for (const char *path : {"out.tif", "out", "png", ".png", "out.png.", "a.png/out", ""}) {
        try {
            (void)imageFormatOf(path);
            ADD_FAILURE() << path;
        } catch (const Error &error) {
            EXPECT_EQ(error.kind, ErrorKind::Usage);
            EXPECT_NE(std::string(error.what()).find(".png"), std::string::npos);
            EXPECT_NE(std::string(error.what()).find(".pfm"), std::string::npos);
        }
    }
}

TEST_F(ImageFileTest, PfmBytesAreThoseOfTheFormat) {
    Image image(1, 2);
    image.at(0, 0) = {1.0f, -2.0f, 0.5f}; // top: last in the file
    image.at(0, 1) = {0.0f, 3.0f, std::numeric_limits<float>::infinity()};
    EXPECT_EQ(load(write(ImageFormat::Pfm, image, 5.0)), "PF\n1 2\n-1.0\n"
                                                         "\x00\x00\x00\x00\x00\x00\x40\x40\x00\x00\x80\x7f"
                                                         "\x00\x00\x80\x3f\x00\x00\x00\xc0\x00\x00\x00\x3f"s);
}

TEST_F(ImageFileTest, PfmKeepsEveryBit) {
    const Image image = randomImage(37, 23, 7); // with NaNs, infinities and denormals
    const LoadedImage loaded = readImage(write(ImageFormat::Pfm, image));
    EXPECT_EQ(loaded.encoding, Encoding::Linear);
    EXPECT_TRUE(sameBits(loaded.image, image));
}

TEST_F(ImageFileTest, PfmOfBothByteOrdersAndKindsIsRead) {
    const Image little = readBytes("Pf\n2 1\n-1\n\x00\x00\x80\x3f\x00\x00\x00\xc0"s);
    EXPECT_EQ(little.at(0, 0), glm::vec3(1.0f));
    EXPECT_EQ(little.at(1, 0), glm::vec3(-2.0f));
    const Image big = readBytes("PF 1\t1\r\n+2.5e0\n\x3f\x80\x00\x00\xc0\x00\x00\x00\x3f\x00\x00\x00"s);
    EXPECT_EQ(big.at(0, 0), glm::vec3(1.0f, -2.0f, 0.5f)); // the scale's magnitude is ignored
    // The data begins after one white space, though its first byte is a white space too.
    EXPECT_EQ(readBytes("Pf\n1 1\n1\n\x20\x20\x20\x20"s).at(0, 0).x, std::bit_cast<float>(0x20202020u));
}

TEST_F(ImageFileTest, DamagedPfmIsRefused) {
    const std::string good = "Pf\n1 1\n-1\n\0\0\0\0"s;
    EXPECT_EQ(readBytes(good).at(0, 0), glm::vec3(0.0f));
    expectBadBytes(good + "x", "make a file of 14 bytes, but it has 15");
    for (std::size_t size = 0; size < good.size(); ++size)
        expectBadBytes(good.substr(0, size), ": ");
    expectBadBytes("Pf\n1 x\n-1\n\0\0\0\0"s, "height in its PFM header is 'x'");
    expectBadBytes("Pf\n1.5 1\n-1\n\0\0\0\0"s, "width in its PFM header is '1.5'");
    expectBadBytes("Pf\n99999999999 1\n-1\n"s, "not a number");
    expectBadBytes("Pf\n\x1b[31m 1\n-1\n"s, "width in its PFM header is '\uFFFD[31m'");
    expectBadBytes("Pf\n1 1\n0\n\0\0\0\0"s, "no byte order");
    expectBadBytes("Pf\n1 1\nnan\n\0\0\0\0"s, "no byte order");
    expectBadBytes("Pf\n0 1\n-1\n"s, "its size is 0 x 1");
    expectBadBytes("Pf\n-1 -1\n-1\n\0\0\0\0"s, "its size is -1 x -1");
    expectBadBytes("PF\n32769 1\n-1\n"s, "a side may have 1 to 32768");
    expectBadBytes("PF\n32768 32768\n-1\n"s, "an image 268435456");
    expectBadBytes("PF\n8192 8192\n-1\n"s, "make a file of 805306384 bytes, but it has 16");
    expectBadBytes("PF\n" + std::string(300, ' ') + "1 1\n-1\n", "header ends before the width");
}

TEST_F(ImageFileTest, PngComesBackAsItsLevels) {
    Image image(256, 3);
    for (int x = 0; x < 256; ++x) {
        const auto c = static_cast<float>(std::pow(x / 255.0, 2.2));
        image.at(x, 0) = {c, 0.0f, 0.0f};
        image.at(x, 1) = {0.0f, c, 1.0f};
        image.at(x, 2) = {-c, std::numeric_limits<float>::quiet_NaN(), c};
    }
    const LoadedImage loaded = readImage(write(ImageFormat::Png, image));
    EXPECT_EQ(loaded.encoding, Encoding::Display);
    ASSERT_EQ(loaded.image.width(), 256);
    ASSERT_EQ(loaded.image.height(), 3);
    for (int x = 0; x < 256; ++x) {
        const float level = static_cast<float>(x) / 255.0f;
        EXPECT_EQ(loaded.image.at(x, 0), glm::vec3(level, 0.0f, 0.0f));
        EXPECT_EQ(loaded.image.at(x, 1), glm::vec3(0.0f, level, 1.0f));
        EXPECT_EQ(loaded.image.at(x, 2), glm::vec3(0.0f, 0.0f, level));
    }
}

TEST_F(ImageFileTest, PngHasTheExposureAndPfmHasNot) {
    Image image(1, 1);
    image.at(0, 0) = {0.25f, 0.125f, 0.0f};
    EXPECT_EQ(readImage(write(ImageFormat::Png, image, 2.0)).image.at(0, 0).x, 1.0f);
    EXPECT_EQ(readImage(write(ImageFormat::Pfm, image, 2.0)).image.at(0, 0).x, 0.25f);
}

TEST_F(ImageFileTest, PngOfEveryKindIsRead) {
    // Rows begin with their filter byte: 0 none, 1 sub.
    EXPECT_EQ(readBytes(png(header(2, 1, 8, 2), "\x00\x33\x66\x99\xff\x00\x33"s)).at(1, 0),
              glm::vec3(1.0f, 0.0f, 0.2f));
    EXPECT_EQ(readBytes(png(header(2, 1, 8, 2), "\x01\x33\x66\x99\x01\x02\x03"s)).at(1, 0),
              glm::vec3(52.0f, 104.0f, 156.0f) / 255.0f);
    EXPECT_EQ(readBytes(png(header(1, 1, 8, 0), "\x00\x33"s)).at(0, 0), glm::vec3(0.2f));
    EXPECT_EQ(readBytes(png(header(3, 1, 1, 0), "\x00\xa0"s)).at(2, 0), glm::vec3(1.0f));
    EXPECT_EQ(readBytes(png(header(2, 1, 4, 0), "\x00\x3f"s)).at(0, 0), glm::vec3(0.2f));
    EXPECT_EQ(readBytes(png(header(1, 1, 16, 0), "\x00\x12\x34"s)).at(0, 0), glm::vec3(4660.0f / 65535.0f));
    EXPECT_EQ(readBytes(png(header(1, 1, 16, 2), "\x00\x00\x01\x00\x02\xff\xff"s)).at(0, 0),
              glm::vec3(1.0f / 65535.0f, 2.0f / 65535.0f, 1.0f));
    EXPECT_EQ(
        readBytes(png(header(2, 1, 2, 3), "\x00\x40"s, chunk("PLTE", "\x00\x00\x00\x33\x66\xff"s))).at(0, 0),
        glm::vec3(0.2f, 0.4f, 1.0f));
    // An index past the palette's end is black.
    EXPECT_EQ(readBytes(png(header(1, 1, 8, 3), "\x00\x09"s, chunk("PLTE", "\xff\xff\xff"s))).at(0, 0),
              glm::vec3(0.0f));
}

TEST_F(ImageFileTest, PngAlphaIsDroppedAndColoursStayAsStored) {
    EXPECT_EQ(readBytes(png(header(1, 1, 8, 6), "\x00\x33\x66\x99\x00"s)).at(0, 0),
              glm::vec3(0.2f, 0.4f, 0.6f));
    EXPECT_EQ(readBytes(png(header(1, 1, 8, 4), "\x00\x33\x00"s)).at(0, 0), glm::vec3(0.2f));
    EXPECT_EQ(readBytes(png(header(1, 1, 16, 6), "\x00\xff\xff\x00\x00\xff\xff\x12\x34"s)).at(0, 0),
              glm::vec3(1.0f, 0.0f, 1.0f));
    EXPECT_EQ(readBytes(png(header(1, 1, 8, 0), "\x00\x33"s, chunk("tRNS", "\x00\x33"s))).at(0, 0),
              glm::vec3(0.2f));
}

TEST_F(ImageFileTest, WhatFollowsAPngIsPadding) {
    const std::string good = png(header(1, 1, 8, 0), "\x00\x33"s);
    for (const std::string &padding : {"\0"s, "\0\0\0"s, std::string(1000, 'x'), good})
        EXPECT_EQ(readBytes(good + padding).at(0, 0), glm::vec3(0.2f));
}

TEST_F(ImageFileTest, InterlacedPngIsRead) {
    // 3 x 3 grey, Adam7: pass 1 (0,0); 4 (2,0); 5 (0,2) (2,2); 6 (1,0) then (1,2); 7 the row y = 1.
    const std::string rows = "\x00\x01" // (0,0)
                             "\x00\x02" // (2,0)
                             "\x00\x03\x04"
                             "\x00\x05\x00\x06"
                             "\x00\x07\x08\x09"s;
    const Image image = readBytes(png(header(3, 3, 8, 0, 1), rows));
    const int expected[3][3] = {{1, 5, 2}, {7, 8, 9}, {3, 6, 4}};
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x)
            EXPECT_EQ(image.at(x, y).x, static_cast<float>(expected[y][x]) / 255.0f) << x << ' ' << y;
}

TEST_F(ImageFileTest, AncillaryChunksAndSplitDataArePassedOver) {
    const std::string data = zlibStored("\x00\x33"s);
    const std::string file = pngSignature + header(1, 1, 8, 0) + chunk("tEXt", "Comment\0text"s) +
                             chunk("IDAT", data.substr(0, 5)) + chunk("IDAT", "") +
                             chunk("IDAT", data.substr(5)) + chunk("tIME", "1234567") + chunk("IEND", "");
    EXPECT_EQ(readBytes(file).at(0, 0), glm::vec3(0.2f));
}

TEST_F(ImageFileTest, WhatPixelsDoNotNeedMayBeWrong) {
    std::string texts;
    for (int i = 0; i < 1001; ++i)
        texts += chunk("tEXt", "Comment\0text"s);
    for (const std::string &between :
         {texts, spoilt(chunk("tEXt", "Comment\0text"s)), chunk("tEXt", ""),
          chunk("zTXt", "a\0\0not packed"s), chunk("iCCP", "a\0\0not packed"s),
          chunk("iTXt", std::string(9'000'000, 'x')), chunk("eXIf", ""), chunk("gAMA", "\0\0\0\0"s),
          chunk("sBIT", "\0"s), chunk("abCd", "x"), chunk("PLTE", "123"), chunk("tRNS", "1")})
        EXPECT_EQ(readBytes(png(header(1, 1, 8, 0), "\x00\x33"s, between)).at(0, 0), glm::vec3(0.2f))
            << between.substr(0, 20);
    const std::string beforePalette = chunk("bKGD", "\0\0\0\0\0\0"s) + chunk("PLTE", "123");
    EXPECT_EQ(readBytes(png(header(1, 1, 8, 2), "\x00\x33\x33\x33"s, beforePalette)).at(0, 0),
              glm::vec3(0.2f));
    // More colours than one bit can tell apart.
    EXPECT_EQ(readBytes(png(header(1, 1, 1, 3), "\x00\x80"s, chunk("PLTE", "111333555"))).at(0, 0),
              glm::vec3(0.2f));
    const std::string data = zlibStored("\x00\x33"s) + "more";
    EXPECT_EQ(readBytes(pngSignature + header(1, 1, 8, 0) + chunk("IDAT", data) + chunk("IEND", "")).at(0, 0),
              glm::vec3(0.2f));
}

TEST_F(ImageFileTest, PngThatStatesTooSmallAWindowIsRead) {
    std::string rows; // six of 100 bytes, the last three as the first
    for (int i = 0; i < 600; ++i)
        rows += static_cast<char>(i % 100 == 0 ? 0 : (i % 300) * (i % 300) / 7);
    std::string packed(1000, '\0');
    uLongf packedBytes = packed.size();
    ASSERT_EQ(compress(reinterpret_cast<Bytef *>(packed.data()), &packedBytes,
                       reinterpret_cast<const Bytef *>(rows.data()), rows.size()),
              Z_OK);
    packed.resize(packedBytes);
    packed.replace(0, 2, "\x08\x1d"); // 256 bytes
    const std::string file = pngSignature + header(99, 6, 8, 0) + chunk("IDAT", packed) + chunk("IEND", "");
    const auto lastLevel = static_cast<unsigned char>(rows.back());
    EXPECT_EQ(readBytes(file).at(98, 5), glm::vec3(static_cast<float>(lastLevel) / 255.0f));
}

TEST_F(ImageFileTest, DamagedPngIsRefused) {
    const std::string ihdr = header(1, 1, 8, 0);
    const std::string idat = chunk("IDAT", zlibStored("\x00\x33"s));
    const std::string iend = chunk("IEND", "");
    const std::string good = pngSignature + ihdr + idat + iend;
    EXPECT_EQ(readBytes(good).at(0, 0), glm::vec3(0.2f));

    for (std::size_t size = 0; size < good.size(); ++size)
        expectBadBytes(good.substr(0, size), ": ");
    for (std::size_t i = 0; i < good.size(); ++i) { // each bit of the file is under a checksum or checked
        for (int bit = 0; bit < 8; ++bit) {
            std::string bytes = good;
            bytes[i] = static_cast<char>(bytes[i] ^ (1 << bit));
            expectBadBytes(bytes, ": ");
        }
    }
    expectBadBytes(pngSignature + idat + iend, "Missing IHDR before IDAT");
    expectBadBytes(pngSignature + ihdr + iend, "IEND: out of place");
    expectBadBytes(pngSignature + ihdr + ihdr + idat + iend, "byte 41: IHDR: out of place");
    expectBadBytes(pngSignature + ihdr + chunk("ABCD", "") + idat + iend, "ABCD: unhandled critical chunk");
    expectBadBytes(pngSignature + ihdr + idat + chunk("tEXt", "") + idat + iend, "Too many IDATs");
    expectBadBytes(png(header(0, 1, 8, 0), "\x00"s), "width is zero");
    expectBadBytes(png(header(40000, 1, 8, 0), "\x00"s), "its size is 40000 x 1");
    expectBadBytes(png(header(32768, 32768, 8, 0), "\x00"s), "an image 268435456");
    expectBadBytes(png(header(16384, 16384, 8, 2), "\x00"s), "cannot be packed in 69 bytes");
    expectBadBytes(png(header(16384, 16384, 16, 6), "\x00"s), "cannot be packed in 69 bytes");
    expectBadBytes(png(header(1, 1, 3, 0), "\x00\x33"s), "bit depth");
    expectBadBytes(png(header(1, 1, 8, 5), "\x00\x33"s), "color type");
    expectBadBytes(png(header(1, 1, 8, 0, 2), "\x00\x33"s), "interlace method");
    expectBadBytes(png(header(1, 1, 8, 3), "\x00\x00"s), "Missing PLTE");
    expectBadBytes(png(header(1, 1, 8, 3), "\x00\x00"s, chunk("PLTE", "12")), "PLTE: invalid");
    const std::string colours = chunk("PLTE", "123");
    expectBadBytes(png(header(1, 1, 8, 3), "\x00\x00"s, colours + colours), "PLTE: duplicate");
    expectBadBytes(png(header(1, 1, 8, 3), "\x00\x00"s, colours + spoilt(chunk("tRNS", "1"))),
                   "tRNS: CRC error");
    expectBadBytes(png(ihdr, "\x00"s), "Not enough image data");
    expectBadBytes(png(ihdr, "\x00\x33\x44"s), "Too much image data");
    expectBadBytes(png(ihdr, std::string(60000, '\0')), "Too much image data");
    expectBadBytes(pngSignature + ihdr + chunk("IDAT", spoilt(zlibStored("\x00\x33"s))) + iend,
                   "IDAT: incorrect data check");
    expectBadBytes(png(ihdr, "\x07\x33"s), "bad adaptive filter value");
    expectBadBytes("GIF89a", "no PNG, OpenEXR, Radiance (HDR) or PFM");
    expectBadBytes("", "empty");
}

TEST_F(ImageFileTest, OnlyRegularFilesAreRead) {
    expectBad(folder, "not a regular file");
    expectBad(folder / "missing", "No such file");
    expectBad("/dev/zero", "not a regular file");
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    expectBad(folder / "pipe", "not a regular file");
}

struct Chunk {
    std::string type;
    std::string data;
};

/// The chunks of a PNG, whose checksums are expected to be right.
std::vector<Chunk> chunksOf(const std::string &file) {
    std::vector<Chunk> chunks;
    std::size_t at = pngSignature.size();
    EXPECT_EQ(file.substr(0, at), pngSignature);
    while (at + 12 <= file.size()) {
        std::size_t sizeBytes = 0;
        for (std::size_t i = 0; i < 4; ++i)
            sizeBytes = sizeBytes << 8 | static_cast<unsigned char>(file[at + i]);
        chunks.push_back({file.substr(at + 4, 4), file.substr(at + 8, sizeBytes)});
        EXPECT_EQ(file.substr(at, sizeBytes + 12), chunk(chunks.back().type, chunks.back().data));
        at += sizeBytes + 12;
    }
    EXPECT_EQ(at, file.size());
    return chunks;
}

std::string fileOf(const Image &image, const std::vector<Attribute> &attributes) {
    const std::vector<std::byte> png =
        encodePng(image.width(), image.height(), toneMap(image, 0.0), attributes);
    return {reinterpret_cast<const char *>(png.data()), png.size()};
}

TEST_F(ImageFileTest, APngSaysWhatItIsToldToAndShowsTheSame) {
    const Image image = randomImage(13, 7, 5);
    const std::string plain = fileOf(image, {});
    const std::string file =
        fileOf(image, {{"software", "a\x1b[31m\xff"}, {"empty", ""}, {"long", std::string(1'000'000, 'x')}});
    const std::vector<Chunk> chunks = chunksOf(file);
    ASSERT_EQ(chunks.size(), 6u);
    EXPECT_EQ(chunks[0].type, "IHDR");
    const std::string inNoLanguage(5, '\0');
    EXPECT_EQ(chunks[1].data, "Software" + inNoLanguage + "a\uFFFD[31m\uFFFD");
    EXPECT_EQ(chunks[2].data, "empty" + inNoLanguage);
    EXPECT_EQ(chunks[3].data, "long" + inNoLanguage + std::string(1'000'000, 'x'));
    for (std::size_t i = 1; i < 4; ++i)
        EXPECT_EQ(chunks[i].type, "iTXt");
    EXPECT_EQ(chunks[4].type, "IDAT");
    EXPECT_EQ(chunks[4].data, chunksOf(plain)[1].data);
    EXPECT_EQ(chunks[5].type, "IEND");
    EXPECT_EQ(readBytes(file).pixels(), readBytes(plain).pixels());
}

TEST_F(ImageFileTest, TextsAreReadAsTheyWereWritten) {
    const Image image = randomImage(13, 7, 5);
    const std::vector<Attribute> attributes{{"software", "hyalite"}, {"scene", "a \u00FC.json"}};
    Picture picture(image);
    picture.attributes = attributes;
    for (const char *name : {"a.png", "a.exr"}) {
        AtomicFile file(folder / name);
        writeImage(file, imageFormatOf(name), picture, 0.0);
        file.commit();
        std::vector<Attribute> read = readAttributes(folder / name);
        std::erase_if(read, [](const Attribute &attribute) { return attribute.first == "pixels"; });
        std::ranges::sort(read, std::greater());
        EXPECT_EQ(read, attributes) << name;
    }
    AtomicFile file(folder / "a.pfm");
    writeImage(file, ImageFormat::Pfm, picture, 0.0);
    file.commit();
    EXPECT_TRUE(readAttributes(folder / "a.pfm").empty());
}

TEST_F(ImageFileTest, TextsOfOtherProgramsAreReadAndDamagedOnesPassedOver) {
    const std::string plain = fileOf(randomImage(3, 2, 1), {});
    constexpr std::size_t headerEnd = 33;
    const auto textsOf = [&](const std::string &chunks) {
        std::ofstream(folder / "a.png", std::ios::binary)
            << plain.substr(0, headerEnd) << chunks << plain.substr(headerEnd);
        return readAttributes(folder / "a.png");
    };
    const std::vector<Attribute> one{{"name", "text"}};
    EXPECT_EQ(textsOf(chunk("tEXt", "name\0text"s)), one);
    EXPECT_EQ(textsOf(chunk("iTXt", "name\0\0\0de\0Name\0text"s)), one);
    EXPECT_EQ(textsOf(chunk("zTXt", "name\0\0x"s) + chunk("iTXt", "name\0\1\0\0\0x"s)).size(),
              0u); // compressed
    EXPECT_EQ(textsOf(chunk("iTXt", "name")).size(), 0u);
    EXPECT_EQ(textsOf(chunk("iTXt", "name\0\0\0de"s)), (std::vector<Attribute>{{"name", ""}}));
    EXPECT_EQ(textsOf(chunk("tEXt", "")), (std::vector<Attribute>{{"", ""}}));
    EXPECT_EQ(textsOf(chunk("tEXt", std::string(2'000'000, 'x')) + chunk("tEXt", "name\0text"s)), one);
    EXPECT_EQ(textsOf("\xff\xff\xff\xfftEXt"s).size(), 0u);
    std::ofstream(folder / "a.png", std::ios::binary) << plain.substr(0, 11);
    EXPECT_TRUE(readAttributes(folder / "a.png").empty());
}

TEST_F(ImageFileTest, AFailingOutputIsReportedByTheWriter) {
    const Image image(4, 4);
    AtomicFile file(folder / "out.png");
    writeImage(file, ImageFormat::Png, image, 0.0);
    fs::create_directory(folder / "out.png");
    EXPECT_THROW(file.commit(), Error);
}

} // namespace
} // namespace hyalite::core
