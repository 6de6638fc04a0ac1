#include "host/report/profile.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace hyalite::core {

namespace {

struct NamedSpan {
    const std::string *name;
    Span span;
};

std::vector<NamedSpan> stageSpans(const Frame &frame) {
    std::vector<NamedSpan> spans;
    for (const StageRecord &stage : frame.timeline.stages)
        spans.push_back({&stage.name, stage.span});
    return spans;
}

std::vector<NamedSpan> kernelSpans(const Frame &frame) {
    std::vector<NamedSpan> spans;
    for (const DispatchRecord &dispatch : frame.timeline.dispatches)
        spans.push_back({&dispatch.kernel, dispatch.times.best()});
    return spans;
}

/// The summary of all spans with one name.
StageSummary summariseSpans(const Profile &profile, const std::string &name,
                            const std::function<std::vector<NamedSpan>(const Frame &)> &spansOf) {
    StageSummary summary;
    summary.name = name;
    summary.isInFrame = true;
    std::vector<double> launches;
    double frameTotal = 0.0;
    for (const Frame &frame : profile.frames) {
        const bool isFirst = &frame == &profile.frames.front() && !frame.isMeasured;
        if (!frame.isMeasured && !isFirst)
            continue;
        std::vector<double> ofFrame;
        for (const NamedSpan &named : spansOf(frame))
            if (*named.name == name)
                ofFrame.push_back(named.span.millis());
        const double total = std::accumulate(ofFrame.begin(), ofFrame.end(), 0.0);
        if (isFirst) {
            summary.firstMillis = total;
            continue;
        }
        summary.launchCount = ofFrame.size();
        summary.frameMillis.push_back(total);
        launches.insert(launches.end(), ofFrame.begin(), ofFrame.end());
        frameTotal += frame.span.millis();
    }
    summary.launch = summarise(launches);
    summary.share = frameTotal > 0.0 ? summary.launch.total / frameTotal : 0.0;
    return summary;
}

/// Names in the order in which they first occur.
std::vector<std::string> namesIn(const Profile &profile,
                                 const std::function<std::vector<NamedSpan>(const Frame &)> &spansOf) {
    std::vector<std::string> names;
    for (const Frame &frame : profile.frames)
        for (const NamedSpan &named : spansOf(frame))
            if (std::find(names.begin(), names.end(), *named.name) == names.end())
                names.push_back(*named.name);
    return names;
}

StageSummary summariseHostStage(const StageRecord &stage) {
    StageSummary summary;
    summary.name = stage.name;
    summary.launchCount = 1;
    summary.frameMillis = {stage.span.millis()};
    summary.launch = summarise(summary.frameMillis);
    return summary;
}

} // namespace

double KernelSummary::megaraysPerSecond(std::uint64_t rayCount) const {
    const double seconds = times.medianFrameMillis() * 1e-3;
    return seconds > 0.0 ? static_cast<double>(rayCount) / 1e6 / seconds : 0.0;
}

std::vector<StageSummary> summariseStages(const Profile &profile) {
    std::vector<StageSummary> stages;
    const std::int64_t framesBegin = profile.frames.front().span.beginNanos;
    for (const StageRecord &stage : profile.hostStages)
        if (stage.span.beginNanos < framesBegin)
            stages.push_back(summariseHostStage(stage));
    for (const std::string &name : namesIn(profile, stageSpans))
        stages.push_back(summariseSpans(profile, name, stageSpans));
    for (const StageRecord &stage : profile.hostStages)
        if (stage.span.beginNanos >= framesBegin)
            stages.push_back(summariseHostStage(stage));
    return stages;
}

std::vector<KernelSummary> summariseKernels(const Profile &profile) {
    std::vector<KernelSummary> kernels;
    const auto lastFrame = std::find_if(profile.frames.rbegin(), profile.frames.rend(),
                                        [](const Frame &frame) { return frame.isMeasured; });
    for (const std::string &name : namesIn(profile, kernelSpans)) {
        KernelSummary kernel;
        kernel.times = summariseSpans(profile, name, kernelSpans);
        for (const DispatchRecord &dispatch : lastFrame->timeline.dispatches) {
            if (dispatch.kernel != name)
                continue;
            kernel.invocations += dispatch.invocations;
            kernel.rays += dispatch.rays;
        }
        kernels.push_back(std::move(kernel));
    }
    return kernels;
}

StartSummary summariseColdStart(const Profile &profile) {
    StartSummary start;
    const Frame &first = profile.frames.front();
    for (const StageRecord &stage : profile.hostStages)
        if (stage.span.beginNanos < first.span.beginNanos) {
            start.stages.push_back({stage.name, stage.span.millis()});
            start.millis += stage.span.millis();
        }
    for (const std::string &name : namesIn(profile, stageSpans)) {
        double millis = 0.0;
        for (const NamedSpan &named : stageSpans(first))
            millis += *named.name == name ? named.span.millis() : 0.0;
        start.stages.push_back({name, millis});
    }
    start.millis += first.span.millis();
    return start;
}

std::optional<StartSummary> summariseWarmFrame(const Profile &profile) {
    Profile later; // without its first frame
    std::vector<double> millis;
    for (const Frame &frame : std::span(profile.frames).subspan(1))
        if (frame.isMeasured) {
            later.frames.push_back(frame);
            millis.push_back(frame.span.millis());
        }
    if (millis.empty())
        return std::nullopt;
    StartSummary start{quantile(millis, 0.5), {}};
    for (const std::string &name : namesIn(later, stageSpans))
        start.stages.push_back({name, summariseSpans(later, name, stageSpans).medianFrameMillis()});
    return start;
}

double measuredShare(const Profile &profile) {
    double share = 1.0;
    for (const Frame &frame : profile.frames)
        if (frame.isMeasured)
            share = std::min(share, frame.finishedShare);
    return share;
}

std::vector<double> frameMillis(const Profile &profile) {
    std::vector<double> millis;
    for (const Frame &frame : profile.frames)
        if (frame.isMeasured)
            millis.push_back(frame.span.millis());
    return millis;
}

double stageShare(const std::vector<StageSummary> &stages) {
    double share = 0.0;
    for (const StageSummary &stage : stages)
        share += stage.share;
    return share;
}

std::uint64_t maxDeviceBytes(const Profile &profile) {
    std::uint64_t most = 0;
    for (const Frame &frame : profile.frames)
        for (const StageRecord &stage : frame.timeline.stages)
            most = std::max(most, stage.deviceBytes);
    return most;
}

StageSummary summariseFrame(const Profile &profile) {
    StageSummary frame;
    frame.name = "frame";
    frame.isInFrame = true;
    frame.launchCount = 1;
    frame.frameMillis = frameMillis(profile);
    frame.launch = summarise(frame.frameMillis);
    frame.share = 1.0;
    if (!profile.frames.front().isMeasured)
        frame.firstMillis = profile.frames.front().span.millis();
    return frame;
}

} // namespace hyalite::core
