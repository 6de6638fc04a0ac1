#include "host/film/film_file.h"

#include "host/image/false_colour.h"
#include "host/image/png.h"
#include "host/image/tone_map.h"

namespace hyalite {

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

Drawing drawFilm(const Film &film, const RenderSettings &settings) {
    if (settings.integrator == Integrator::Cost)
        return drawCost(film);
    const Image image = film.toImage();
    Drawing drawing;
    drawing.width = image.width();
    drawing.height = image.height();
    drawing.rgb = toneMap(image, settings.exposureStops);
    return drawing;
}

void writeFilm(AtomicFile &file, ImageFormat format, const Film &film, Picture picture,
               const RenderSettings &settings, ToneCurve tone) {
    constexpr const char *pixelsAttribute = "pixels";
    std::vector<Attribute> &attributes = picture.attributes;
    if (format != ImageFormat::Png) {
        attributes.emplace_back(pixelsAttribute, pixelHash(picture.colour));
        writeImage(file, format, picture, settings.exposureStops, tone);
        return;
    }
    Drawing drawing;
    if (settings.integrator == Integrator::Cost) {
        drawing = drawCost(film);
    } else {
        drawing.width = picture.colour.width();
        drawing.height = picture.colour.height();
        drawing.rgb = toneMap(picture.colour, settings.exposureStops, tone);
    }
    attributes.emplace_back(pixelsAttribute, pixelHash(drawing.rgb));
    writePng(file, drawing.width, drawing.height, drawing.rgb, attributes);
}

} // namespace hyalite
