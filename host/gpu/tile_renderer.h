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
#include "host/gpu/pipeline_cache.h"
#include "host/gpu/render_config.h"
#include "host/gpu/scene_buffers.h"
#include "host/gpu/tile.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hyalite::core::gpu {

/// Results of all tiles of a job.
struct TileTotals {
    RayCounts rays;
    WorkCounts work;    ///< all 0 without RenderConfig::isCounting
    LaneCounts lanes{}; ///< likewise
    std::uint64_t dispatchCount = 0;
    bool isStopped = false; ///< by shouldStop
};

/// Everything that a job needs on the device. Scene and buffers must outlive it.
///
/// On lavapipe dispatches end with whole samples in the film, because saving the state of a slot costs more than
/// following a few samples. The kernel that can resume inside a sample is built only when a dispatch is too short for
/// one.
class TileRenderer {
  public:
    /// Makes the pipeline of a job's kernel, before its buffers exist: drivers take as long to compile it as for many
    /// samples. `config` is complete, and the plans were made for it and the job. Throws as Pipeline does.
    static void makePipeline(Device &device, PipelineCache &pipelines, const RenderConfig &config,
                             const Job &job, const ScenePlan &scenePlan, const JobPlan &plan);

    /// As above. Throws as Buffer does.
    TileRenderer(Device &device, PipelineCache &pipelines, const SceneBuffers &buffers,
                 const RenderConfig &config, const Job &job, const ScenePlan &scenePlan, const JobPlan &plan,
                 const DispatchCosts &known = {});

    /// Makes the kernel. Throws as Kernel does.
    void makeKernel();

    /// Runs the kernel without samples, for drivers that compile at the first dispatch; unless it has run before.
    void warmUp();

    /// Runs until all samples of all tiles are in the film, or until `shouldStop` returns true; the film then has the
    /// finished samples. After each dispatch, which adds at most 64 samples to a pixel, `shouldStop` is asked,
    /// `onProgress` gets the finished fraction in [0, 1], `onPause` the rays so far (the film can be read then), and
    /// `timeline`, if not null, a record of the dispatch. Throws Error{DeviceLost}.
    [[nodiscard]] TileTotals run(const std::function<void(double)> &onProgress, Timeline *timeline = nullptr,
                                 const std::function<bool()> &shouldStop = {},
                                 const std::function<void(const RayCounts &)> &onPause = {});

    /// Drops all samples of a job that began without any: the next run renders them anew.
    void restart();

    /// The film on the device: of a job that began without samples, the pixels of its crop, row by row.
    [[nodiscard]] const Buffer &film() const { return film_; }

    /// The lane that computes a sample of a pixel of the whole image, where subgroups are side by side in workgroups.
    [[nodiscard]] std::uint32_t laneOf(const glm::uvec2 &pixel, std::uint32_t sampleIndex) const;

    /// Pixels that were finished before stay as they are.
    void readFilm(std::span<layout::FilmPixel> pixels, std::span<float> light) const;

    [[nodiscard]] std::vector<layout::TraceEvent> readTrace() const;

    /// Costs of dispatches, for the next job of this scene and integrator.
    [[nodiscard]] DispatchCosts costs() const { return sizer_.costs(); }

    /// Seconds spent building kernels during `run`.
    [[nodiscard]] double lateBuildSeconds() const { return lateBuildSeconds_; }

  private:
    /// A kernel, and the buffers of its unfinished paths.
    struct Program {
        Buffer paths;
        Buffer pending;
        Kernel kernel;
        std::optional<Kernel> adding; ///< of samples that the kernel has finished in turn, to the film
    };
    /// Results of one dispatch.
    struct Step {
        layout::DispatchProgress counters;
        RunTimes times;
        double workSeconds; ///< without the time spent waiting for processors
    };

    /// A tile of the film whose pixels want more samples.
    struct WorkItem {
        Tile tile;
        std::uint32_t begin; ///< samples before it are in the film
        bool isLong;         ///< a sample takes more steps than a slot has in one dispatch
    };

    /// A call of run(): its arguments, and what has come of it so far.
    struct Run {
        const std::function<void(double)> &onProgress;
        Timeline *timeline;
        const std::function<bool()> &shouldStop;
        const std::function<void(const RayCounts &)> &onPause;
        std::uint64_t samplesFinished;
        TileTotals totals;
    };

    /// Takes samples of an item, up to `end`, until they are in the film, the item is found too large, or the run is
    /// stopped. The film knows how far each pixel is, so an item can be halved at any time, except inside a long
    /// sample.
    void addSamples(WorkItem &item, std::uint32_t end, Run &run);
    /// Dispatches once, and reports it to the caller of run().
    Step dispatch(Program &program, bool isResumed, Run &run);

    [[nodiscard]] std::uint32_t slotCount(const Tile &tile) const;
    /// The film, and the positions of its pixels.
    void uploadFilm();
    /// The film in tiles of the largest size, the first one last.
    [[nodiscard]] std::vector<WorkItem> cutFilm(std::uint32_t begin) const;
    /// Whether an item with samples up to `end` is too large for one dispatch.
    [[nodiscard]] bool mustHalve(const WorkItem &item, std::uint32_t end) const;
    void moveTo(const Tile &tile);
    /// Workgroups for `count` items: a multiple of the interleave.
    [[nodiscard]] std::uint32_t groupsFor(std::uint32_t count, std::uint32_t perGroup) const;
    [[nodiscard]] Program makeProgram(bool isResumable);
    Program &resumableProgram(Timeline *timeline);
    Step runOnce(Program &program);
    /// Runs `program` over no samples.
    void warmUp(Program &program);
    [[nodiscard]] DispatchRecord describe(const Program &program, const Step &step, bool isResumed) const;

    Device &device_;
    PipelineCache &pipelines_;
    const SceneBuffers &buffers_;
    RenderConfig config_;
    Job job_;
    ScenePlan scenePlan_;
    JobPlan plan_;
    Buffer film_;
    Buffer light_;
    Buffer progress_;
    Buffer stacks_; ///< or finished samples, as the plan says
    Buffer trace_;
    layout::DispatchConstants dispatch_{};
    std::uint32_t groupCount_ = 0;             ///< of a slot for each sample in flight
    std::uint32_t regenerationGroupCount_ = 0; ///< of slots that regenerate paths
    std::uint32_t addingGroupCount_ = 0;       ///< of a slot for each pixel
    std::uint32_t traceEventCount_ = 0;
    std::uint64_t samplesInFilm_ = 0; ///< of all pixels, before run
    DispatchSizer sizer_;
    double lateBuildSeconds_ = 0.0;
    std::optional<Program> direct_; ///< drops what is unfinished at its end
    std::optional<Program> resumable_;
};

} // namespace hyalite::core::gpu
