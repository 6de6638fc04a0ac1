// The denoiser as plain loops: the twin of the kernels in shaders/post.
#pragma once

#include "host/film/noisy_picture.h"
#include "host/image/image.h"

#include <string_view>

namespace hyalite::core::reference {

/// Of the result: another version gives other colours. Pictures say it.
inline constexpr std::string_view denoiserName = "hyalite denoiser 3";

/// The picture without most of its noise. The result depends neither on the number of threads, of which OpenMP chooses 0,
/// nor on the side of tiles.
[[nodiscard]] Image denoise(const NoisyPicture &picture, int threadCount = 0,
                            int tileSide = denoiserTileSide);

} // namespace hyalite::core::reference
