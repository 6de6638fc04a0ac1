// Profile: the measurements of `hyalite profile`, and their summary for each stage and kernel.
#pragma once

#include "host/base/summary.h"
#include "host/film/timeline.h"
#include "host/film/work_counts.h"
#include "host/report/provenance.h"
#include "host/report/work_charges.h"
#include "host/report/work_histogram.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

/// One render of the image.
struct Frame {
    std::string label; ///< "repeat 3"
    bool isMeasured = false;
    Span span; ///< the whole call, on the host
    Timeline timeline;
    double finishedShare = 1.0; ///< of its samples; below 1: the time limit ended it
};

/// Traversal work of the measured kernel.
struct KernelWork {
    std::string kernel;
    WorkCounts work;
    LaneCounts lanes;
    bool countsNodes = true; ///< false: the tree is the device's own, and only triangles are counted
};

struct Profile {
    Provenance origin;
    RendererIdentity device;
    std::string verification; ///< result, or why there is none
    bool isVerified = false;
    std::optional<double> timeLimitSeconds;
    std::vector<std::string> leftOut;     ///< by the time limit
    std::optional<WorkCounts> work;       ///< of a frame with a stack, if requested
    std::optional<KernelWork> kernelWork; ///< of a frame of the measured kernel, if requested
    std::optional<WorkCharges> charges;   ///< of the first samples, if requested
    std::vector<WorkBin> workHistogram;   ///< of the pixels of such a frame
    std::uint64_t sceneBytes = 0;         ///< of the scene's arrays
    std::vector<StageRecord> hostStages;  ///< outside of frames: load, build, open, write
    /// In the order in which they were rendered. At least one is measured: if the time limit ends the first one, that.
    std::vector<Frame> frames;
};

/// One stage of a frame, or of the host. Times in milliseconds.
struct StageSummary {
    std::string name;
    bool isInFrame = false;
    std::size_t launchCount = 0;       ///< in a frame
    std::optional<double> firstMillis; ///< in the first frame, if that was not measured
    std::vector<double> frameMillis;   ///< its total in each measured frame
    Summary launch;                    ///< of one launch, over all measured frames
    double share = 0.0;                ///< of the measured frames' time

    /// Median total of a frame.
    [[nodiscard]] double medianFrameMillis() const { return quantile(frameMillis, 0.5); }
};

/// One kernel: a stage of its own, timed by the best available clock.
struct KernelSummary {
    StageSummary times;
    std::uint64_t invocations = 0; ///< in a frame, as the following
    RayCounts rays;

    /// Rate of `rays` over the whole time of the kernel.
    [[nodiscard]] double megaraysPerSecond(std::uint64_t rayCount) const;
};

/// In order of first occurrence; stages of the host enclose those of the frames.
[[nodiscard]] std::vector<StageSummary> summariseStages(const Profile &profile);
[[nodiscard]] std::vector<KernelSummary> summariseKernels(const Profile &profile);

/// The frame as a row. It is not a stage, but about the sum of them.
[[nodiscard]] StageSummary summariseFrame(const Profile &profile);

/// A frame with what precedes it, by stages. Times in milliseconds.
struct StartSummary {
    struct Stage {
        std::string name;
        double millis = 0.0;
    };
    double millis = 0.0; ///< of all; stages leave out what is between them
    std::vector<Stage> stages;
};

/// From nothing to the first frame: the stages of the host before the frames, and the first one that was rendered,
/// measured or not, when nothing of it was there. What drivers keep on disk may be.
[[nodiscard]] StartSummary summariseColdStart(const Profile &profile);

/// A later frame: the medians of those that are measured and not the first one. Empty if there is none.
[[nodiscard]] std::optional<StartSummary> summariseWarmFrame(const Profile &profile);

/// The finished share of the measured frames; below 1: of a single one, which the time limit ended.
[[nodiscard]] double measuredShare(const Profile &profile);

/// Milliseconds of each measured frame.
[[nodiscard]] std::vector<double> frameMillis(const Profile &profile);

/// The time of all stages in the measured frames, relative to the time of these frames.
[[nodiscard]] double stageShare(const std::vector<StageSummary> &stages);

/// Maximum size of all device buffers at the end of any stage; 0 for the reference renderer.
[[nodiscard]] std::uint64_t maxDeviceBytes(const Profile &profile);

} // namespace hyalite::core
