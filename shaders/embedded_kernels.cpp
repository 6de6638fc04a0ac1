#include "shaders/embedded_kernels.h"

#include "pixel_sources.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hyalite::core {

std::span<const std::uint32_t> embeddedKernel(std::string_view name) {
    const auto kernel = std::ranges::find(embeddedKernels(), name, &EmbeddedKernel::name);
    if (kernel == embeddedKernels().end())
        throw std::logic_error("no kernel is called " + std::string(name));
    return kernel->words;
}

const char *pixelSources() { return pixelSourcesHash; }

} // namespace hyalite::core
