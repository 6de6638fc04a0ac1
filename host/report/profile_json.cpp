#include "host/report/profile_json.h"

#include "host/report/render_report.h"

namespace hyalite::core {

namespace {

nlohmann::ordered_json summaryToJson(const StageSummary &stage) {
    nlohmann::ordered_json json;
    json["name"] = stage.name;
    json["isInFrame"] = stage.isInFrame;
    json["launches"] = stage.launchCount;
    if (stage.firstMillis)
        json["firstMillis"] = *stage.firstMillis;
    json["totalMillis"] = stage.medianFrameMillis();
    if (stage.isInFrame)
        json["share"] = stage.share;
    json["minMillis"] = stage.launch.min;
    json["medianMillis"] = stage.launch.median;
    json["p95Millis"] = stage.launch.p95;
    json["maxMillis"] = stage.launch.max;
    json["frameMillis"] = stage.frameMillis;
    return json;
}

nlohmann::ordered_json kernelToJson(const KernelSummary &kernel) {
    nlohmann::ordered_json json = summaryToJson(kernel.times);
    json["invocations"] = kernel.invocations;
    json["rays"] = raysToJson(kernel.rays);
    nlohmann::ordered_json &speeds = json["megaraysPerSecond"];
    for (const RayKind &kind : rayKinds)
        speeds[kind.name] = kernel.megaraysPerSecond(kernel.rays.*kind.count);
    speeds["total"] = kernel.megaraysPerSecond(kernel.rays.total());
    return json;
}

nlohmann::ordered_json startToJson(const StartSummary &start) {
    nlohmann::ordered_json json{{"millis", start.millis}};
    for (const StartSummary::Stage &stage : start.stages)
        json["stages"].push_back({{"name", stage.name}, {"millis", stage.millis}});
    return json;
}

} // namespace

nlohmann::ordered_json profileToJson(const Profile &profile) {
    const std::vector<KernelSummary> kernels = summariseKernels(profile);
    const std::vector<double> frames = frameMillis(profile);
    nlohmann::ordered_json json{{"profileVersion", profileVersion}};
    json.update(provenanceToJson(profile.origin, profile.device));
    json["device"]["clock"] = profile.frames.back().timeline.clock;
    json["sceneBytes"] = profile.sceneBytes;
    if (const std::uint64_t bytes = maxDeviceBytes(profile); bytes > 0)
        json["deviceBytes"] = bytes;
    json["verification"] = profile.verification;
    json["isVerified"] = profile.isVerified;
    if (profile.timeLimitSeconds)
        json["timeLimit"] = {{"seconds", *profile.timeLimitSeconds}, {"leftOut", profile.leftOut}};
    if (const double share = measuredShare(profile); share < 1.0)
        json["finishedShare"] = share;
    json["repeats"] = frames.size();
    json["frameMillis"] = frames;
    json["frame"] = summaryToJson(summariseFrame(profile));
    json["frame"].erase("frameMillis");
    json["stageShare"] = stageShare(summariseStages(profile));
    for (const StageSummary &stage : summariseStages(profile))
        json["stages"].push_back(summaryToJson(stage));
    json["coldStart"] = startToJson(summariseColdStart(profile));
    json["coldStart"]["frame"] = profile.frames.front().label;
    if (const std::optional<StartSummary> warm = summariseWarmFrame(profile))
        json["warmFrame"] = startToJson(*warm);
    RayCounts rays;
    for (const KernelSummary &kernel : kernels) {
        json["kernels"].push_back(kernelToJson(kernel));
        rays += kernel.rays;
    }
    json["work"]["rays"] = raysToJson(rays);
    if (profile.work)
        for (const WorkKind &kind : workKinds)
            json["work"]["withStack"][kind.name] = *profile.work.*kind.count;
    if (profile.kernelWork) {
        for (const WorkKind &kind : workKinds)
            if (profile.kernelWork->countsNodes || kind.count == &WorkCounts::trianglesTested)
                json["work"][profile.kernelWork->kernel][kind.name] = profile.kernelWork->work.*kind.count;
        const LaneCounts &lanes = profile.kernelWork->lanes;
        json["lanes"] = {{"passes", lanes.passes},
                         {"busySlots", lanes.busySlots},
                         {"slotsPerSubgroup", lanes.slotsPerSubgroup},
                         {"busyShare", lanes.busyShare()}};
    }
    if (profile.charges)
        json["charges"] = chargesToJson(*profile.charges);
    for (const WorkBin &bin : profile.workHistogram)
        json["testsPerSample"].push_back({{"from", bin.begin}, {"to", bin.end}, {"pixels", bin.pixelCount}});
    return json;
}

} // namespace hyalite::core
