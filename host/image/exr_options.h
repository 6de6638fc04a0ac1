// Options of OpenEXR files: how their pixels are stored.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace hyalite::core {

/// Compressions, by the names of OpenEXR. Those of no loss keep every bit.
enum class ExrCompression { None, Rle, Zips, Zip, Piz, Pxr24, B44, B44a, Dwaa, Dwab };

/// The words of options.
inline constexpr std::array<std::pair<std::string_view, ExrCompression>, 10> exrCompressionNames{
    {{"none", ExrCompression::None},
     {"rle", ExrCompression::Rle},
     {"zips", ExrCompression::Zips},
     {"zip", ExrCompression::Zip},
     {"piz", ExrCompression::Piz},
     {"pxr24", ExrCompression::Pxr24},
     {"b44", ExrCompression::B44},
     {"b44a", ExrCompression::B44a},
     {"dwaa", ExrCompression::Dwaa},
     {"dwab", ExrCompression::Dwab}}};

struct ExrOptions {
    bool isHalf = false; ///< light and alpha as 16-bit floats: 11 bits of precision, at most 65504
    ExrCompression compression = ExrCompression::Zip;

    [[nodiscard]] bool operator==(const ExrOptions &) const = default;
};

} // namespace hyalite::core
