// The picture file of a rendered film.
#pragma once

#include "host/image/bitmap_text.h"
#include "host/image/image_file.h"
#include "host/jobs/layers.h"

#include <glm/vec4.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {

/// A film, and what its file has beside its pixels. All that it refers to must outlive it.
struct FilmPicture {
    const Film &film;
    const std::vector<ViewFilm> &views;
    int wholeWidth = 0; ///< of the image that the film's crop is part of
    int wholeHeight = 0;
    std::vector<Attribute> attributes{};
    RenderSettings settings{};
    FileOptions options{};
    std::optional<Projection> projection{}; ///< of the camera
    std::span<const glm::vec4> motion{}; ///< of the film's pixels: their motion vectors; empty: no such layer
    const Image *clean =
        nullptr; ///< the denoised colours, instead of the film's, of which `attributes` tell; or null
};

/// The attribute of a denoised picture, and the name of the layer of its noisy colours.
inline constexpr const char *denoisedAttribute = "denoised";
inline constexpr std::string_view noisyLayerName = "noisy";

/// `noisy` must outlive it.
[[nodiscard]] Layer noisyLayer(const Image &noisy);

/// The levels of its PNG.
[[nodiscard]] Drawing drawFilmPicture(const FilmPicture &picture);

/// What a picture of that format and name lacks of the film, a sentence each.
[[nodiscard]] std::vector<std::string> lossesOf(const FilmPicture &picture, ImageFormat format,
                                                const std::string &name);

/// Writes it with its views and the layers of the film; the caller commits the file. Returns and throws as writeImage()
/// does.
std::vector<std::string> writeFilmPicture(AtomicFile &file, ImageFormat format, const FilmPicture &picture);

} // namespace hyalite::core
