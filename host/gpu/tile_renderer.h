// One job on the device: its buffers, and the loop over its tiles.
#pragma once

#include "host/film/film.h"
#include "host/film/ray_counts.h"
#include "host/film/timeline.h"
#include "host/film/work_counts.h"
#include "host/gpu/dispatch_sizer.h"
#include "host/gpu/job.h"
#include "host/gpu/kernel.h"
#include "host/gpu/memory_plan.h"
#include "host/gpu/render_config.h"
#include "host/gpu/scene_buffers.h"
#include "host/gpu/tile.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hyalite::gpu {

/// What the tiles of a job came to.
struct TileTotals {
    RayCounts rays;
    WorkCounts work;    ///< all 0 unless counting was asked for
    LaneCounts lanes{}; ///< likewise
    std::uint64_t dispatchCount = 0;
    bool isStopped = false; ///< as was asked for after the last dispatch
};

/// Everything that a job needs on the device. Scene and buffers must outlive it.
///
/// Where dispatches end with whole samples in the film, as on lavapipe, the kernel that can be resumed inside a sample is
/// built only when a dispatch does not suffice for one: writing down where it stands costs a slot more than following a
/// few samples.
class TileRenderer {
  public:
    /// The pipeline of a job's kernel, which takes drivers as long as many samples: it can be made before there are
    /// buffers. `config` is complete, and the plans were made for it and the job. Throws as Pipeline does.
    [[nodiscard]] static Pipeline makePipeline(Device &device, const RenderConfig &config, const Job &job,
                                               const ScenePlan &scenePlan, const JobPlan &plan);

    /// As above. Throws as Buffer does.
    TileRenderer(Device &device, const SceneBuffers &buffers, const RenderConfig &config, const Job &job,
                 const ScenePlan &scenePlan, const JobPlan &plan);

    /// Puts the kernel together, with what makePipeline made or makes now. Throws as Kernel does.
    void makeKernel(Pipeline pipeline);
    void makeKernel();

    /// Runs the kernel without samples: drivers that compile at the first dispatch do it now.
    void warmUp();

    /// Runs until all samples of all tiles are in the film, or until `shouldStop`, which is asked after each dispatch,
    /// says so: the film then has what is finished. No dispatch adds more than 64 samples to a pixel, so that it is asked
    /// soon. `onProgress` gets the finished share, in [0, 1], after each dispatch, and so does `onPause` the rays so far:
    /// the film can then be read. `timeline`, where there is one, gets a record of each. Throws Error{DeviceLost}.
    [[nodiscard]] TileTotals run(const std::function<void(double)> &onProgress, Timeline *timeline = nullptr,
                                 const std::function<bool()> &shouldStop = {},
                                 const std::function<void(const RayCounts &)> &onPause = {});

    void readFilm(std::span<layout::FilmPixel> pixels) const;

    [[nodiscard]] std::vector<layout::TraceEvent> readTrace() const;

    /// Seconds that went into building kernels during `run`.
    [[nodiscard]] double lateBuildSeconds() const { return lateBuildSeconds_; }

  private:
    /// A kernel, and the memory of what waits in it.
    struct Program {
        Buffer paths;
        Buffer pending;
        Kernel kernel;
    };
    /// What one dispatch came to.
    struct Step {
        layout::DispatchProgress counters;
        RunTimes times;
        double workSeconds; ///< what it took beside the others, without what it waited for processors
    };

    /// A tile of the film whose pixels want more samples.
    struct WorkItem {
        Tile tile;
        std::uint32_t begin; ///< all samples before it are in the film
        bool isLong;         ///< a sample takes more than the steps of a slot in one dispatch
    };

    [[nodiscard]] std::size_t filmPixelCount() const;
    [[nodiscard]] std::uint32_t slotCount(const Tile &tile) const;
    /// The largest tiles, the first one last.
    [[nodiscard]] std::vector<WorkItem> cutFilm(std::uint32_t begin) const;
    /// Whether an item that wants samples up to `end` is too large for one dispatch.
    [[nodiscard]] bool mustHalve(const WorkItem &item, std::uint32_t end) const;
    void moveTo(const Tile &tile);
    [[nodiscard]] static Pipeline makePipeline(Device &device, const RenderConfig &config, const Job &job,
                                               const ScenePlan &scenePlan, const JobPlan &plan,
                                               bool isResumable);
    [[nodiscard]] Program makeProgram(Pipeline pipeline, bool isResumable);
    Kernel &resumableKernel(Timeline *timeline);
    Step runOnce(Kernel &kernel);
    /// Runs `kernel` over no samples.
    void warmUp(Kernel &kernel);
    [[nodiscard]] DispatchRecord describe(const Kernel &kernel, const Step &step, bool isResumed) const;

    Device &device_;
    const SceneBuffers &buffers_;
    RenderConfig config_;
    Job job_;
    ScenePlan scenePlan_;
    JobPlan plan_;
    Buffer film_;
    Buffer progress_;
    Buffer stacks_;
    Buffer trace_;
    layout::DispatchConstants dispatch_{};
    std::uint32_t groupCount_ = 0;
    std::uint32_t traceEventCount_ = 0;
    std::uint64_t samplesInFilm_ = 0; ///< at the beginning, of all pixels
    std::uint32_t fewestInFilm_ = 0;  ///< of any pixel
    DispatchSizer sizer_;
    double lateBuildSeconds_ = 0.0;
    std::optional<Program> direct_; ///< drops what is unfinished at its end
    std::optional<Program> resumable_;
};

} // namespace hyalite::gpu
