#include "host/report/profile_table.h"

#include "host/report/figure_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace hyalite::core {

namespace {

std::string speedText(double megaraysPerSecond) {
    return fmt::format("{:.{}f}", megaraysPerSecond, megaraysPerSecond < 10.0 ? 3 : 1);
}

std::string headline(const char *subject) {
    return fmt::format("{:<24}{:>9}{:>10}{:>9}{:>10}{:>10}{:>10}{:>10}{:>10}\n", subject, "launches",
                       "total ms", "share", "min", "median", "p95", "max", "first");
}

std::string row(const StageSummary &stage) {
    return fmt::format(
        "{:<24}{:>9}{:>10}{:>9}{:>10}{:>10}{:>10}{:>10}{:>10}\n", stage.name, stage.launchCount,
        millisText(stage.medianFrameMillis()), stage.isInFrame ? shareText(stage.share) : "-",
        millisText(stage.launch.min), millisText(stage.launch.median), millisText(stage.launch.p95),
        millisText(stage.launch.max), stage.firstMillis ? millisText(*stage.firstMillis) : "-");
}

/// A line for each bin, with a bar for its share of the pixels.
std::string workTable(const std::vector<WorkBin> &bins) {
    std::uint64_t pixelCount = 0;
    for (const WorkBin &bin : bins)
        pixelCount += bin.pixelCount;
    std::string text = fmt::format("\n{:<24}{:>9}{:>10}\n", "tests per sample", "pixels", "share");
    for (const WorkBin &bin : bins) {
        const double share = static_cast<double>(bin.pixelCount) / static_cast<double>(pixelCount);
        const std::string bar(static_cast<std::size_t>(share * 40.0 + 0.5), '#');
        text += fmt::format("{:<24}{:>9}{:>10}{}{}\n", fmt::format("{:.0f} to {:.0f}", bin.begin, bin.end),
                            bin.pixelCount, shareText(share), bar.empty() ? "" : "  ", bar);
    }
    return text;
}

} // namespace

std::string profileTable(const Profile &profile) {
    const std::vector<StageSummary> stages = summariseStages(profile);
    const std::vector<KernelSummary> kernels = summariseKernels(profile);
    std::string text = headline("stage");
    for (const StageSummary &stage : stages)
        text += row(stage);
    text += row(summariseFrame(profile));
    text += fmt::format("{:<24}{:>28}\n\n", "sum of stages", shareText(stageShare(stages)));

    text += headline("kernel");
    for (const KernelSummary &kernel : kernels)
        text += row(kernel.times);

    text += fmt::format("\n{:<24}{:>12}", "Mray/s", "invocations");
    for (const RayKind &kind : rayKinds)
        text += fmt::format("{:>12}", kind.name);
    text += fmt::format("{:>12}\n", "total");
    RayCounts rays;
    for (const KernelSummary &kernel : kernels) {
        rays += kernel.rays;
        text += fmt::format("{:<24}{:>12}", kernel.times.name, kernel.invocations);
        for (const RayKind &kind : rayKinds)
            text += fmt::format("{:>12}", speedText(kernel.megaraysPerSecond(kernel.rays.*kind.count)));
        text += fmt::format("{:>12}\n", speedText(kernel.megaraysPerSecond(kernel.rays.total())));
    }
    text += fmt::format("{:<36}", "rays in a frame");
    for (const RayKind &kind : rayKinds)
        text += fmt::format("{:>12}", rays.*kind.count);
    text += fmt::format("{:>12}\n", rays.total());
    if (profile.work)
        text +=
            fmt::format("work of all rays with a stack: {} nodes, {} boxes, {} triangles, deepest stack {}\n",
                        profile.work->nodesVisited, profile.work->boxesTested, profile.work->trianglesTested,
                        profile.work->deepestStack);
    if (profile.kernelWork) {
        const auto &[kernel, work, lanes, countsNodes] = *profile.kernelWork;
        const std::string nodes = countsNodes
                                      ? fmt::format("{} nodes, {} boxes", work.nodesVisited, work.boxesTested)
                                      : "nodes and boxes of the device's own tree";
        text += fmt::format("work of the kernel {}: {}, {} triangles\n", kernel, nodes, work.trianglesTested);
        text += fmt::format("lanes of this device: {} passes of {} path slots, {} of them busy\n",
                            lanes.passes, lanes.slotsPerSubgroup, shareText(lanes.busyShare()));
    }
    if (!profile.workHistogram.empty())
        text += workTable(profile.workHistogram);
    return text;
}

} // namespace hyalite::core
