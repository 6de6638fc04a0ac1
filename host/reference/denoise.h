// The denoiser as plain loops: the twin of the kernels in shaders/post.
#pragma once

#include "host/film/noisy_picture.h"
#include "host/image/image.h"

namespace hyalite::core::reference {

/// The picture without most of its noise. The result does not depend on the number of threads; 0: chosen by OpenMP.
[[nodiscard]] Image denoise(const NoisyPicture &picture, int threadCount = 0);

} // namespace hyalite::core::reference
