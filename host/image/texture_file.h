// Texture files: formats and reading.
#pragma once

#include "host/base/input_file.h"
#include "host/image/texture.h"

#include <filesystem>

namespace hyalite::core {

/// Whether the file's first bytes are those of a format that readTexture() reads. Throws as InputFile does.
[[nodiscard]] bool isTextureFile(const std::filesystem::path &path);

/// Reads a PNG, a JPEG or a WebP as 8-bit levels (of 16 bits the upper 8), or a Radiance file as floats, told apart by
/// their first bytes. Throws as readPng(), readJpeg(), readWebp() and readHdr() do, and Error{BadInput} for what is
/// none of these.
[[nodiscard]] Texture readTexture(const std::filesystem::path &path);
[[nodiscard]] Texture readTexture(const InputFile &file);

} // namespace hyalite::core
