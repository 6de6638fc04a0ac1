// Environment images: panoramas of any format that is read, made fit for light.
#pragma once

#include "host/image/image.h"

#include <filesystem>
#include <string>
#include <vector>

namespace hyalite::core {

struct EnvironmentImage {
    Image radiance; ///< finite, >= 0
    std::vector<std::string> warnings;
};

/// Reads a Radiance, OpenEXR or PFM image as linear radiance, or a PNG or JPEG, whose numbers are decoded from sRGB to
/// [0, 1]. Negative numbers and NaN become 0; infinite ones, as half floats have beyond their range, become 65504, the
/// largest half float, or the largest finite number of the image if that is more. Warnings say how many. Throws as
/// readImage and readTexture do.
[[nodiscard]] EnvironmentImage readEnvironmentImage(const std::filesystem::path &file);

/// The same of linear radiance that is in memory; `name` is for warnings.
[[nodiscard]] EnvironmentImage environmentImageOf(Image radiance, const std::string &name);

} // namespace hyalite::core
