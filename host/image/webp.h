// WebP files, through libwebp.
#pragma once

#include "host/base/input_file.h"
#include "host/image/texture.h"

#include <cstddef>
#include <span>

namespace hyalite::core {

/// Whether the first bytes of a file are those of a WebP.
[[nodiscard]] bool isWebp(std::span<const std::byte> head);

/// Reads still pictures, lossy and lossless, as 8-bit levels, with their alpha channel if they have one. Colour
/// profiles are ignored. Throws Error{BadInput} for damaged files and animations; Error{LimitExceeded} for files that
/// would take more memory than readingBytesMax.
[[nodiscard]] Texture readWebp(const InputFile &file);

} // namespace hyalite::core
