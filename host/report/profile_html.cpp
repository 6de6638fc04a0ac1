#include "host/report/profile_html.h"

#include "host/base/hash.h"
#include "host/base/markup.h"
#include "host/base/quantities.h"
#include "host/base/version.h"
#include "host/report/figure_text.h"
#include "host/scene/settings_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace hyalite {

namespace {

/// Narrow pages have one column. Tables scroll by themselves, so that the page does not.
constexpr std::string_view style = R"(
:root { color-scheme: light dark; --ink: #1d2129; --dim: #5f6673; --line: #d9dce3; --page: #f6f7f9; --card: #fff; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e7e9ee; --dim: #9aa1ae; --line: #353a45; --page: #15171c; --card: #1e2128; }
}
* { box-sizing: border-box; }
body { margin: 0; padding: 24px 16px; background: var(--page); color: var(--ink);
       font: 15px/1.5 system-ui, sans-serif; overflow-wrap: anywhere; }
main { max-width: 1100px; margin: 0 auto; }
h1 { font-size: 24px; line-height: 1.25; margin: 0 0 4px; }
h2 { font-size: 17px; margin: 32px 0 8px; }
p { margin: 0 0 12px; color: var(--dim); }
td.tests i { display: block; height: 10px; border-radius: 2px; background: #4477aa; min-width: 1px; }
th.tests, td.tests { width: 100%; min-width: 120px; }
p.note { margin-top: 8px; font-size: 13px; }
.top { display: grid; grid-template-columns: minmax(0, 1fr) minmax(0, 1fr); gap: 16px; align-items: start; }
.top img { width: 100%; height: auto; display: block; border-radius: 6px; background: #000; }
.figures { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 12px; }
.figure, .card { background: var(--card); border: 1px solid var(--line); border-radius: 6px; padding: 12px 14px; }
.figure b { display: block; font-size: 22px; font-weight: 600; font-variant-numeric: tabular-nums; }
.figure span { color: var(--dim); font-size: 13px; }
.bar { display: flex; height: 28px; border-radius: 6px; overflow: hidden; background: var(--line); }
.bar div { min-width: 0; }
.key { list-style: none; display: flex; flex-wrap: wrap; gap: 4px 18px; margin: 10px 0 0; padding: 0;
       font-variant-numeric: tabular-nums; }
.key i { display: inline-block; width: 11px; height: 11px; border-radius: 2px; margin-right: 6px; }
.table { overflow-x: auto; background: var(--card); border: 1px solid var(--line); border-radius: 6px; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { padding: 6px 12px; text-align: right; white-space: nowrap; }
th { color: var(--dim); font-weight: 500; border-bottom: 1px solid var(--line); }
th:first-child, td:first-child { text-align: left; }
tr.sum td { border-top: 1px solid var(--line); font-weight: 600; }
dl { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: 4px 16px; margin: 0; }
dt { color: var(--dim); }
dd { margin: 0; }
code { font: 13px/1.5 ui-monospace, monospace; }
@media (max-width: 700px) {
  .top { grid-template-columns: minmax(0, 1fr); }
  dl { grid-template-columns: minmax(0, 1fr); gap: 0; }
  dd { margin-bottom: 8px; }
}
)";

/// Colours of the parts of the bar, in order. They can be told apart without seeing red or green (P. Tol, "Colour
/// Schemes", bright).
constexpr std::array<const char *, 7> partColours{"#4477aa", "#66ccee", "#228833", "#ccbb44",
                                                  "#ee6677", "#aa3377", "#bbbbbb"};

std::string figure(const std::string &value, const std::string &meaning) {
    return fmt::format("<div class=\"figure\"><b>{}</b><span>{}</span></div>\n", markupText(value),
                       markupText(meaning));
}

/// A row of cells; the first one names it.
std::string row(const char *cell, std::span<const std::string> texts, const char *rowClass = "") {
    std::string html = fmt::format("<tr{}>", *rowClass == '\0' ? "" : fmt::format(" class=\"{}\"", rowClass));
    for (const std::string &text : texts)
        html += fmt::format("<{0}>{1}</{0}>", cell, markupText(text));
    return html + "</tr>\n";
}

std::string tableOf(const std::string &rows) {
    return "<div class=\"table\"><table>\n" + rows + "</table></div>\n";
}

std::string headline(const std::string &subject) {
    const std::array<std::string, 9> cells{subject,  "launches", "total ms", "share", "min",
                                           "median", "p95",      "max",      "first"};
    return row("th", cells);
}

std::string timesRow(const StageSummary &stage) {
    const std::array<std::string, 9> cells{stage.name,
                                           std::to_string(stage.launchCount),
                                           millisText(stage.medianFrameMillis()),
                                           stage.isInFrame ? shareText(stage.share) : "–",
                                           millisText(stage.launch.min),
                                           millisText(stage.launch.median),
                                           millisText(stage.launch.p95),
                                           millisText(stage.launch.max),
                                           stage.firstMillis ? millisText(*stage.firstMillis) : "–"};
    return row("td", cells);
}

/// A bar of the stages of a frame; widths are their shares of the time.
std::string phaseBar(const std::vector<StageSummary> &stages) {
    std::string bar;
    std::string key;
    std::size_t index = 0;
    for (const StageSummary &stage : stages) {
        if (!stage.isInFrame)
            continue;
        const char *colour = partColours[index++ % partColours.size()];
        bar += fmt::format("<div style=\"width:{:.3f}%;background:{}\" title=\"{}\"></div>",
                           stage.share * 100.0, colour, markupText(stage.name));
        key += fmt::format("<li><i style=\"background:{}\"></i>{} {}</li>\n", colour, markupText(stage.name),
                           shareText(stage.share));
    }
    return fmt::format("<div class=\"bar\">{}</div>\n<ul class=\"key\">\n{}</ul>\n", bar, key);
}

std::string rayTable(const std::vector<KernelSummary> &kernels) {
    std::vector<std::string> head{"kernel", "invocations"};
    for (const RayKind &kind : rayKinds)
        head.emplace_back(kind.name);
    head.emplace_back("total");
    std::string rows = row("th", head);
    for (const KernelSummary &kernel : kernels) {
        std::vector<std::string> counts{kernel.times.name + ": rays", std::to_string(kernel.invocations)};
        std::vector<std::string> speeds{"Mray/s", ""};
        for (const RayKind &kind : rayKinds) {
            counts.push_back(std::to_string(kernel.rays.*kind.count));
            speeds.push_back(fmt::format("{:.2f}", kernel.megaraysPerSecond(kernel.rays.*kind.count)));
        }
        counts.push_back(std::to_string(kernel.rays.total()));
        speeds.push_back(fmt::format("{:.2f}", kernel.megaraysPerSecond(kernel.rays.total())));
        rows += row("td", counts) + row("td", speeds);
    }
    return tableOf(rows);
}

/// Histogram of the work over the pixels.
std::string histogram(const std::vector<WorkBin> &bins) {
    std::uint64_t pixelCount = 0;
    std::uint64_t most = 1;
    for (const WorkBin &bin : bins) {
        pixelCount += bin.pixelCount;
        most = std::max(most, bin.pixelCount);
    }
    std::string rows =
        "<tr><th>tests per sample</th><th>pixels</th><th>share</th><th class=\"tests\"></th></tr>\n";
    for (const WorkBin &bin : bins)
        rows += fmt::format("<tr><td>{:.0f} to {:.0f}</td><td>{}</td><td>{}</td><td class=\"tests\"><i "
                            "style=\"width:{:.1f}%\"></i></td></tr>\n",
                            bin.begin, bin.end, bin.pixelCount,
                            shareText(static_cast<double>(bin.pixelCount) / static_cast<double>(pixelCount)),
                            100.0 * static_cast<double>(bin.pixelCount) / static_cast<double>(most));
    return tableOf(rows);
}

/// The heat map of the work, its totals and its histogram.
std::string workOf(const Profile &profile, std::span<const std::byte> heatMapPng) {
    std::string html =
        fmt::format("<div class=\"top\">\n<img alt=\"Box and triangle tests of each pixel, in false "
                    "colours\" src=\"data:image/png;base64,{}\">\n<div>\n",
                    base64(heatMapPng));
    if (profile.work)
        html += fmt::format(
            "<p>{}, {}, {}, deepest stack {}</p>\n", roundedText(profile.work->nodesVisited, "inner nodes"),
            roundedText(profile.work->boxesTested, "boxes"),
            roundedText(profile.work->trianglesTested, "triangles"), profile.work->deepestStack);
    html += histogram(profile.workHistogram) +
            "<p class=\"note\">Of a traversal with a stack: equal on every device and on the CPU, whichever "
            "kernel was measured.</p>\n";
    if (profile.kernelWork) {
        const auto &[kernel, work, lanes] = *profile.kernelWork;
        html +=
            fmt::format("<p>{}: {}, {}; {} of {} path slots, {} of them busy</p>\n"
                        "<p class=\"note\">Of the kernel that was measured: passes depend on the device "
                        "and on how work was cut.</p>\n",
                        markupText(kernel), roundedText(work.nodesVisited, "nodes"),
                        roundedText(work.trianglesTested, "triangles"), roundedText(lanes.passes, "passes"),
                        lanes.slotsPerSubgroup, shareText(lanes.busyShare()));
    }
    return html + "</div>\n</div>\n";
}

std::string provenance(const Profile &profile) {
    const Provenance &origin = profile.origin;
    std::string html = "<dl class=\"card\">\n";
    const auto add = [&](const char *term, const std::string &text) {
        html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", term, markupText(text));
    };
    html += fmt::format("<dt>Command line</dt><dd><code>{}</code></dd>\n", markupText(origin.commandLine));
    add("Program", "hyalite " HYALITE_VERSION);
    add("Scene", fmt::format("{}, {}, {}", origin.scene, countText(origin.triangleCount, "triangle"),
                             sizeText(profile.sceneBytes)));
    add("Scene's hash", hashText(origin.sceneHash));
    std::string settingsText = fmt::format("{} by {}", origin.width, origin.height);
    for (const Setting &setting : settingsTable)
        settingsText += fmt::format(", {} {}", setting.key, settingToJson(setting, origin.settings).dump());
    add("Settings", settingsText);
    add("Device", profile.device.name);
    add("Driver", profile.device.driver);
    if (!profile.device.kernel.empty())
        add("SPIR-V",
            fmt::format("{} of kernel {}", hashText(profile.device.kernelHash), profile.device.kernel));
    add("Arithmetic", profile.device.arithmetic);
    add("Clock", profile.frames.back().timeline.clock);
    add("Verified", profile.verification);
    return html + "</dl>\n";
}

std::string headFigures(const Profile &profile, const StageSummary &frame,
                        const std::vector<KernelSummary> &kernels) {
    RayCounts rays;
    double kernelSeconds = 0.0;
    std::size_t launchCount = 0;
    for (const KernelSummary &kernel : kernels) {
        rays += kernel.rays;
        kernelSeconds += kernel.times.medianFrameMillis() * 1e-3;
        launchCount += kernel.times.launchCount;
    }
    std::string html = figure(millisText(frame.launch.median) + " ms",
                              fmt::format("a frame, median of {}", frame.launch.count));
    html += figure(fmt::format("{:.2f} Mray/s", kernelSeconds > 0.0
                                                    ? static_cast<double>(rays.total()) / 1e6 / kernelSeconds
                                                    : 0.0),
                   "while kernels run");
    html += figure(roundedText(rays.total(), "rays"), "in a frame");
    html += figure(countText(launchCount, "dispatch", "dispatches"), "in a frame");
    html += figure(sizeText(profile.sceneBytes), "of scene data");
    if (const std::uint64_t bytes = maxDeviceBytes(profile); bytes > 0)
        html += figure(sizeText(bytes), "in buffers on the device");
    return html;
}

std::string stageTable(const std::vector<StageSummary> &stages, const StageSummary &frame) {
    std::string rows = headline("stage");
    for (const StageSummary &stage : stages)
        rows += timesRow(stage);
    const std::array<std::string, 9> sums{"frame",
                                          "1",
                                          millisText(frame.medianFrameMillis()),
                                          shareText(frame.share),
                                          millisText(frame.launch.min),
                                          millisText(frame.launch.median),
                                          millisText(frame.launch.p95),
                                          millisText(frame.launch.max),
                                          ""};
    return tableOf(rows + row("td", sums, "sum"));
}

} // namespace

std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string profileHtml(const Profile &profile, std::span<const std::byte> png,
                        std::span<const std::byte> heatMapPng) {
    const std::vector<StageSummary> stages = summariseStages(profile);
    const std::vector<KernelSummary> kernels = summariseKernels(profile);
    const StageSummary frame = summariseFrame(profile);
    const Provenance &origin = profile.origin;
    const std::string sceneName = std::filesystem::path(origin.scene).filename().string();
    std::string html =
        fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                    "<title>{} on {}</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n",
                    markupText(sceneName), markupText(profile.device.name), style);
    html += fmt::format("<h1>{} on {}</h1>\n<p>{} by {} pixels, {}; {}</p>\n", markupText(sceneName),
                        markupText(profile.device.name), origin.width, origin.height,
                        countText(static_cast<std::uint64_t>(origin.settings.samplesPerPixel), "sample") +
                            " per pixel",
                        markupText(profile.verification));
    for (const std::string &omission : profile.leftOut)
        html += fmt::format("<p>Left out by the time limit: {}</p>\n", markupText(omission));
    html += fmt::format(
        "<div class=\"top\">\n<img alt=\"The image that was rendered\" width=\"{}\" height=\"{}\" "
        "src=\"data:image/png;base64,{}\">\n<div class=\"figures\">\n",
        origin.width, origin.height, base64(png));
    html += headFigures(profile, frame, kernels) + "</div>\n</div>\n";

    html += "<h2>Where a frame's time goes</h2>\n" + phaseBar(stages);
    html += "<h2>Stages</h2>\n" + stageTable(stages, frame);
    html += fmt::format("<p class=\"note\">Stages come to {} of the frames' time.</p>\n",
                        shareText(stageShare(stages)));
    std::string rows = headline("kernel");
    for (const KernelSummary &kernel : kernels)
        rows += timesRow(kernel.times);
    html += "<h2>Kernels</h2>\n" + tableOf(rows);
    html += "<h2>Rays of a frame</h2>\n" + rayTable(kernels);
    if (!heatMapPng.empty())
        html += "<h2>Where the rays have work</h2>\n" + workOf(profile, heatMapPng);
    html += "<h2>What was measured, and how</h2>\n" + provenance(profile);
    return html + "</main>\n</body>\n</html>\n";
}

} // namespace hyalite
