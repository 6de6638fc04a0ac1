// The noisiest pixels: where a picture has them, and the paths that are told of them.
#include "host/jobs/noisiest_pixels.h"

#include "host/engine/open_backends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <span>
#include <string>

namespace hyalite::core {
namespace {

PreparedScene prepareAt64x48(const std::string &name, Integrator integrator) {
    SceneOptions options;
    options.scene = name;
    options.width = 64;
    options.height = 48;
    options.settings.push_back({[=](RenderSettings &settings) {
        settings.integrator = integrator;
        settings.samplesPerPixel = 16;
    }});
    return prepareScene(options, Source::Dropped, nobody());
}

std::vector<NoisyPixelReport> noisiestOf(const PreparedScene &scene) {
    const Film film =
        openBackend("cpu", nobody())->render(scene.packed, scene.loaded.settings, Film(scene.crop)).film;
    return noisiestPixels(scene, film, std::span(&scene.crop, 1));
}

TEST(NoisiestPixels, AreFarApartAndTellTheirBrightestPath) {
    const PreparedScene scene = prepareAt64x48("caustics", Integrator::Path);
    const std::vector<NoisyPixelReport> pixels = noisiestOf(scene);
    ASSERT_EQ(pixels.size(), 8u);
    EXPECT_TRUE(std::ranges::is_sorted(pixels, std::greater(), &NoisyPixelReport::noise));
    std::string paths;
    for (const NoisyPixelReport &pixel : pixels) {
        EXPECT_LT(pixel.sample, 16u);
        EXPECT_GT(pixel.share, 1.0 / 16.0) << "the brightest is brighter than the mean";
        EXPECT_LE(pixel.share, 1.0001);
        ASSERT_FALSE(pixel.path.empty());
        EXPECT_TRUE(pixel.path.back().ends_with(", lit") ||
                    pixel.path.back().ends_with(", whose own light it is"))
            << pixel.path.back();
        for (const std::string &step : pixel.path)
            paths += step + "; ";
        for (const NoisyPixelReport &other : pixels)
            if (&other != &pixel) {
                EXPECT_GE(std::max(std::abs(pixel.x - other.x), std::abs(pixel.y - other.y)), 8);
            }
    }
    // Light that comes to the floor through a glass ball.
    EXPECT_NE(paths.find("scattered; "), std::string::npos) << paths;
    EXPECT_NE(paths.find("through or off glass; "), std::string::npos) << paths;
}

TEST(NoisiestPixels, AreThoseOfPaths) {
    EXPECT_TRUE(noisiestOf(prepareAt64x48("spheres", Integrator::Whitted)).empty());
}

TEST(NoisiestPixels, OfABlackPictureAreNone) {
    const PreparedScene scene = prepareAt64x48("cornell", Integrator::Path);
    Film film(scene.crop);
    EXPECT_TRUE(noisiestPixels(scene, film, std::span(&scene.crop, 1)).empty());
    for (layout::FilmPixel &pixel : film.pixels)
        pixel.sampleCount = 16;
    EXPECT_TRUE(noisiestPixels(scene, film, std::span(&scene.crop, 1)).empty());
}

} // namespace
} // namespace hyalite::core
