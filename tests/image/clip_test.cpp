// Clips: other readers find the frames that were added, in time, and the texts.
#include "host/image/clip.h"

#include "host/base/error.h"
#include "tests/fixtures/clip_fixture.h"
#include "tests/fixtures/picture_fixture.h"

#include <random>

namespace hyalite::core::testing {
namespace {

class Clip : public PictureFiles, public ::testing::WithParamInterface<ClipFormat> {
  protected:
    [[nodiscard]] DecodedClip decoded(const std::vector<std::vector<std::uint8_t>> &frames, int width,
                                      int height, double framesPerSecond) const {
        AtomicFile file(folder / "clip");
        const auto writer = makeClipWriter(file, GetParam(), framesPerSecond);
        for (const std::vector<std::uint8_t> &levels : frames)
            writer->add(width, height, levels);
        EXPECT_EQ(writer->frameCount(), frames.size());
        writer->finish(attributes);
        file.commit();
        return GetParam() == ClipFormat::Webp ? decodeWebpClip(load("clip"))
                                              : decodeApngClip(load("clip"), folder);
    }

    std::vector<Attribute> attributes{{"software", "hyalite"}, {"settings.spp", "<&>\" 4 \xe2\x82\xac"}};
};

std::vector<std::uint8_t> noisyLevels(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<std::uint8_t> levels(count);
    for (std::uint8_t &level : levels)
        level = static_cast<std::uint8_t>(random());
    return levels;
}

TEST_P(Clip, HasTheLevelsOfItsFrames) {
    for (const std::size_t channelCount : {std::size_t{3}, std::size_t{4}})
        for (const std::size_t frameCount : {1, 2, 5}) {
            constexpr std::size_t pixelCount = 13 * 7;
            std::vector<std::vector<std::uint8_t>> frames;
            for (unsigned i = 0; i < frameCount; ++i)
                frames.push_back(noisyLevels(channelCount * pixelCount, i));
            if (channelCount == 4) // colours stay where nothing is seen of them
                for (std::size_t i = 0; i < pixelCount; i += 2)
                    frames.back()[4 * i + 3] = 0;
            const DecodedClip clip = decoded(frames, 13, 7, 8.0);
            EXPECT_TRUE(clip.playsForEver);
            ASSERT_EQ(clip.frames.size(), frameCount);
            for (std::size_t i = 0; i < frameCount; ++i) {
                EXPECT_EQ(clip.frames[i].width, 13);
                EXPECT_EQ(clip.frames[i].height, 7);
                EXPECT_DOUBLE_EQ(clip.frames[i].seconds, 0.125);
                for (std::size_t pixel = 0; pixel < pixelCount; ++pixel)
                    for (std::size_t channel = 0; channel < 4; ++channel)
                        ASSERT_EQ(clip.frames[i].rgba[4 * pixel + channel],
                                  channel < channelCount ? frames[i][channelCount * pixel + channel] : 255)
                            << "frame " << i << ", pixel " << pixel << ", channel " << channel;
            }
        }
}

TEST_P(Clip, TakesItsTime) {
    for (const double framesPerSecond : {1e-3, 0.5, 1.0, 23.976, 24.0, 29.97, 60.0, 144.5, 1000.0}) {
        const std::vector<std::vector<std::uint8_t>> frames(240, noisyLevels(3, 1));
        const DecodedClip clip = decoded(frames, 1, 1, framesPerSecond);
        double seconds = 0.0;
        for (const ClipFrame &frame : clip.frames) {
            EXPECT_NEAR(frame.seconds, 1.0 / framesPerSecond, 1e-3);
            seconds += frame.seconds;
        }
        EXPECT_NEAR(seconds * framesPerSecond, 240.0, 0.001 * framesPerSecond + 1e-3) << framesPerSecond;
    }
}

TEST_P(Clip, HasTexts) {
    const DecodedClip clip = decoded({noisyLevels(3, 1)}, 1, 1, 24.0);
    if (GetParam() == ClipFormat::Apng) {
        EXPECT_EQ(clip.texts, (std::map<std::string, std::string>{{"Software", "hyalite"},
                                                                  {"settings.spp", attributes[1].second}}));
        return;
    }
    const std::string &xmp = clip.texts.at("XMP");
    EXPECT_NE(xmp.find("<xmp:CreatorTool>hyalite</xmp:CreatorTool>"), std::string::npos) << xmp;
    EXPECT_NE(xmp.find("<hyalite:settings.spp>&lt;&amp;&gt;&quot; 4 \xe2\x82\xac</hyalite:settings.spp>"),
              std::string::npos)
        << xmp;
}

TEST_P(Clip, IsAPictureOfItsFirstFrameToReadersOfPng) {
    if (GetParam() != ClipFormat::Apng)
        return;
    const std::vector<std::uint8_t> first = noisyLevels(std::size_t{3} * 4, 1);
    (void)decoded({first, noisyLevels(std::size_t{3} * 4, 2)}, 2, 2, 24.0);
    EXPECT_EQ(pngLevels(readImage(folder / "clip").image, {}), first);
}

INSTANTIATE_TEST_SUITE_P(Formats, Clip, ::testing::Values(ClipFormat::Webp, ClipFormat::Apng),
                         [](const auto &tested) {
                             return tested.param == ClipFormat::Webp ? "Webp" : "Apng";
                         });

TEST(ClipFormats, AreThoseOfNames) {
    EXPECT_EQ(clipFormatOf("a.b/turn.WebP"), ClipFormat::Webp);
    EXPECT_EQ(clipFormatOf("turn.apng"), ClipFormat::Apng);
    EXPECT_EQ(clipFormatOf("webp:-"), ClipFormat::Webp);
    for (const char *name : {"turn.png", "webp", "-", "turn"})
        EXPECT_FALSE(clipFormatOf(name)) << name;
}

TEST(ClipFormats, HaveLargestFrames) {
    requireClipSize("a.webp", ClipFormat::Webp, 16383, 1);
    requireClipSize("a.apng", ClipFormat::Apng, 16384, 1);
    try {
        requireClipSize("a.webp", ClipFormat::Webp, 1, 16384);
        ADD_FAILURE() << "a WebP has no such frames";
    } catch (const Error &error) {
        EXPECT_EQ(error.kind, ErrorKind::LimitExceeded);
        EXPECT_NE(std::string(error.what()).find("'a.webp': a side of 1 x 16384"), std::string::npos)
            << error.what();
    }
}

} // namespace
} // namespace hyalite::core::testing
