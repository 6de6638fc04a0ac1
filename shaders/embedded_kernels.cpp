#include "shaders/embedded_kernels.h"

#include "pixel_sources.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include <zstd.h>

namespace hyalite::core {

std::span<const std::uint32_t> KernelWords::get() const {
    static std::mutex mutex;
    static std::map<const std::uint32_t *, std::vector<std::uint32_t>> &unpacked =
        *new std::map<const std::uint32_t *, std::vector<std::uint32_t>>; // spans outlive static objects
    const std::lock_guard lock(mutex);
    std::vector<std::uint32_t> &words = unpacked[packed_.data()];
    if (words.empty()) {
        words.resize(count_);
        std::vector<std::uint8_t> planes(count_ * sizeof(words[0]));
        const std::size_t packedSize = ZSTD_findFrameCompressedSize(packed_.data(), packed_.size_bytes());
        if (ZSTD_isError(packedSize) != 0 ||
            ZSTD_decompress(planes.data(), planes.size(), packed_.data(), packedSize) != planes.size())
            throw std::logic_error("a kernel cannot be unpacked");
        auto byte = planes.cbegin();
        for (int shift = 0; shift < 32; shift += 8)
            for (std::uint32_t &word : words)
                word |= static_cast<std::uint32_t>(*byte++) << shift;
    }
    return words;
}

std::span<const std::uint32_t> embeddedKernel(std::string_view name) {
    const auto kernel = std::ranges::find(embeddedKernels(), name, &EmbeddedKernel::name);
    if (kernel == embeddedKernels().end())
        throw std::logic_error("no kernel is called " + std::string(name));
    return kernel->words;
}

const char *pixelSources() { return pixelSourcesHash; }

} // namespace hyalite::core
