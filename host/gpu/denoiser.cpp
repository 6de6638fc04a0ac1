#include "host/gpu/denoiser.h"

#include "host/base/error.h"
#include "host/gpu/kernel.h"
#include "shaders/embedded_kernels.h"

#include <fmt/format.h>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

namespace hyalite::core::gpu {

namespace {

using layout::denoiserBindingCount;

constexpr std::uint32_t passGroupSize = 64;
constexpr std::size_t bytesOfTexel = 16;

constexpr std::array<const char *, denoiserBindingCount> bufferNames{
    "the noisy tile",    "the halves of the tile", "the variances of the tile", "the levels of the tile",
    "the tile's models", "the tile's estimates",   "the tile's choices",        "the denoised tile"};

std::size_t pixelsOf(int width, int height) {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

std::size_t pixelsOfLevel(int width, int height, int fit) {
    return pixelsOf(layout::levelSize(width, fit), layout::levelSize(height, fit));
}

std::size_t anchorsOf(int width, int height, int fit) {
    return pixelsOf(layout::anchorCount(layout::levelSize(width, fit)),
                    layout::anchorCount(layout::levelSize(height, fit)));
}

struct Pass {
    const char *kernel;
    int fit = layout::fitWide; ///< whose level has all pixels of the tile
    std::size_t (*invocations)(int width, int height, int fit) = pixelsOfLevel; ///< of a tile of this size
};

/// In their order.
constexpr std::array passes{Pass{"denoiserSplit"},
                            Pass{"denoiserVariance"},
                            Pass{"denoiserGuides"},
                            Pass{"denoiserCoarse", layout::fitCoarse},
                            Pass{"denoiserFit", layout::fitWide, anchorsOf},
                            Pass{"denoiserFit", layout::fitNarrow, anchorsOf},
                            Pass{"denoiserFit", layout::fitCoarse, anchorsOf},
                            Pass{"denoiserEstimate"},
                            Pass{"denoiserChoice"},
                            Pass{"denoiserCounts"},
                            Pass{"denoiserBlend"}};

/// In the buffer at each binding, of a tile of this size.
std::array<std::size_t, denoiserBindingCount> texelsOf(int width, int height) {
    const std::size_t pixels = pixelsOf(width, height);
    std::size_t anchors = 0;
    for (int fit = 0; fit < layout::fitCount; ++fit)
        anchors += anchorsOf(width, height, fit);
    return {pixels * layout::noisyRows,
            pixels * layout::splitRows,
            pixels,
            (pixels + pixelsOfLevel(width, height, layout::fitCoarse)) * layout::levelRows,
            anchors * 2 * layout::modelRows,
            pixels * layout::estimateCount,
            pixels,
            pixels};
}

/// Side of a tile's own pixels, whose texels the device can address.
int tileSideFor(const DeviceInfo &device) {
    if (device.maxStorageImagesPerStage < denoiserBindingCount)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("{} allows {} storage texel buffers and images in a kernel, and the denoiser "
                                "needs {}",
                                device.name, device.maxStorageImagesPerStage, denoiserBindingCount),
                    Remedy::ReferenceInstead);
    int side = denoiserTileSide; // Vulkan guarantees 24
    const auto isTooLarge = [&](int own) {
        const int whole = own + 2 * layout::denoiserMargin;
        return std::ranges::max(texelsOf(whole, whole)) > device.maxTexelBufferElements;
    };
    while (side > layout::tileAlignment && isTooLarge(side))
        side -= layout::tileAlignment;
    return side;
}

class TileDenoiser {
  public:
    /// Of tiles up to this size.
    TileDenoiser(Device &device, PipelineCache &pipelines, bool isDivisionExact, int width, int height) {
        const std::array<std::size_t, denoiserBindingCount> texels = texelsOf(width, height);
        for (std::size_t i = 0; i < denoiserBindingCount; ++i)
            buffers_.emplace_back(device, bufferNames[i], BufferUse::Texels, texels[i] * bytesOfTexel);
        std::vector<const Buffer *> bound;
        for (const Buffer &buffer : buffers_)
            bound.push_back(&buffer);
        const std::vector<BufferUse> uses(buffers_.size(), BufferUse::Texels);
        SpecializationConstants constants{};
        constants[layout::constantWorkgroupSize] = passGroupSize;
        constants[layout::constantExactDivision] = isDivisionExact;
        for (const Pass &pass : passes)
            kernels_.try_emplace(
                pass.kernel, device,
                pipelines.get(device, pass.kernel, embeddedKernel(pass.kernel), constants, uses), bound);
    }

    [[nodiscard]] std::vector<glm::vec3> denoised(const NoisyPicture &tile) {
        buffers_[layout::bindingNoisy].upload(std::as_bytes(std::span(tile.pixels)));
        layout::DispatchConstants dispatch{};
        dispatch.tileWidth = static_cast<std::uint32_t>(tile.width);
        dispatch.tileHeight = static_cast<std::uint32_t>(tile.height);
        for (const Pass &pass : passes) {
            dispatch.fit = static_cast<std::uint32_t>(pass.fit);
            const std::size_t invocations = pass.invocations(tile.width, tile.height, pass.fit);
            const std::size_t groups = (invocations + passGroupSize - 1) / passGroupSize;
            kernels_.at(pass.kernel).run(dispatch, static_cast<std::uint32_t>(groups));
        }
        std::vector<glm::vec4> texels(tile.pixels.size());
        buffers_[layout::bindingDenoised].download(std::as_writable_bytes(std::span(texels)));
        return {texels.begin(), texels.end()};
    }

  private:
    std::vector<Buffer> buffers_;
    std::map<std::string_view, Kernel> kernels_; ///< by name
};

} // namespace

Image denoise(Device &device, PipelineCache &pipelines, bool isDivisionExact, const NoisyPicture &picture) {
    const int side = tileSideFor(device.info());
    const auto most = [side](int size) { return std::min(size, side + 2 * layout::denoiserMargin); };
    TileDenoiser tiles(device, pipelines, isDivisionExact, most(picture.width), most(picture.height));
    return denoisedByTiles(picture, side, [&](const NoisyPicture &tile) { return tiles.denoised(tile); });
}

} // namespace hyalite::core::gpu
