// A folder for the files of one test, and pictures to put there.
#pragma once

#include "host/error.h"
#include "host/image/image_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

namespace hyalite::testing {

class PictureFiles : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string name = (std::filesystem::temp_directory_path() / "hyalite-picture-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder = name;
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    /// Writes the picture in the format that the name asks for.
    std::filesystem::path write(const std::string &name, const Picture &picture,
                                double exposureStops = 0.0) const {
        AtomicFile file(folder / name);
        writeImage(file, imageFormatOf(name), picture, exposureStops);
        file.commit();
        return folder / name;
    }

    std::filesystem::path store(const std::string &name, const std::string &bytes) const {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        return folder / name;
    }

    [[nodiscard]] std::string load(const std::string &name) const {
        std::ifstream stream(folder / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    /// readImage() of such a file is Error{BadInput}, and names the file and what was found.
    void expectBad(const std::filesystem::path &path, const std::string &found) const {
        expectRefused(path, found, ExitCode::BadInput);
    }

    void expectRefused(const std::filesystem::path &path, const std::string &found, ExitCode exitCode) const {
        try {
            (void)readImage(path);
            ADD_FAILURE() << "read, but should have said: " << found;
        } catch (const Error &error) {
            EXPECT_EQ(error.exitCode, exitCode);
            EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(found), std::string::npos) << error.what();
        }
    }

    std::filesystem::path folder;
};

/// Every float there is: NaNs, infinities and denormals among them.
inline Image randomBits(int width, int height, std::uint32_t seed) {
    std::mt19937 random(seed);
    Image image(width, height);
    for (glm::vec3 &pixel : image.pixels())
        for (int channel = 0; channel < 3; ++channel)
            pixel[channel] = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    return image;
}

inline bool sameBits(const Image &a, const Image &b) {
    return a.width() == b.width() && a.height() == b.height() &&
           std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size() * sizeof(glm::vec3)) == 0;
}

} // namespace hyalite::testing
