// A profile as one page for a browser, with everything in it: no other file, no network, no script.
#pragma once

#include "host/report/profile.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace hyalite {

/// `text` with what HTML would read anything into replaced, in elements and in quoted attributes alike.
[[nodiscard]] std::string htmlText(std::string_view text);

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

/// `png` is the image that was rendered, encoded, and `heatMapPng` its work, where it was counted.
[[nodiscard]] std::string profileHtml(const Profile &profile, std::span<const std::byte> png,
                                      std::span<const std::byte> heatMapPng = {});

} // namespace hyalite
