#include "host/base/json_text.h"
#include "host/base/message.h"
#include "host/cli/diff_options.h"
#include "host/cli/options.h"
#include "host/cli/requested_file.h"
#include "host/film/timeline.h"
#include "host/image/comparison_json.h"
#include "host/image/heat_map.h"
#include "host/image/png.h"
#include "host/image/ssim.h"
#include "host/lab/comparison_html.h"
#include "host/report/provenance.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hyalite::core {

namespace {

/// A bound that the user set on a metric.
struct ErrorGate {
    std::string option;
    double limit = 0.0;
    double value = 0.0;
    bool isPassed = false;
};

struct Inputs {
    LoadedImage reference;
    LoadedImage test;
    std::string toneMapped; ///< the file that was tone-mapped for the comparison, or empty
    Mask mask;
};

Inputs readInputs(const DiffOptions &options) {
    LoadedImage reference = readImage(options.reference);
    LoadedImage test = readImage(options.test);
    requireSameSize(reference.image, options.reference, test.image, options.test);

    Inputs inputs;
    if (reference.encoding != test.encoding) {
        LoadedImage &linear = reference.encoding == Encoding::Linear ? reference : test;
        inputs.toneMapped = &linear == &reference ? options.reference : options.test;
        linear = asDisplayed(linear);
    }
    inputs.reference = std::move(reference);
    inputs.test = std::move(test);

    if (!options.mask.empty()) {
        const Image mask = readImage(options.mask).image;
        requireSameSize(inputs.reference.image, options.reference, mask, options.mask);
        inputs.mask = maskFromImage(mask);
        if (std::find(inputs.mask.begin(), inputs.mask.end(), 1) == inputs.mask.end())
            throw Error(
                ErrorKind::BadInput,
                fmt::format("'{}' leaves no pixel to compare; the mask is white where images are compared",
                            options.mask));
    }
    return inputs;
}

std::vector<ErrorGate> applyGates(const DiffOptions &options, const ImageComparison &comparison) {
    std::vector<ErrorGate> gates;
    // NaN fails both kinds of gates.
    const auto atLeast = [&](const char *option, const std::optional<double> &limit, double value) {
        if (limit)
            gates.push_back({option, *limit, value, value >= *limit});
    };
    const auto atMost = [&](const char *option, const std::optional<double> &limit, double value) {
        if (limit)
            gates.push_back({option, *limit, value, value <= *limit});
    };
    if (options.minSsim && !comparison.ssim)
        throw Error(
            ErrorKind::BadInput,
            fmt::format("--min-ssim: '{}' and '{}' have no SSIM: it needs finite values, and {} x {} pixels "
                        "around one that is compared; use another gate",
                        options.reference, options.test, ssimWindowSide, ssimWindowSide));
    atLeast("--min-psnr", options.minPsnr, comparison.pixels.psnrDecibels());
    atLeast("--min-ssim", options.minSsim, comparison.ssim.value_or(0.0));
    atMost("--max-flip", options.maxFlip, comparison.flip.mean);
    atMost("--max-diff", options.maxDifference,
           std::max(comparison.pixels.maxAbsoluteDifference,
                    comparison.alpha ? comparison.alpha->maxAbsoluteDifference : 0.0));
    atMost("--max-outliers", options.maxOutliers, comparison.pixels.outlierFraction());
    return gates;
}

std::string share(std::uint64_t count, std::uint64_t total) {
    return fmt::format("{} ({:.4g} %)", count,
                       100.0 * static_cast<double>(count) / static_cast<double>(total));
}

void printAlpha(const DiffOptions &options, const AlphaMetrics &alpha, int width, std::uint64_t pixelCount) {
    if (!alpha.hasReference || !alpha.hasTest)
        printResult("alpha        {} has none, and counts as opaque\n",
                    alpha.hasReference ? options.test : options.reference);
    printResult("alpha        {} pixels differ", share(alpha.differingPixelCount, pixelCount));
    if (!alpha.identical()) {
        const auto side = static_cast<std::size_t>(width);
        printResult("; largest {:.6g} at ({}, {}), mean {:.6g}", alpha.maxAbsoluteDifference,
                    alpha.worstIndex % side, alpha.worstIndex / side, alpha.meanAbsoluteDifference);
    }
    printResult("; colours are compared over black\n");
}

void printTable(const DiffOptions &options, const Inputs &inputs, const ImageComparison &comparison) {
    const PixelMetrics &pixels = comparison.pixels;
    const bool isLinear = comparison.encoding == Encoding::Linear;
    printResult("reference    {}: {} x {}, {}\n", options.reference, inputs.reference.image.width(),
                inputs.reference.image.height(), isLinear ? "linear" : "display-encoded");
    printResult("test         {}\n", options.test);
    if (!inputs.toneMapped.empty())
        printResult("             {} is linear and was tone-mapped to 8 bits to be compared\n",
                    inputs.toneMapped);
    if (!options.mask.empty())
        printResult("mask         {}: {} pixels compared\n", options.mask, pixels.pixelCount);
    printResult("differing    {} pixels\n", share(pixels.differingPixelCount, pixels.pixelCount));
    if (options.outlierThreshold > 0.0)
        printResult("outliers     {} pixels by more than {:g}\n",
                    share(pixels.outlierCount, pixels.pixelCount), options.outlierThreshold);
    if (pixels.nonFiniteCount > 0)
        printResult("not finite   {} pixels\n", share(pixels.nonFiniteCount, pixels.pixelCount));
    if (!pixels.identical()) {
        const glm::vec3 a = inputs.reference.composite().at(pixels.worstX, pixels.worstY);
        const glm::vec3 b = inputs.test.composite().at(pixels.worstX, pixels.worstY);
        printResult("largest      {:.6g} at ({}, {}): ({:.9g} {:.9g} {:.9g}) and ({:.9g} {:.9g} {:.9g})\n",
                    pixels.maxAbsoluteDifference, pixels.worstX, pixels.worstY, a.x, a.y, a.z, b.x, b.y, b.z);
    }
    if (isLinear)
        printResult("ULP          {} at most\n", pixels.maxUlpDistance);
    printResult("mean         {:.6g} absolute, {:.6g} signed\n", pixels.meanAbsoluteDifference,
                pixels.meanDifference);
    printResult("MSE          {:.6g}\n", pixels.meanSquaredError);
    printResult("PSNR         {:.4f} dB\n", pixels.psnrDecibels());
    printResult("SSIM         {}\n",
                comparison.ssim ? fmt::format("{:.6f}", *comparison.ssim) : "not available");
    printResult("{}     mean {:.6f}, weighted median {:.6f}, max {:.6f}\n",
                isLinear ? "HDR-FLIP" : "FLIP    ", comparison.flip.mean, comparison.flip.weightedMedian,
                comparison.flip.max);
    if (comparison.alpha)
        printAlpha(options, *comparison.alpha, inputs.reference.image.width(), pixels.pixelCount);
}

std::string verdictText(const std::vector<ErrorGate> &gates, bool isPassed) {
    if (gates.empty())
        return isPassed ? "identical" : "not identical";
    return isPassed ? "passed" : "FAILED";
}

void printVerdict(const std::vector<ErrorGate> &gates, bool isPassed) {
    for (const ErrorGate &gate : gates)
        printResult("{:<15}{:g}: {}, {:.6g}\n", gate.option, gate.limit, gate.isPassed ? "passed" : "FAILED",
                    gate.value);
    printResult("{}\n", verdictText(gates, isPassed));
}

/// Why a comparison fails, for CI.
std::string failureText(const std::vector<ErrorGate> &gates, const PixelMetrics &pixels) {
    std::string text = fmt::format("{} of {} pixels differ, by at most {:.6g}", pixels.differingPixelCount,
                                   pixels.pixelCount, pixels.maxAbsoluteDifference);
    for (const ErrorGate &gate : gates)
        if (!gate.isPassed)
            text += fmt::format("; {} {:g}: found {:.6g}", gate.option, gate.limit, gate.value);
    return text;
}

nlohmann::ordered_json reportOf(const DiffOptions &options, const std::string &commandLine,
                                const Inputs &inputs, const ImageComparison &comparison,
                                const std::vector<ErrorGate> &gates, bool isPassed) {
    nlohmann::ordered_json report = programToJson(commandLine);
    report["reference"] = options.reference;
    report["test"] = options.test;
    if (!options.mask.empty())
        report["mask"] = options.mask;
    if (!inputs.toneMapped.empty())
        report["toneMapped"] = inputs.toneMapped;
    report["outlierThreshold"] = options.outlierThreshold;
    report.update(comparisonToJson(comparison, inputs.reference.composite(), inputs.test.composite()));
    report["gates"] = nlohmann::ordered_json::array();
    for (const ErrorGate &gate : gates)
        report["gates"].push_back({{"option", gate.option},
                                   {"limit", gate.limit},
                                   {"value", gate.value},
                                   {"passed", gate.isPassed}});
    report["passed"] = isPassed;
    return report;
}

std::string pageOf(const DiffOptions &options, const Inputs &inputs, const ImageComparison &comparison,
                   const std::string &verdict, const nlohmann::ordered_json &report) {
    const Image reference = inputs.reference.composite();
    const Image test = inputs.test.composite();
    return comparisonHtml(
        {.title = fmt::format("{} and {}", std::filesystem::path(options.reference).filename().string(),
                              std::filesystem::path(options.test).filename().string()),
         .verdict = verdict,
         .isPassed = report.at("passed").get<bool>(),
         .first = {"reference", options.reference, reference, inputs.reference.alpha,
                   readAttributes(options.reference)},
         .second = {"test", options.test, test, inputs.test.alpha, readAttributes(options.test)},
         .comparison = comparison,
         .mask = inputs.mask,
         .centre = {comparison.pixels.worstX, comparison.pixels.worstY},
         .report = report});
}

} // namespace

ExitCode runDiff(const DiffOptions &options, const std::string &commandLine) {
    requireDistinctFiles({{"--diff", options.heatMap},
                          {"--report", options.report},
                          {"--html", options.html},
                          {"--junit", options.junit}},
                         {options.reference, options.test, options.mask});
    if (!options.heatMap.empty() && imageFormatOf(options.heatMap) != ImageFormat::Png)
        throw Error(ErrorKind::Usage,
                    fmt::format("--diff '{}': the heat map must be a .png file", options.heatMap));
    RequestedFile heatMapFile(options.heatMap);
    RequestedFile reportFile(options.report);
    RequestedFile htmlFile(options.html);
    RequestedFile junitFile(options.junit);
    Stopwatch watch;

    const Inputs inputs = readInputs(options);
    const ImageComparison comparison =
        compareImages(inputs.reference, inputs.test, options.outlierThreshold, inputs.mask);
    const std::vector<ErrorGate> gates = applyGates(options, comparison);
    bool isPassed = !gates.empty() || comparison.identical();
    for (const ErrorGate &gate : gates)
        isPassed = isPassed && gate.isPassed;

    if (heatMapFile) {
        writePng(*heatMapFile, comparison.flipMap.width, comparison.flipMap.height,
                 heatMap(comparison.flipMap), attributesOf(programToJson(commandLine)));
        (*heatMapFile).commit();
    }
    const nlohmann::ordered_json report = reportOf(options, commandLine, inputs, comparison, gates, isPassed);
    if (reportFile)
        reportFile.store(jsonText(report));
    if (htmlFile)
        htmlFile.store(pageOf(options, inputs, comparison, verdictText(gates, isPassed), report));
    if (junitFile)
        junitFile.store(diffToJunit(options, watch.lap().seconds(),
                                    isPassed ? "" : failureText(gates, comparison.pixels)));
    printTable(options, inputs, comparison);
    printVerdict(gates, isPassed);
    return isPassed ? ExitCode::Ok : ExitCode::AnswerIsNo;
}

} // namespace hyalite::core
