// Films of views as layers of a picture.
#include "host/jobs/layers.h"

#include <gtest/gtest.h>

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

} // namespace
} // namespace hyalite::core
