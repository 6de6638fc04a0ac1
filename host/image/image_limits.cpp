#include "host/image/image_limits.h"

#include <fmt/format.h>

namespace hyalite {

void requireImageSize(const InputFile &file, std::int64_t width, std::int64_t height) {
    if (width < 1 || height < 1 || width > imageSideMax || height > imageSideMax ||
        static_cast<std::uint64_t>(width * height) > imagePixelCountMax)
        throw file.bad(fmt::format("its size is {} x {}; a side may have 1 to {} pixels, an image {}", width,
                                   height, imageSideMax, imagePixelCountMax));
}

} // namespace hyalite
