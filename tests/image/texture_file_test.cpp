// Files of textures: what they are read to, and that hostile ones are refused.
#include "host/image/texture_file.h"

#include "host/base/error.h"
#include "host/image/image_file.h"
#include "host/image/jpeg.h"
#include "host/image/png.h"
#include "host/import/texture_library.h"
#include "tests/fixtures/png_fixture.h"
#include "tests/fixtures/scene_json_fixture.h"

#include <cstdio> // jpeglib.h needs it
#include <cstring>
#include <functional>

#include <jpeglib.h>

namespace hyalite::core {
namespace {

/// A JPEG of the best quality, whose channels `at` gives; `tune` may change how it is written.
std::string encodeJpeg(unsigned width, unsigned height, int channels, J_COLOR_SPACE space,
                       const std::function<unsigned char(unsigned x, unsigned y, int channel)> &at,
                       const std::function<void(jpeg_compress_struct &)> &tune = {}) {
    jpeg_compress_struct encoder{};
    jpeg_error_mgr errors{};
    encoder.err = jpeg_std_error(&errors);
    jpeg_create_compress(&encoder);
    unsigned char *bytes = nullptr;
    unsigned long sizeBytes = 0;
    jpeg_mem_dest(&encoder, &bytes, &sizeBytes);
    encoder.image_width = width;
    encoder.image_height = height;
    encoder.input_components = channels;
    encoder.in_color_space = space;
    jpeg_set_defaults(&encoder);
    jpeg_set_quality(&encoder, 100, TRUE);
    if (tune)
        tune(encoder);
    jpeg_start_compress(&encoder, TRUE);
    std::vector<unsigned char> row(static_cast<std::size_t>(width) * static_cast<std::size_t>(channels));
    for (unsigned y = 0; y < height; ++y) {
        for (std::size_t i = 0; i < row.size(); ++i)
            row[i] = at(static_cast<unsigned>(i) / static_cast<unsigned>(channels), y,
                        static_cast<int>(i % static_cast<std::size_t>(channels)));
        JSAMPROW rows = row.data();
        jpeg_write_scanlines(&encoder, &rows, 1);
    }
    jpeg_finish_compress(&encoder);
    const std::string file(reinterpret_cast<const char *>(bytes), sizeBytes);
    jpeg_destroy_compress(&encoder);
    std::free(bytes);
    return file;
}

unsigned char slope(unsigned x, unsigned y, int channel) {
    return static_cast<unsigned char>(channel == 0 ? 4 * x : channel == 1 ? 4 * y : 128);
}

class TextureFile : public SceneFolder {
  protected:
    [[nodiscard]] Texture read(const std::string &name, const std::string &bytes) const {
        return readTexture(write(name, bytes));
    }

    [[nodiscard]] std::string refusal(const std::string &bytes) const {
        try {
            static_cast<void>(read("texture", bytes));
        } catch (const Error &error) {
            EXPECT_TRUE(error.kind == ErrorKind::BadInput || error.kind == ErrorKind::LimitExceeded);
            EXPECT_TRUE(std::string(error.what()).starts_with((folder / "texture").string() + ": "))
                << error.what();
            return error.what();
        }
        return {};
    }

    void expectRefused(const std::string &bytes, const std::string &part) const {
        EXPECT_NE(refusal(bytes).find(part), std::string::npos) << refusal(bytes);
    }
};

int channelOf(const Texture &texture, int x, int y, int channel) {
    return static_cast<int>(texture.levels[static_cast<std::size_t>(y * texture.width + x)] >> (8 * channel) &
                            255u);
}

TEST_F(TextureFile, ReadsPngsAsTheyAre) {
    const std::uint8_t rgb[] = {1, 2, 3, 250, 0, 128};
    const std::vector<std::byte> bytes = encodePng(2, 1, rgb);
    const Texture texture =
        read("a.png", std::string(reinterpret_cast<const char *>(bytes.data()), bytes.size()));
    ASSERT_EQ(texture.width, 2);
    ASSERT_EQ(texture.height, 1);
    EXPECT_EQ(texture.levels, (std::vector<std::uint32_t>{0xFF030201u, 0xFF8000FAu}));
    EXPECT_FALSE(texture.hasAlpha);
    EXPECT_EQ(texture.name, (folder / "a.png").string());
}

TEST_F(TextureFile, ReadsTheAlphaOfPngs) {
    const Texture colour = read("rgba.png", storedPng(6, {10, 20, 30, 40}));
    EXPECT_TRUE(colour.hasAlpha);
    EXPECT_EQ(colour.levels, std::vector<std::uint32_t>{0x281E140Au});
    const Texture grey = read("grey.png", storedPng(4, {9, 77}));
    EXPECT_TRUE(grey.hasAlpha);
    EXPECT_EQ(grey.levels, std::vector<std::uint32_t>{0x4D090909u});
    EXPECT_TRUE(lookAt(grey).isGrey);
    EXPECT_FALSE(lookAt(colour).isGrey);
}

TEST_F(TextureFile, ReadsTheTransparencyOfPalettesAndOfOneColour) {
    // A chunk behind the header, which ends at byte 33.
    const auto with = [](std::string png,
                         const std::vector<std::pair<const char *, std::vector<std::uint8_t>>> &chunks) {
        std::vector<std::byte> added;
        for (const auto &[type, bytes] : chunks)
            appendChunk(added, type, std::as_bytes(std::span(bytes)));
        return png.insert(33, reinterpret_cast<const char *>(added.data()), added.size());
    };
    std::string indices = storedPng(0, {0, 1, 2}, 3);
    std::vector<std::byte> header(indices.size());
    std::memcpy(header.data(), indices.data(), indices.size());
    std::vector<std::byte> palette(header.begin() + 16, header.begin() + 29);
    palette[9] = std::byte{3}; // the colour type
    std::vector<std::byte> chunk;
    appendChunk(chunk, "IHDR", palette);
    indices.replace(8, 25, reinterpret_cast<const char *>(chunk.data()), chunk.size());
    const std::vector<std::uint8_t> colours{10, 20, 30, 40, 50, 60, 70, 80, 90};
    const Texture some = read("a.png", with(indices, {{"PLTE", colours}, {"tRNS", {0, 127}}}));
    EXPECT_TRUE(some.hasAlpha);
    EXPECT_EQ(some.levels, (std::vector<std::uint32_t>{0x001E140Au, 0x7F3C3228u, 0xFF5A5046u}));
    EXPECT_FALSE(read("b.png", with(indices, {{"PLTE", colours}})).hasAlpha);
    EXPECT_FALSE(read("c.png", with(indices, {{"tRNS", {0}}, {"PLTE", colours}})).hasAlpha) << "misplaced";
    const Texture keyed = read("d.png", with(storedPng(0, {9, 8}, 2), {{"tRNS", {0, 8}}}));
    EXPECT_TRUE(keyed.hasAlpha);
    EXPECT_EQ(keyed.levels, (std::vector<std::uint32_t>{0xFF090909u, 0x00080808u}));
}

TEST_F(TextureFile, SaysWhatItLooksLike) {
    const auto refusalOfFile = [&](const std::string &bytes) -> std::string {
        try {
            (void)read("a.png", bytes);
        } catch (const Error &error) {
            return error.what();
        }
        return {};
    };
    EXPECT_NE(refusalOfFile("version https://git-lfs.github.com/spec/v1\n").find("a pointer of Git LFS"),
              std::string::npos);
    EXPECT_NE(refusalOfFile("<!DOCTYPE html>\n").find("a web page"), std::string::npos);
}

TEST_F(TextureFile, ReadsJpegs) {
    for (const bool isProgressive : {false, true}) {
        const Texture texture =
            read("a.jpg", encodeJpeg(50, 40, 3, JCS_RGB, slope, [&](jpeg_compress_struct &encoder) {
                     if (isProgressive)
                         jpeg_simple_progression(&encoder);
                 }));
        ASSERT_EQ(texture.width, 50);
        ASSERT_EQ(texture.height, 40);
        EXPECT_FALSE(texture.isFloat());
        EXPECT_FALSE(texture.hasAlpha);
        for (const auto &[x, y] : {std::pair(3, 4), std::pair(44, 5), std::pair(20, 39)}) {
            EXPECT_NEAR(channelOf(texture, x, y, 0), 4 * x, 6);
            EXPECT_NEAR(channelOf(texture, x, y, 1), 4 * y, 6);
            EXPECT_NEAR(channelOf(texture, x, y, 2), 128, 6);
            EXPECT_EQ(channelOf(texture, x, y, 3), 255);
        }
    }
    const Texture grey = read("grey.jpg", encodeJpeg(8, 8, 1, JCS_GRAYSCALE, slope));
    EXPECT_TRUE(lookAt(grey).isGrey);
    EXPECT_NEAR(channelOf(grey, 5, 5, 2), 20, 4);
}

TEST_F(TextureFile, ReadsRadianceFilesAsFloats) {
    const Texture texture = read("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n" +
                                              std::string("\x80\x40\x00\x88", 4));
    EXPECT_TRUE(texture.isFloat());
    EXPECT_EQ(texture.values, std::vector<glm::vec3>{glm::vec3(128.0f, 64.0f, 0.0f)});
}

TEST_F(TextureFile, RefusesWhatIsDamaged) {
    const std::string jpeg = encodeJpeg(64, 64, 3, JCS_RGB, [](unsigned x, unsigned y, int channel) {
        return static_cast<unsigned char>((x * 37 + y * 101 + static_cast<unsigned>(channel) * 59) % 256);
    });
    ASSERT_EQ(refusal(jpeg), "");
    expectRefused("", "it is empty");
    expectRefused("no picture", "no PNG, JPEG, WebP or Radiance");
    expectRefused("\xFF\xD8\xFF", "it is damaged");
    for (const std::size_t length : {std::size_t{20}, jpeg.size() / 2, jpeg.size() - 2})
        expectRefused(jpeg.substr(0, length), "it is damaged");
    std::string holed = jpeg;
    holed.replace(holed.size() / 2, 40, 40, '\xFF');
    expectRefused(holed, "it is damaged");
    expectRefused(encodeJpeg(8, 8, 4, JCS_CMYK, slope), "4 channels");
}

TEST_F(TextureFile, RefusesWhatTakesMoreMemoryThanItsSizeAllows) {
    std::string bomb = encodeJpeg(16, 16, 3, JCS_RGB, slope);
    const std::size_t frame = bomb.find("\xFF\xC0");
    ASSERT_NE(frame, std::string::npos);
    bomb.replace(frame + 5, 4, "\x3F\xFF\x3F\xFF");
    expectRefused(bomb, "16383 x 16383 pixels take");
    bomb.replace(frame + 5, 4, std::string("\xF0\x00\x00\x10", 4));
    expectRefused(bomb, "a side may have 1 to 32768 pixels");
}

TEST_F(TextureFile, RefusesMoreScansThanAPictureNeeds) {
    std::vector<jpeg_scan_info> scans(1, {3, {0, 1, 2}, 0, 0, 0, 0});
    for (int i = 0; i < 3; ++i)
        for (int k = 1; k < 64; ++k)
            scans.push_back({1, {i, 0, 0, 0}, k, k, 0, 0});
    expectRefused(encodeJpeg(16, 16, 3, JCS_RGB, slope,
                             [&](jpeg_compress_struct &encoder) {
                                 encoder.scan_info = scans.data();
                                 encoder.num_scans = static_cast<int>(scans.size());
                             }),
                  "more than 64 scans");
}

TEST_F(TextureFile, ALibraryReadsEachFileOnce) {
    const std::filesystem::path a = write("a.png", storedPng(6, {10, 20, 30, 40}));
    const std::filesystem::path b = write("b.png", storedPng(6, {11, 20, 30, 40}));
    TextureLibrary library;
    EXPECT_EQ(library.load(a), 0u);
    EXPECT_EQ(library.load(b), 1u);
    EXPECT_EQ(library.load(folder / "." / "a.png"), 0u);
    EXPECT_EQ(library.give().size(), 2u);
}

} // namespace
} // namespace hyalite::core
