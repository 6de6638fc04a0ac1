// Films of views as layers of a picture.
#include "host/jobs/layers.h"

#include "host/engine/open_backends.h"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

namespace hyalite::core {
namespace {

ViewFilm filmOf(Integrator view, const glm::vec3 &sum, std::uint32_t sampleCount) {
    ViewFilm of{view, Film({0, 2, 0, 1})};
    of.film.pixels[0].sum = sum;
    of.film.pixels[0].sampleCount = sampleCount;
    return of;
}

std::vector<float> rowOf(const Layer &layer, std::size_t valueCount) {
    std::vector<float> row(valueCount);
    layer.fillRow(0, row);
    return row;
}

TEST(Layers, AreMeansAndNothingWhereThereIsNothing) {
    const std::vector<ViewFilm> films{filmOf(Integrator::Albedo, {1.0f, 2.0f, 4.0f}, 4),
                                      filmOf(Integrator::Depth, {7.0f, 7.0f, 7.0f}, 1)};
    const std::vector<Layer> layers = viewLayers(films);
    ASSERT_EQ(layers.size(), 2u);
    EXPECT_EQ(layers[0].name, "albedo");
    EXPECT_EQ(layers[0].channels, "RGB");
    EXPECT_EQ(rowOf(layers[0], 6), (std::vector{0.25f, 0.5f, 1.0f, 0.0f, 0.0f, 0.0f}));
    EXPECT_EQ(layers[1].name, "Z");
    EXPECT_EQ(layers[1].channels, "");
    EXPECT_EQ(rowOf(layers[1], 2), (std::vector{7.0f, 0.0f}));
}

// The view shows normals as colours; the layer has them back.
TEST(Layers, NormalsAreSigned) {
    const std::vector<ViewFilm> films{filmOf(Integrator::Normal, {0.0f, 0.5f, 0.5f}, 1)};
    const std::vector<Layer> layers = viewLayers(films);
    EXPECT_EQ(layers[0].channels, "XYZ");
    EXPECT_EQ(rowOf(layers[0], 6), (std::vector{-1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f}));
}

// One render finds what three would.
TEST(Layers, OfTheDenoiserAreThoseOfEachView) {
    SceneOptions options;
    options.scene = "spheres";
    options.width = options.height = 24;
    const PreparedScene scene = prepareScene(options, Source::Dropped, nobody());
    const auto backend = openBackend("cpu", nobody());
    std::vector<PictureView> views;
    for (const Integrator view : denoiserViews)
        views.push_back({view, true});
    const std::vector<ViewFilm> together =
        renderViews(*backend, scene, views, {}, {}, nobody(), TimeLimit(std::nullopt));
    ASSERT_EQ(together.size(), views.size());
    for (std::size_t i = 0; i < views.size(); ++i) {
        const std::vector<ViewFilm> alone =
            renderViews(*backend, scene, std::span(&views[i], 1), {}, {}, nobody(), TimeLimit(std::nullopt));
        EXPECT_EQ(together[i].view, views[i].view);
        EXPECT_TRUE(together[i].isOfDenoiser);
        for (std::size_t pixel = 0; pixel < together[i].film.pixels.size(); ++pixel) {
            const layout::FilmPixel &a = together[i].film.pixels[pixel];
            const layout::FilmPixel &b = alone[0].film.pixels[pixel];
            ASSERT_EQ(a.sum, b.sum) << i << ' ' << pixel;
            ASSERT_EQ(a.sumRest, b.sumRest) << i << ' ' << pixel;
            ASSERT_EQ(a.sampleCount, b.sampleCount) << i << ' ' << pixel;
        }
    }
}

// A blurred background: the layer that looks through has the samples of the picture, the denoiser's albedo its own.
TEST(Layers, OfTheDenoiserHaveNoNoiseInCommonWithOthers) {
    constexpr int side = 48;
    const auto albedoOf = [&](bool isOfDenoiser, std::uint32_t seed, int samplesPerPixel) {
        SceneOptions options;
        options.scene = "depth-of-field";
        options.width = options.height = side;
        options.settings.push_back({[=](RenderSettings &settings) {
            settings.samplesPerPixel = samplesPerPixel;
            settings.seed = seed;
            settings.areLayersThrough = true;
        }});
        const PreparedScene scene = prepareScene(options, Source::Dropped, nobody());
        const PictureView view{Integrator::Albedo, isOfDenoiser};
        return renderViews(*openBackend("cpu", nobody()), scene, std::span(&view, 1),
                           std::span(&scene.crop, 1), {}, nobody(), TimeLimit(std::nullopt))[0]
            .film.toImage();
    };
    const Image truth = albedoOf(false, 7, 1024);
    const Image layer = albedoOf(false, 0, 8);
    const Image data = albedoOf(true, 0, 16);
    double ofLayer = 0.0;
    double ofData = 0.0;
    double ofBoth = 0.0;
    for (std::size_t i = 0; i < truth.pixels().size(); ++i) {
        const double a = double{layer.pixels()[i].x} - double{truth.pixels()[i].x};
        const double b = double{data.pixels()[i].x} - double{truth.pixels()[i].x};
        ofLayer += a * a;
        ofData += b * b;
        ofBoth += a * b;
    }
    EXPECT_NEAR(ofData / ofLayer, 1.0, 0.2);
    EXPECT_NEAR(ofBoth / std::sqrt(ofLayer * ofData), 0.0, 0.1); // 0.02 by chance
}

} // namespace
} // namespace hyalite::core
