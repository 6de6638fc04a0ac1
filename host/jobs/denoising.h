// Denoising: the picture of a film without most of its noise, at once or from the layers of a file.
#pragma once

#include "host/engine/backend.h"
#include "host/film/noisy_picture.h"
#include "host/film/view_film.h"
#include "host/image/exr_picture.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace hyalite::core {

/// Whether a picture with these settings is to be denoised.
[[nodiscard]] bool isToBeDenoised(const RenderSettings &settings);

/// Whether the film and its views have all data that the denoiser needs, of every pixel: a render that ended early may
/// have it of some.
[[nodiscard]] bool isDenoisable(const Film &film, const std::vector<ViewFilm> &views);

/// What the denoiser reads. The film is denoisable.
[[nodiscard]] NoisyPicture noisyPictureOf(const Film &film, const std::vector<ViewFilm> &views);

/// The same from the layers of a file, to the bit. Throws Error{BadInput} where some are missing or without values.
[[nodiscard]] NoisyPicture noisyPictureOf(const ExrPicture &picture, const std::filesystem::path &path);

/// The film's colours without most of their noise, as a task of the observer. Empty, with a warning, if the film is not
/// denoisable. Throws as Backend::denoise().
[[nodiscard]] std::optional<Image> denoised(Backend &backend, const Film &film,
                                            const std::vector<ViewFilm> &views, Observer &observer);

/// Memory of the denoiser for a picture of this size.
[[nodiscard]] std::uint64_t denoiserBytes(const Crop &crop);

/// Memory of a render with these settings beside its film and its views, for `copies` of the film.
[[nodiscard]] std::uint64_t denoisingBytes(const RenderSettings &settings, const Crop &crop, unsigned copies);

} // namespace hyalite::core
