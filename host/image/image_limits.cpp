#include "host/image/image_limits.h"

#include <fmt/format.h>

namespace hyalite::core {

void requireImageSize(const InputFile &file, std::int64_t width, std::int64_t height) {
    if (width < 1 || height < 1 || width > imageSideMax || height > imageSideMax ||
        static_cast<std::uint64_t>(width * height) > imagePixelCountMax)
        throw file.bad(fmt::format("its size is {} x {}; a side may have 1 to {} pixels, an image {}", width,
                                   height, imageSideMax, imagePixelCountMax));
}

void requireReadingMemory(const InputFile &file, std::uint64_t width, std::uint64_t height,
                          std::uint64_t neededBytes) {
    const std::uint64_t allowedBytes = readingBytesMax(file.sizeBytes());
    constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20;
    if (neededBytes > allowedBytes)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("{}: {} x {} pixels take {} MiB to read; a file of {} bytes may take {} MiB "
                                "(512 MiB and 64 times its size); make the image smaller, or write it as PFM",
                                file.path().string(), width, height, (neededBytes + mebibyte - 1) / mebibyte,
                                file.sizeBytes(), allowedBytes / mebibyte));
}

} // namespace hyalite::core
