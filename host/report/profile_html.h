// Profile as an HTML page: one self-contained file, without network access or scripts.
#pragma once

#include "host/report/profile.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace hyalite {

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

/// `png` is the encoded image, and `heatMapPng` that of its work, if it was counted.
[[nodiscard]] std::string profileHtml(const Profile &profile, std::span<const std::byte> png,
                                      std::span<const std::byte> heatMapPng = {});

} // namespace hyalite
