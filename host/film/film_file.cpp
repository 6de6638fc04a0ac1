#include "host/film/film_file.h"

#include "host/image/false_colour.h"
#include "host/image/png.h"
#include "host/image/tone_map.h"

namespace hyalite::core {

std::vector<float> testsPerSample(const Film &cost) {
    const Image means = cost.toImage();
    std::vector<float> tests;
    tests.reserve(means.pixels().size());
    for (const glm::vec3 &pixel : means.pixels())
        tests.push_back(pixel.y + pixel.z);
    return tests;
}

Drawing drawCost(const Film &cost) {
    return falseColours(cost.crop.width(), cost.crop.height(), testsPerSample(cost),
                        "box and triangle tests per sample");
}

namespace {

/// `image` is that of the film.
Drawing draw(const Film &film, const Image &image, const RenderSettings &settings, ToneCurve tone) {
    if (settings.integrator == Integrator::Cost)
        return drawCost(film);
    Drawing drawing;
    drawing.width = image.width();
    drawing.height = image.height();
    drawing.rgb = toneMap(image, settings.exposureStops, tone);
    return drawing;
}

} // namespace

Drawing drawFilm(const Film &film, const RenderSettings &settings, ToneCurve tone) {
    return draw(film, film.toImage(), settings, tone);
}

void writeFilm(AtomicFile &file, ImageFormat format, const Film &film, Picture picture,
               const RenderSettings &settings, ToneCurve tone) {
    if (format == ImageFormat::Png) {
        const Drawing drawing = draw(film, picture.colour, settings, tone);
        picture.attributes.emplace_back(pixelsAttribute, pixelHash(drawing.rgb));
        writePng(file, drawing.width, drawing.height, drawing.rgb, picture.attributes);
    } else {
        picture.attributes.emplace_back(pixelsAttribute, pixelHash(picture.colour));
        writeImage(file, format, picture, settings.exposureStops, tone);
    }
}

} // namespace hyalite::core
