// The structure of a PNG file (ISO/IEC 15948): its header and its chunks, checked before stb_image sees a byte.
//
// stb_image accepts damaged checksums, missing ends and trailing bytes, and decompresses without a limit. Here
// everything is checked, memory is bounded by the header, and only the chunks of the picture are passed on.
#pragma once

#include "host/base/input_file.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace hyalite {

struct PngChunks {
    int width = 0;
    int height = 0;
    int bitDepth = 0;               ///< 1, 2, 4, 8 or 16 a channel (or palette index)
    std::uint64_t rowDataBytes = 0; ///< size of the decompressed data: the rows with their filter bytes
    std::vector<std::byte> minimal; ///< a PNG file of IHDR, PLTE (padded to 256 entries), one IDAT and IEND
    std::size_t compressedOffset = 0;
    std::size_t compressedBytes = 0;

    /// The zlib stream of the pixels, a part of `minimal`.
    [[nodiscard]] std::span<const std::byte> compressed() const {
        return std::span(minimal).subspan(compressedOffset, compressedBytes);
    }
};

/// Appends a chunk with its length and its checksum. `type` has four letters.
void appendChunk(std::vector<std::byte> &file, std::string_view type, std::span<const std::byte> data);

/// Throws Error{BadInput}, or Error{LimitExceeded} if the pixels are compressed so densely that they would take more
/// memory than readingBytesMax.
[[nodiscard]] PngChunks readPngChunks(const InputFile &file);

} // namespace hyalite
