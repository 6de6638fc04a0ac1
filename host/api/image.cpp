#include "hyalite/image.h"

#include "host/api/contents.h"
#include "host/base/json_text.h"
#include "host/base/standard_stream.h"
#include "host/film/film_file.h"
#include "host/image/png.h"
#include "host/jobs/film_picture.h"
#include "host/jobs/projection.h"
#include "host/reference/denoise.h"
#include "host/report/render_report.h"
#include "host/scene/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace hyalite {

namespace {

core::ToneCurve toneOf(const std::string &name) {
    return core::chosenFrom(core::toneCurveNames, name, "tone");
}

bool isDenoised(const Image::Content &content) { return !content.noisy.pixels().empty(); }

/// The values of a layer of the film, by this name.
void addLayer(const core::Layer &layer, const std::string &name, std::string_view channels,
              Image::Content &content) {
    const core::Crop &crop = content.film.crop;
    const auto width = static_cast<std::size_t>(crop.width()) * channels.size();
    std::vector<float> &values = content.layerValues.emplace_back(crop.pixelCount() * channels.size());
    for (int y = 0; y < crop.height(); ++y)
        layer.fillRow(y, std::span(values).subspan(static_cast<std::size_t>(y) * width, width));
    content.layers.push_back({name, std::string(channels), values});
}

/// The layers of light and of the denoiser, and those of the views. Names of these are that of the view's row, or those of
/// the layers of a Cryptomatte.
void addLayers(Image::Content &content) {
    for (const core::Layer &layer : core::lightLayers(content.film))
        addLayer(layer, layer.name, layer.channels, content);
    if (isDenoised(content)) {
        const core::Layer noisy = core::noisyLayer(content.noisy);
        addLayer(noisy, noisy.name, noisy.channels, content);
    }
    if (core::haveDenoiserViews(content.views))
        for (const core::Layer &layer : core::firstSampleLayers(content.film))
            addLayer(layer, layer.name, layer.channels, content);
    for (const core::ViewFilm &view : content.views) {
        const core::IntegratorRow &row = core::rowOf(view.view);
        for (const core::Layer &layer : core::layersOf(view))
            if (view.isOfDenoiser)
                addLayer(layer, layer.name, layer.channels, content);
            else
                addLayer(layer, row.tallies() ? layer.name : std::string(row.name), row.layerChannels,
                         content);
    }
}

void makeFigures(const Image::Content &content) {
    std::call_once(content.areFiguresMade, [&] {
        content.variance.reserve(3 * content.film.pixels.size());
        content.samples.reserve(content.film.pixels.size());
        for (const core::layout::FilmPixel &pixel : content.film.pixels) {
            const glm::dvec3 variance = core::varianceOfMean(pixel);
            for (glm::length_t channel = 0; channel < 3; ++channel)
                content.variance.push_back(static_cast<float>(variance[channel]));
            content.samples.push_back(pixel.sampleCount);
        }
    });
}

/// Streams belong to the program; a NUL would cut the name.
void requireName(const std::string &path) {
    if (core::isStandardStream(path) || path.find('\0') != std::string::npos)
        throw Error(ErrorKind::Usage,
                    fmt::format("image: {}", core::refusalText(path, "the name of a file")));
}

bool isRendered(const Image::Content &content) { return !content.film.pixels.empty(); }

core::FileOptions fileOptionsOf(const SaveOptions &options) {
    return {toneOf(options.tone),
            {options.half, core::chosenFrom(core::exrCompressionNames, options.compression, "compression")}};
}

core::Picture pictureOf(const Image::Content &content) {
    core::Picture picture(content.image);
    picture.alpha = content.alpha;
    return picture;
}

/// The picture in a PNG.
core::Drawing drawingOf(const Image::Content &content, core::ToneCurve tone) {
    if (isRendered(content) && content.settings.integrator == core::Integrator::Cost)
        return core::drawCost(content.film);
    core::Drawing drawing;
    drawing.width = content.image.width();
    drawing.height = content.image.height();
    drawing.rgb = content.encoding == core::Encoding::Display
                      ? core::pngLevels(content.image, content.alpha)
                      : core::pngLevels(pictureOf(content), content.settings.exposureStops, tone);
    return drawing;
}

std::vector<std::byte> pngOf(const Image::Content &content, core::ToneCurve tone) {
    const core::Drawing drawing = drawingOf(content, tone);
    std::vector<core::Attribute> attributes = core::attributesOf(content.provenance);
    attributes.emplace_back(core::pixelsAttribute, core::pixelHash(drawing.rgb));
    return core::encodePng(drawing.width, drawing.height, drawing.rgb, attributes);
}

std::vector<std::string> write(core::AtomicFile &file, core::ImageFormat format,
                               const Image::Content &content, const core::FileOptions &options) {
    if (isRendered(content)) {
        core::FilmPicture picture{.film = content.film, .views = content.views};
        picture.wholeWidth = content.wholeWidth;
        picture.wholeHeight = content.wholeHeight;
        picture.attributes = core::attributesOf(content.provenance);
        picture.settings = content.settings;
        picture.options = options;
        picture.projection = content.projection;
        if (isDenoised(content))
            picture.clean = &content.image;
        return core::writeFilmPicture(file, format, picture);
    }
    if (format == core::ImageFormat::Png) {
        file.write(pngOf(content, options.tone));
        return {};
    }
    if (content.encoding == core::Encoding::Display)
        throw Error(ErrorKind::Usage, fmt::format("save {}: found the numbers of a PNG; allowed: a .png file",
                                                  file.path().string()));
    return core::writeImage(file, format, pictureOf(content), 0.0, options);
}

} // namespace

Image imageOf(const core::PreparedScene &scene, const core::RendererIdentity &renderer,
              core::BackendResult &&result, std::vector<core::ViewFilm> &&views,
              std::optional<core::Image> &&clean) {
    auto content = std::make_shared<Image::Content>();
    content->settings = scene.loaded.settings;
    content->image = result.film.toImage();
    if (clean) {
        content->noisy = std::move(content->image);
        content->image = std::move(*clean);
    }
    content->film = std::move(result.film);
    content->views = std::move(views);
    content->alpha = core::alphasOf(content->film, content->views, content->settings);
    content->wholeWidth = scene.loaded.scene.camera.width;
    content->wholeHeight = scene.loaded.scene.camera.height;
    content->projection = core::projectionOf(scene.loaded.scene);
    content->rays = result.rays;
    content->seconds = result.timing.renderSeconds;
    const std::array<core::Crop, 1> whole{scene.crop};
    const core::FinishedWork finished = core::finishedWork(content->film, whole, content->settings);
    content->isFinished = finished.isComplete;
    for (const core::ViewFilm &view : content->views)
        content->isFinished =
            content->isFinished &&
            core::finishedWork(view.film, whole, core::samplesOfView(view, content->settings)).isComplete;
    content->provenance = core::provenanceToJson(core::provenanceOf(scene, "(by a program)"), renderer);
    if (finished.noise)
        content->provenance["noise"] = core::noiseToJson(*finished.noise, content->settings.noise);
    if (isDenoised(*content))
        content->provenance[core::denoisedAttribute] = core::reference::denoiserName;
    addLayers(*content);
    return Image(std::move(content));
}

Image::Image(std::shared_ptr<const Content> content) : content_(std::move(content)) {}

Image::Image(int width, int height, std::span<const float> pixels) : Image(width, height, pixels, {}) {}

Image::Image(int width, int height, std::span<const float> pixels, std::span<const float> alpha) {
    constexpr std::size_t channels = 3;
    const auto side = [](int size) { return static_cast<std::size_t>(std::max(size, 0)); };
    const std::size_t pixelCount = side(width) * side(height);
    if (pixelCount == 0 || pixels.size() != pixelCount * channels)
        throw Error(
            ErrorKind::Usage,
            fmt::format("image: found {} numbers for {} x {} pixels; allowed: 3 of each pixel, and at least "
                        "one pixel",
                        pixels.size(), width, height));
    if (!alpha.empty() && alpha.size() != pixelCount)
        throw Error(ErrorKind::Usage,
                    fmt::format("alpha: found {} numbers for {} x {} pixels; allowed: one of each",
                                alpha.size(), width, height));
    auto content = std::make_shared<Content>();
    content->image = core::Image(width, height);
    std::memcpy(content->image.pixels().data(), pixels.data(), pixels.size_bytes());
    content->alpha.assign(alpha.begin(), alpha.end());
    content_ = std::move(content);
}

Image Image::load(const std::string &path) {
    return withThreads([&] { // those of OpenEXR
        requireName(path);
        core::LoadedImage loaded = core::readImage(path);
        auto content = std::make_shared<Content>();
        content->image = std::move(loaded.image);
        content->encoding = loaded.encoding;
        content->alpha = std::move(loaded.alpha);
        return Image(std::move(content));
    });
}

int Image::width() const noexcept { return content_->image.width(); }
int Image::height() const noexcept { return content_->image.height(); }
bool Image::isDisplayEncoded() const noexcept { return content_->encoding == core::Encoding::Display; }

std::span<const float> Image::pixels() const noexcept {
    const std::vector<glm::vec3> &pixels = content_->image.pixels();
    return {&pixels.data()->x, 3 * pixels.size()};
}

std::span<const float> Image::alpha() const noexcept { return content_->alpha; }

std::span<const float> Image::variance() const {
    makeFigures(*content_);
    return content_->variance;
}

std::span<const std::uint32_t> Image::samples() const {
    makeFigures(*content_);
    return content_->samples;
}

const std::vector<Layer> &Image::layers() const noexcept { return content_->layers; }
bool Image::isFinished() const noexcept { return content_->isFinished; }
double Image::seconds() const noexcept { return content_->seconds; }

RayCounts Image::rays() const noexcept {
    const core::RayCounts &rays = content_->rays;
    return {rays.primary, rays.shadow, rays.reflection, rays.refraction, rays.bounce};
}

std::string Image::provenance() const { return core::jsonText(content_->provenance); }

void Image::save(const std::string &path, const std::string &tone) const {
    SaveOptions options;
    options.tone = tone;
    save(path, options);
}

void Image::save(const std::string &path, const SaveOptions &options) const {
    const std::vector<std::string> losses = withThreads([&] {
        requireName(path);
        const core::FileOptions ofFile = fileOptionsOf(options);
        const core::ImageFormat format = core::imageFormatOf(path);
        core::AtomicFile file(path);
        std::vector<std::string> lost = write(file, format, *content_, ofFile);
        file.commit();
        return lost;
    });
    if (options.warning)
        for (const std::string &loss : losses)
            options.warning(fmt::format("{}: {}", path, loss));
}

std::string Image::png(const std::string &tone) const {
    return guarded([&] {
        const std::vector<std::byte> bytes = pngOf(*content_, toneOf(tone));
        return std::string(reinterpret_cast<const char *>(bytes.data()), bytes.size());
    });
}

} // namespace hyalite
