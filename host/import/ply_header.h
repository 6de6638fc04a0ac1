// PLY headers: which elements and properties a file has, and how their values are written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

enum class PlyType : std::uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

[[nodiscard]] constexpr std::size_t sizeOf(PlyType type) {
    constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

[[nodiscard]] constexpr bool isWhole(PlyType type) { return type < PlyType::Float32; }

struct PlyProperty {
    std::string name;
    PlyType type{}; ///< of the value, or of each value of a list
    bool isList = false;
    PlyType countType{}; ///< of a list: of the number before it
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

enum class PlyFormat { Text, LittleEndian, BigEndian };

struct PlyHeader {
    PlyFormat format{};
    std::vector<PlyElement> elements; ///< in the order of the file; names are distinct
    /// Of the comments `TextureFile NAME`, as MeshLab and scanners write them.
    std::vector<std::string> textureFiles;
    std::size_t bodyOffset = 0; ///< of the first value, in bytes
    std::size_t bodyLine = 0;   ///< the line of the first value, from 1
};

/// Reads the header of a PLY file after G. Turk, "The PLY Polygon File Format" (1994), whose lines end in LF, CR or
/// CRLF, after a byte order mark or not. Other comments, obj_info and unknown lines are passed over. Throws
/// Error{BadInput} "FILE:LINE: ..." for what is wrong.
[[nodiscard]] PlyHeader readPlyHeader(std::span<const char> file, const std::string &fileName);

} // namespace hyalite::core
