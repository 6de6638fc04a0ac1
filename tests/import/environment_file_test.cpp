// Environment images: every format, and numbers that are no radiance.
#include "host/import/environment_file.h"

#include "host/base/atomic_file.h"
#include "host/image/exr.h"
#include "host/image/image_file.h"
#include "tests/fixtures/scene_json_fixture.h"

#include <gtest/gtest.h>

#include <limits>

namespace hyalite::core {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

class EnvironmentFile : public ::testing::Test {
  protected:
    const testing::TemporaryFolder temporary_;
    const std::filesystem::path &folder = temporary_.path;

    /// Two pixels, written and read again.
    [[nodiscard]] EnvironmentImage written(const char *name, const glm::vec3 &left,
                                           const glm::vec3 &right) const {
        Image image(2, 1);
        image.pixels() = {left, right};
        AtomicFile file(folder / name);
        writeImage(file, imageFormatOf(name), image, 0.0, {.tone = ToneCurve::Srgb});
        file.commit();
        return readEnvironmentImage(folder / name);
    }
};

TEST_F(EnvironmentFile, IsReadAsItIs) {
    for (const char *name : {"sky.pfm", "sky.exr", "sky.hdr"}) {
        const EnvironmentImage sky = written(name, {0.5f, 2.0f, 1.0f}, {0.25f, 0.0f, 8.0f});
        EXPECT_EQ(sky.radiance.pixels(), (std::vector<glm::vec3>{{0.5f, 2.0f, 1.0f}, {0.25f, 0.0f, 8.0f}}))
            << name;
        EXPECT_TRUE(sky.warnings.empty());
    }
}

TEST_F(EnvironmentFile, IsTheDisplayWindowOfAnExr) {
    Image stored(2, 2);
    stored.pixels() = {glm::vec3(1), glm::vec3(2), glm::vec3(3), glm::vec3(4)};
    Picture picture(stored);
    picture.wholeWidth = 4;
    picture.wholeHeight = 3;
    picture.crop = {1, 3, 1, 3};
    AtomicFile file(folder / "window.exr");
    writeExr(file, picture);
    file.commit();
    const Image sky = readEnvironmentImage(folder / "window.exr").radiance;
    ASSERT_EQ(sky.width(), 4);
    ASSERT_EQ(sky.height(), 3);
    const float expected[3][4] = {{0, 0, 0, 0}, {0, 1, 2, 0}, {0, 3, 4, 0}};
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x)
            EXPECT_EQ(sky.at(x, y), glm::vec3(expected[y][x])) << x << ' ' << y;
    EXPECT_EQ(readImage(folder / "window.exr").image.width(), 2) << "what is stored";
}

TEST_F(EnvironmentFile, OfLevelsIsDecodedFromSrgb) {
    const EnvironmentImage sky = written("sky.png", {0.0f, 0.2f, 1.0f}, {0.5f, 0.002f, 7.0f});
    const std::array<glm::vec3, 2> expected{glm::vec3(0.0f, 0.2f, 1.0f), {0.5f, 0.002f, 1.0f}};
    for (std::size_t i = 0; i < 2; ++i)
        for (glm::length_t channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(sky.radiance.pixels()[i][channel], expected[i][channel], 0.005f);
    EXPECT_TRUE(sky.warnings.empty());
}

TEST_F(EnvironmentFile, CountsWhatIsNoRadiance) {
    const EnvironmentImage sky = written("sky.pfm", {-1.0f, 2.0f, infinity}, {nan, -infinity, 3.0f});
    EXPECT_EQ(sky.radiance.pixels(), (std::vector<glm::vec3>{{0.0f, 2.0f, 65504.0f}, {0.0f, 0.0f, 3.0f}}));
    ASSERT_EQ(sky.warnings.size(), 3u);
    EXPECT_NE(sky.warnings[0].find("2 of 2 pixels have negative numbers, which count as 0"),
              std::string::npos)
        << sky.warnings[0];
    EXPECT_NE(sky.warnings[1].find("1 of 2 pixels have infinite numbers, which count as 65504"),
              std::string::npos)
        << sky.warnings[1];
    EXPECT_NE(sky.warnings[2].find("1 of 2 pixels have numbers that are NaN, which count as 0"),
              std::string::npos)
        << sky.warnings[2];
}

TEST_F(EnvironmentFile, GivesInfiniteNumbersTheLargestFiniteOne) {
    EXPECT_EQ(written("sky.pfm", {1e6f, 0.0f, 0.0f}, {infinity, 0.0f, 0.0f}).radiance.pixels()[1].x, 1e6f);
}

} // namespace
} // namespace hyalite::core
