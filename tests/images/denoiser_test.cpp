// The denoiser on the device: the bits of its twin.
#include "host/reference/denoise.h"
#include "tests/fixtures/noisy_fixture.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

namespace hyalite::core::testing {
namespace {

void expectTwin(const NoisyPicture &picture, const std::string &name, const gpu::RenderConfig &config = {}) {
    const Image expected = reference::denoise(picture);
    const Image image = rendererBy(config).denoise(picture);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
        differing += std::memcmp(&image.pixels()[i], &expected.pixels()[i], sizeof(glm::vec3)) != 0;
    EXPECT_EQ(differing, 0u) << name;
}

TEST(DenoiserTwin, HasEqualBits) {
    for (const auto &[first, samples] :
         {std::pair{1, 2}, std::pair{4, 5}, std::pair{8, 16}, std::pair{512, 1024}})
        expectTwin(makeNoisyRoom(150, 100, first, samples).picture, std::to_string(samples) + " samples");
}

TEST(DenoiserTwin, HasEqualBitsByOwnDivision) {
    expectTwin(makeNoisyRoom(100, 60).picture, "own division", {.arithmetic = gpu::Arithmetic::Own});
}

TEST(DenoiserTwin, HasEqualBitsInSeveralTiles) {
    expectTwin(makeNoisyRoom(denoiserTileSide + 40, 30).picture, "wide");
    expectTwin(makeNoisyRoom(20, denoiserTileSide + 3).picture, "high");
}

TEST(DenoiserTwin, HasEqualBitsOfSmallPictures) {
    for (const auto &[width, height] : {std::pair{1, 1}, std::pair{2, 9}, std::pair{17, 1}})
        expectTwin(makeNoisyRoom(width, height).picture, std::to_string(width));
}

TEST(DenoiserTwin, HasEqualBitsOfFaultyPictures) {
    NoisyPicture picture = makeNoisyRoom(60, 40).picture;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    picture.pixels[100].colour.x = std::numeric_limits<float>::quiet_NaN();
    picture.pixels[600].first.y = infinity;
    picture.pixels[1200].variance.z = infinity;
    picture.pixels[1700].normal.x = std::numeric_limits<float>::quiet_NaN();
    picture.pixels[2000].depth = -infinity;
    picture.pixels[2300].colour = glm::vec3(3e38f);
    expectTwin(picture, "faults");
}

} // namespace
} // namespace hyalite::core::testing
