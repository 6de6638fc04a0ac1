#include "host/film/film_file.h"

#include "host/image/exr.h"
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

Drawing drawFilm(const Film &film, const RenderSettings &settings, ToneCurve tone) {
    return drawFilm(film, film.toImage(), settings, tone);
}

Drawing drawFilm(const Film &film, const Image &colours, const RenderSettings &settings, ToneCurve tone) {
    return drawPicture(film, colours, settings, tone);
}

Drawing drawPicture(const Film &film, const Picture &picture, const RenderSettings &settings,
                    ToneCurve tone) {
    if (settings.integrator == Integrator::Cost)
        return drawCost(film);
    Drawing drawing;
    drawing.width = picture.colour.width();
    drawing.height = picture.colour.height();
    drawing.rgb = pngLevels(picture, settings.exposureStops, tone);
    return drawing;
}

std::vector<std::string> writeFilm(AtomicFile &file, ImageFormat format, const Film &film, Picture picture,
                                   const RenderSettings &settings, const FileOptions &options) {
    if (format != ImageFormat::Png) {
        if (format == ImageFormat::Exr)
            picture.attributes.emplace_back(pixelsAttribute, exrPixelHash(picture, options.exr));
        return writeImage(file, format, picture, settings.exposureStops, options);
    }
    const Drawing drawing = drawPicture(film, picture, settings, options.tone);
    picture.attributes.emplace_back(pixelsAttribute, pixelHash(drawing.rgb));
    writePng(file, drawing.width, drawing.height, drawing.rgb, picture.attributes);
    return {};
}

} // namespace hyalite::core
