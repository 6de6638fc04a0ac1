// What `hyalite profile` has measured, and what it comes to for each stage and kernel.
#pragma once

#include "host/base/summary.h"
#include "host/film/timeline.h"
#include "host/film/work_counts.h"
#include "host/report/provenance.h"
#include "host/report/work_histogram.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hyalite {

/// One render of the image.
struct Frame {
    std::string label; ///< "repeat 3"
    bool isMeasured = false;
    Span span; ///< the whole call, on the host
    Timeline timeline;
};

/// What the traversal of the measured kernel did.
struct KernelWork {
    std::string kernel;
    WorkCounts work;
    LaneCounts lanes;
};

struct Profile {
    Provenance origin;
    RendererIdentity device;
    std::string verification; ///< against what, or why not
    bool isVerified = false;
    std::optional<WorkCounts> work; ///< of a frame with a stack; nothing where nobody asked
    std::optional<KernelWork>
        kernelWork;                     ///< of a frame of the device's own kernel; nothing where nobody asked
    std::vector<WorkBin> workHistogram; ///< of the same frame
    std::uint64_t sceneBytes = 0;       ///< of the scene's arrays
    std::vector<StageRecord> hostStages; ///< outside of frames: load, build, open, write
    std::vector<Frame> frames; ///< in the order in which they were rendered; at least one is measured
};

/// One stage of a frame, or of the host. Times in milliseconds.
struct StageSummary {
    std::string name;
    bool isInFrame = false;
    std::size_t launchCount = 0;       ///< in a frame
    std::optional<double> firstMillis; ///< in the first frame, where that was not measured
    std::vector<double> frameMillis;   ///< its total in each measured frame
    Summary launch;                    ///< of one launch, over all measured frames
    double share = 0.0;                ///< of the measured frames' time

    /// The usual total of a frame.
    [[nodiscard]] double medianFrameMillis() const { return quantile(frameMillis, 0.5); }
};

/// One kernel: a stage of its own, timed by the best clock that there is.
struct KernelSummary {
    StageSummary times;
    std::uint64_t invocations = 0; ///< in a frame, as the following
    RayCounts rays;

    /// Of rays of one kind, or any number of them, by the kernel's whole time.
    [[nodiscard]] double megaraysPerSecond(std::uint64_t rayCount) const;
};

/// In the order in which they first occur, those of the host around those of the frames.
[[nodiscard]] std::vector<StageSummary> summariseStages(const Profile &profile);
[[nodiscard]] std::vector<KernelSummary> summariseKernels(const Profile &profile);

/// The frame as a row: it is no stage, but the sum of them should come to it.
[[nodiscard]] StageSummary summariseFrame(const Profile &profile);

/// Milliseconds of each measured frame.
[[nodiscard]] std::vector<double> frameMillis(const Profile &profile);

/// The time of all stages in the measured frames, as a share of those frames' time.
[[nodiscard]] double stageShare(const std::vector<StageSummary> &stages);

/// Most bytes that buffers took on the device at the end of any stage; 0 for the reference renderer, which has none.
[[nodiscard]] std::uint64_t mostDeviceBytes(const Profile &profile);

} // namespace hyalite
