// One job on the device: its buffers, and the loop over its tiles.
#pragma once

#include "host/gpu/batching.h"
#include "host/gpu/kernel.h"
#include "host/gpu/scene_buffers.h"
#include "host/image/film.h"
#include "host/report/ray_counts.h"
#include "host/report/render_timing.h"

#include <functional>
#include <span>
#include <vector>

namespace hyalite::gpu {

/// What a render is asked to do.
struct Job {
    const PackedScene &scene;
    Crop crop;
    SamplerKind sampler;
    std::uint32_t sampleBegin;
    std::uint32_t sampleEnd;
    bool isTraced;
};

/// What the tiles of a job came to.
struct TileTotals {
    RayCounts rays;
    std::uint64_t dispatchCount = 0;
};

/// Everything that a job needs on the device. Scene and buffers must outlive it.
class TileRenderer {
  public:
    /// `batching` is complete. Throws as Buffer does.
    TileRenderer(Device &device, const SceneBuffers &buffers, const Batching &batching, const Job &job);

    [[nodiscard]] Kernel makeKernel(std::span<const std::uint32_t> spirv) const;

    /// Runs without samples: drivers that compile at the first dispatch do it now.
    void warmUp(Kernel &kernel);

    /// Runs until all samples of all tiles are in the film. `onProgress` gets the finished share, in [0, 1], after each
    /// dispatch. Throws Error{DeviceLost}.
    [[nodiscard]] TileTotals run(Kernel &kernel, const std::function<void(double)> &onProgress);

    void readFilm(std::span<layout::FilmPixel> pixels) const;

    [[nodiscard]] std::vector<layout::TraceEvent> readTrace() const;

  private:
    [[nodiscard]] std::size_t filmPixelCount() const;
    layout::DispatchProgress runOnce(Kernel &kernel);

    Device &device_;
    Job job_;
    int tileWidth_;
    int tileHeight_;
    std::size_t slotCount_;
    std::uint32_t stackSize_;
    const SceneBuffers &buffers_;
    Buffer film_;
    Buffer progress_;
    Buffer paths_;
    Buffer pending_;
    Buffer stacks_;
    Buffer trace_;
    layout::DispatchConstants dispatch_{};
    bool usesExactDivision_ = false;
    std::uint32_t groupCount_ = 0;
    std::uint32_t traceEventCount_ = 0;
};

} // namespace hyalite::gpu
