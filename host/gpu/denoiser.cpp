#include "host/gpu/denoiser.h"

#include "host/base/error.h"
#include "host/gpu/kernel.h"
#include "shaders/embedded_kernels.h"

#include <fmt/format.h>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace hyalite::core::gpu {

namespace {

using layout::denoiserBindingCount;

constexpr std::uint32_t passGroupSize = 64;
constexpr std::size_t bytesOfTexel = 16;
constexpr int tileMargin = static_cast<int>(layout::denoiserMargin);

/// Texels of a pixel in the buffer at each binding.
constexpr std::array<std::size_t, denoiserBindingCount> rowsAt{
    layout::noisyRows, layout::splitRows, 1, layout::guideRows, layout::estimateCount, 1, 1};
constexpr std::array<const char *, denoiserBindingCount> bufferNames{
    "the noisy tile",       "the halves of the tile", "the variances of the tile", "the guides of the tile",
    "the tile's estimates", "the tile's choices",     "the denoised tile"};
constexpr std::array<const char *, 6> passNames{"denoiserSplit",      "denoiserVariance", "denoiserGuides",
                                                "denoiserRegression", "denoiserChoice",   "denoiserBlend"};

/// Side of a tile's own pixels, whose texels the device can address.
int tileSideFor(const DeviceInfo &device) {
    if (device.maxStorageImagesPerStage < denoiserBindingCount)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("{} allows {} storage texel buffers and images in a kernel, and the denoiser "
                                "needs {}",
                                device.name, device.maxStorageImagesPerStage, denoiserBindingCount),
                    Remedy::ReferenceInstead);
    const auto most = static_cast<int>(std::sqrt(static_cast<double>(device.maxTexelBufferElements) /
                                                 static_cast<double>(std::ranges::max(rowsAt))));
    return std::min(denoiserTileSide, most - 2 * tileMargin); // Vulkan guarantees 114 - 2 margins
}

class TileDenoiser {
  public:
    TileDenoiser(Device &device, PipelineCache &pipelines, bool isDivisionExact, std::size_t pixelCount) {
        for (std::size_t i = 0; i < denoiserBindingCount; ++i)
            buffers_.emplace_back(device, bufferNames[i], BufferUse::Texels,
                                  pixelCount * rowsAt[i] * bytesOfTexel);
        std::vector<const Buffer *> bound;
        for (const Buffer &buffer : buffers_)
            bound.push_back(&buffer);
        const std::vector<BufferUse> uses(buffers_.size(), BufferUse::Texels);
        SpecializationConstants constants{};
        constants[layout::constantWorkgroupSize] = passGroupSize;
        constants[layout::constantExactDivision] = isDivisionExact;
        for (const char *pass : passNames)
            kernels_.emplace_back(device, pipelines.get(device, pass, embeddedKernel(pass), constants, uses),
                                  bound);
    }

    [[nodiscard]] std::vector<glm::vec3> denoised(const NoisyPicture &tile) {
        buffers_[layout::bindingNoisy].upload(std::as_bytes(std::span(tile.pixels)));
        layout::DispatchConstants dispatch{};
        dispatch.tileWidth = static_cast<std::uint32_t>(tile.width);
        dispatch.tileHeight = static_cast<std::uint32_t>(tile.height);
        const auto pixelCount = static_cast<std::uint32_t>(tile.pixels.size());
        for (Kernel &kernel : kernels_)
            kernel.run(dispatch, (pixelCount + passGroupSize - 1) / passGroupSize);
        std::vector<glm::vec4> texels(pixelCount);
        buffers_[layout::bindingDenoised].download(std::as_writable_bytes(std::span(texels)));
        return {texels.begin(), texels.end()};
    }

  private:
    std::vector<Buffer> buffers_;
    std::vector<Kernel> kernels_;
};

} // namespace

Image denoise(Device &device, PipelineCache &pipelines, bool isDivisionExact, const NoisyPicture &picture) {
    const int side = tileSideFor(device.info());
    const auto most = [side](int size) {
        return static_cast<std::size_t>(std::min(size, side + 2 * tileMargin));
    };
    TileDenoiser tiles(device, pipelines, isDivisionExact, most(picture.width) * most(picture.height));
    return denoisedByTiles(picture, side, [&](const NoisyPicture &tile) { return tiles.denoised(tile); });
}

} // namespace hyalite::core::gpu
