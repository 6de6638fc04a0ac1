#include "shaders/embedded_kernels.h"

#include "pixel_sources.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include <zlib.h>

namespace hyalite::core {

std::span<const std::uint32_t> KernelWords::get() const {
    static std::mutex mutex;
    static std::map<const std::uint32_t *, std::vector<std::uint32_t>> &unpacked =
        *new std::map<const std::uint32_t *, std::vector<std::uint32_t>>; // spans outlive static objects
    const std::lock_guard lock(mutex);
    std::vector<std::uint32_t> &words = unpacked[packed_.data()];
    if (words.empty()) {
        words.resize(count_);
        const auto sizeBytes = static_cast<uLong>(packed_.size_bytes());
        auto size = static_cast<uLongf>(count_ * sizeof(words[0]));
        if (uncompress(reinterpret_cast<Bytef *>(words.data()), &size,
                       reinterpret_cast<const Bytef *>(packed_.data()), sizeBytes) != Z_OK ||
            size != count_ * sizeof(words[0]))
            throw std::logic_error("a kernel cannot be unpacked");
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
