// A viewer beside the render, by a small server of tev's protocol.
#include "host/jobs/display.h"

#include "host/base/error.h"
#include "tests/fixtures/tev_fixture.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <thread>

namespace hyalite::core {
namespace {

using testing::TevFixture;

Film filmOf(int width, int height) {
    Film film(Crop{3, 3 + width, 5, 5 + height});
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        film.pixels[i].sum = glm::vec3(static_cast<float>(i), 0.5f, 2.0f);
        film.pixels[i].sampleCount = 4;
    }
    return film;
}

TEST(Display, ShowsTheMeansOfAFilm) {
    TevFixture tev;
    const Film film = filmOf(100, 70);
    Display(tev.address(), "a picture.exr").update(film);
    tev.stop();
    EXPECT_TRUE(tev.faults().empty());
    ASSERT_EQ(tev.images().size(), 1u);
    const TevFixture::Shown &shown = tev.images().at("a picture.exr");
    EXPECT_EQ(shown.width, 100);
    EXPECT_EQ(shown.height, 70);
    EXPECT_EQ(shown.pixels, film.toImage().pixels());
}

TEST(Display, SendsTilesThatHaveGotSamples) {
    TevFixture tev;
    Film film = filmOf(200, 64); // 4 tiles
    {
        Display display(tev.address(), "a");
        display.update(film);
        display.update(film);
        film.pixels[70].sampleCount = 8;
        display.update(film);
    }
    tev.stop();
    EXPECT_EQ(tev.images().at("a").tileCount, 5);
    EXPECT_EQ(tev.images().at("a").pixels, film.toImage().pixels());
}

TEST(Display, ReplacesItsImageAndLeavesOthers) {
    TevFixture tev;
    Display(tev.address(), "a").update(filmOf(8, 8));
    Display(tev.address(), "b").update(filmOf(9, 9));
    Image clean(16, 16);
    clean.at(3, 4) = glm::vec3(0.25f);
    Display(tev.address(), "a").show(clean);
    tev.stop();
    ASSERT_EQ(tev.images().size(), 2u);
    EXPECT_EQ(tev.images().at("a").pixels, clean.pixels());
}

TEST(Display, ConnectsAgainAndSendsAll) {
    TevFixture tev;
    tev.hangUpAfter(3);
    Film film = filmOf(100, 100);
    auto display = std::make_unique<Display>(tev.address(), "a");
    const auto isGone = [&] {
        try {
            film.pixels[0].sampleCount += 1;
            display->update(film);
            return false;
        } catch (const Error &error) {
            EXPECT_EQ(error.kind, ErrorKind::OutputNotWritten);
            return true;
        }
    };
    while (!isGone())
        std::this_thread::yield();
    EXPECT_FALSE(isGone());
    display.reset();
    tev.stop();
    EXPECT_EQ(tev.images().at("a").pixels, film.toImage().pixels());
}

TEST(Display, OfAViewerThatIsNotThereFails) {
    std::string address;
    {
        const TevFixture tev;
        address = tev.address();
    }
    try {
        Display(address, "a");
        FAIL() << "nothing listens there";
    } catch (const Error &error) {
        EXPECT_EQ(error.kind, ErrorKind::OutputNotWritten);
        EXPECT_NE(std::string(error.what()).find(address), std::string::npos) << error.what();
    }
}

TEST(TcpAddress, IsAHostAndMayHaveAPort) {
    const auto text = [](const std::string &address) { return readTcpAddress(address, "14158").text(); };
    EXPECT_EQ(text("localhost"), "localhost:14158");
    EXPECT_EQ(text("10.0.0.7:80"), "10.0.0.7:80");
    EXPECT_EQ(text("[::1]:80"), "[::1]:80");
    EXPECT_EQ(text("[::1]"), "[::1]:14158");
    EXPECT_EQ(text("::1"), "[::1]:14158");
    for (const std::string wrong :
         {"", ":80", "a:", "a:b", "a:0", "a:65536", "a:123456", "[::1", "[::1]x:80", "[]:80"})
        EXPECT_THROW(static_cast<void>(readTcpAddress(wrong, "14158")), Error) << wrong;
}

} // namespace
} // namespace hyalite::core
