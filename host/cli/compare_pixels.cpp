#include "host/base/json_text.h"
#include "host/base/message.h"
#include "host/cli/compare_options.h"
#include "host/cli/explanations.h"
#include "host/cli/options.h"
#include "host/cli/outliers.h"
#include "host/cli/requested_file.h"
#include "host/cli/terminal_observer.h"
#include "host/film/timeline.h"
#include "host/image/comparison_json.h"
#include "host/image/heat_map.h"
#include "host/image/png.h"
#include "host/import/assets.h"
#include "host/lab/comparison_html.h"
#include "host/packing/light_planes.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace hyalite::core {

namespace {

struct Compared : ComparedRenders {
    Pixels outliers;

    [[nodiscard]] double outlierShare() const {
        return static_cast<double>(outliers.size()) / static_cast<double>(comparison.pixels.pixelCount);
    }
};

/// The outcome of a comparison.
struct Verdict {
    bool isPassed = false;
    std::string text;                                                  ///< in a few words
    std::string failure;                                               ///< why it is not passed
    nlohmann::ordered_json reasons = nlohmann::ordered_json::object(); ///< for the report
    std::optional<Divergence> divergence{};
};

bool isAgainstOracle(const CompareOptions &options) { return options.comparison.against == "cpu-double"; }

bool isDefault(const Tolerance &tolerance) { return tolerance.absolute == 0.0 && tolerance.ulps == 0; }

void printMetrics(const ComparedRenders &renders) {
    const ImageComparison &comparison = renders.comparison;
    const PixelMetrics &pixels = comparison.pixels;
    printResult("pixels       {} of {} differ\n", pixels.differingPixelCount, pixels.pixelCount);
    if (!pixels.identical()) {
        const glm::ivec2 worst = worstPixel(renders);
        const glm::vec3 &x = renders.imageA.at(worst.x, worst.y);
        const glm::vec3 &y = renders.imageB.at(worst.x, worst.y);
        printResult(
            "largest      {} ULP; {:.6g} at ({}, {}): ({:.9g} {:.9g} {:.9g}) and ({:.9g} {:.9g} {:.9g})\n",
            pixels.maxUlpDistance, pixels.maxAbsoluteDifference, worst.x, worst.y, x.x, x.y, x.z, y.x, y.y,
            y.z);
    }
    if (comparison.alpha)
        printResult("alpha        {} of {} differ, by at most {:.6g}; colours are compared over black\n",
                    comparison.alpha->differingPixelCount, pixels.pixelCount,
                    comparison.alpha->maxAbsoluteDifference);
    if (!renders.a.film.light.empty())
        printResult("light        {} of {} differ in the layers of light\n", renders.differingLight,
                    pixels.pixelCount);
    printResult("PSNR         {:.2f} dB\n", pixels.psnrDecibels());
    printResult("HDR-FLIP     mean {:.6f}, max {:.6f}\n", comparison.flip.mean, comparison.flip.max);
}

/// What is written besides the heat map.
struct Findings {
    const ComparisonRun &run;
    const PreparedScene &scene;
    const Compared &compared;
    const Verdict &verdict;
    nlohmann::ordered_json origin{}; ///< of comparisonRunToJson()
};

nlohmann::ordered_json reportOf(const Findings &findings) {
    const Compared &compared = findings.compared;
    nlohmann::ordered_json json = findings.origin;
    json.update(comparisonToJson(compared.comparison, compared.imageB, compared.imageA));
    json["outliers"] = compared.outliers.size();
    if (!compared.a.film.light.empty())
        json["differingLight"] = compared.differingLight;
    json["areRayCountsEqual"] = compared.a.rays == compared.b.rays;
    json.update(findings.verdict.reasons);
    json["passed"] = findings.verdict.isPassed;
    return json;
}

std::string pageOf(const Findings &findings) {
    const ComparisonRun &run = findings.run;
    const PreparedScene &scene = findings.scene;
    const Compared &compared = findings.compared;
    const Verdict &verdict = findings.verdict;
    const Integrator integrator = scene.loaded.settings.integrator;
    nlohmann::ordered_json report = reportOf(findings);
    const glm::ivec2 worst = worstPixel(compared);
    if (verdict.divergence)
        report["traces"] =
            tracesToJson(*run.first, *run.second, scene, imagePixel(scene.crop, worst), *verdict.divergence);
    const auto pictureOf = [&](const char *role, const Backend &backend, const Image &image,
                               const std::vector<float> &alpha) {
        return ComparedPicture{role, backend.description(), image, alpha,
                               attributesOf(rendererToJson(backend.identity(scene.packed, integrator)))};
    };
    return comparisonHtml({.title = scene.loaded.file.filename().string(),
                           .verdict = verdict.text,
                           .isPassed = verdict.isPassed,
                           .first = pictureOf("first", *run.first, compared.imageA, compared.alphaA),
                           .second = pictureOf("second", *run.second, compared.imageB, compared.alphaB),
                           .comparison = compared.comparison,
                           .centre = worst,
                           .corner = {scene.crop.x0, scene.crop.y0},
                           .report = std::move(report)});
}

/// The requested files, opened before the work begins.
class CompareFiles {
  public:
    explicit CompareFiles(const CompareOptions &options)
        : heatMapPath_(options.heatMap), heatMap_(requirePng(options.heatMap)), report_(options.report),
          html_(options.html) {}

    void requireSize(const Crop &crop) const {
        if (heatMap_)
            requirePngSize(heatMapPath_, crop.width(), crop.height());
    }

    void write(const Findings &findings) {
        const Compared &compared = findings.compared;
        if (heatMap_) {
            writePng(*heatMap_, compared.imageA.width(), compared.imageA.height(),
                     hyalite::core::heatMap(compared.comparison.flipMap), attributesOf(findings.origin));
            (*heatMap_).commit();
        }
        if (report_)
            report_.store(jsonText(reportOf(findings)));
        if (html_)
            html_.store(pageOf(findings));
    }

  private:
    static const std::string &requirePng(const std::string &path) {
        if (!path.empty() && imageFormatOf(path) != ImageFormat::Png)
            throw Error(ErrorKind::Usage, fmt::format("--diff {}: the heat map must be a .png file", path));
        return path;
    }

    std::string heatMapPath_;
    RequestedFile heatMap_;
    RequestedFile report_;
    RequestedFile html_;
};

Compared compareRenders(const CompareOptions &options, const Tolerance &tolerance, const ComparisonRun &run,
                        const PreparedScene &scene, Observer &observer) {
    Compared compared{renderBoth(run, scene, observer), {}};
    compared.outliers = isAgainstOracle(options) && isDefault(tolerance)
                            ? findVisibleOutliers(compared.imageA, compared.imageB)
                            : findOutliers(compared.imageA, compared.imageB, tolerance);
    return compared;
}

/// Comparison with double precision: also passes if every outlier is explained.
Verdict judgeOutliers(const PreparedScene &scene, const Compared &compared, bool isWithinShare) {
    Verdict verdict;
    const std::size_t unexplained = explainOutliers(scene, compared.outliers);
    verdict.reasons["unexplainedOutliers"] = unexplained;
    verdict.isPassed = isWithinShare || unexplained == 0;
    verdict.text = compared.outliers.empty() ? "no outliers"
                   : unexplained == 0        ? "every outlier is explained"
                                             : fmt::format("{} outliers are not explained", unexplained);
    verdict.failure = verdict.text;
    printResult("{}\n", verdict.text);
    return verdict;
}

/// Comparison of renders that should be equal. If they are not, it reports the first step that differs.
Verdict judgeBits(const ComparisonRun &run, const PreparedScene &scene, const Compared &compared,
                  bool isWithinShare, bool isExact) {
    Verdict verdict;
    // A tolerance is for what is seen.
    verdict.isPassed = isWithinShare && (compared.differingLight == 0 || !isExact);
    const bool areEqual = compared.comparison.identical() && compared.differingLight == 0;
    verdict.failure = fmt::format("{} of {} pixels differ", compared.comparison.pixels.differingPixelCount,
                                  compared.comparison.pixels.pixelCount);
    if (compared.differingLight > 0)
        verdict.failure += fmt::format("; {} in the layers of light", compared.differingLight);
    if (!compared.comparison.identical()) {
        const glm::uvec2 pixel = imagePixel(scene.crop, worstPixel(compared));
        verdict.divergence = findFirstDivergence(*run.first, *run.second, scene, pixel);
        printDivergence(pixel, verdict.divergence);
        verdict.reasons["divergence"] = divergenceToJson(pixel, verdict.divergence);
        verdict.failure += "; " + describe(pixel, verdict.divergence);
    }
    if (compared.a.rays != compared.b.rays)
        printResult("rays         {} and {}: the counts differ\n", compared.a.rays.total(),
                    compared.b.rays.total());
    verdict.text = areEqual           ? "equal, bit for bit"
                   : verdict.isPassed ? "equal within the tolerance"
                                      : "NOT equal";
    printResult("{}\n", verdict.text);
    return verdict;
}

void printOutliers(const CompareOptions &options, const Tolerance &tolerance, const Compared &compared) {
    if (!isAgainstOracle(options) && isDefault(tolerance))
        return;
    printResult("outliers     {} pixels ({:.4f} %) {}\n", compared.outliers.size(),
                compared.outlierShare() * 100.0,
                isAgainstOracle(options) && isDefault(tolerance) ? "by more than 2/255 as a PNG shows them"
                                                                 : "beyond the tolerance");
}

} // namespace

ComparedScene compareScene(const CompareOptions &options, const std::string &commandLine) {
    const Tolerance tolerance = parseTolerance(options.tolerance);
    const std::vector<NamedFile> outputs{{"--diff", options.heatMap},
                                         {"--report", options.report},
                                         {"--html", options.html},
                                         {"--junit", options.junit}};
    requireDistinctFiles(outputs, {resolveScene(options.scene.scene).string()});
    CompareFiles files(options);
    TerminalObserver observer(options.isQuiet);
    const PreparedScene scene = prepareScene(options.scene, Source::Dropped, observer);
    requireDistinctFiles(outputs, scene.loaded.inputFiles);
    files.requireSize(scene.crop);
    requireFilmMemory(scene.crop, 2, 2 * lightPlanesOf(scene.packed, scene.loaded.settings).count());
    const ComparisonRun run = openComparison(options.comparison, scene, observer);
    if (!options.isQuiet)
        printRenderers(scene, run);
    Stopwatch watch;
    const Compared compared = compareRenders(options, tolerance, run, scene, observer);
    const double seconds = watch.lap().seconds();
    printMetrics(compared);
    printOutliers(options, tolerance, compared);
    const bool isWithinShare = compared.outlierShare() <= options.maxOutliers;
    const Verdict verdict = isAgainstOracle(options)
                                ? judgeOutliers(scene, compared, isWithinShare)
                                : judgeBits(run, scene, compared, isWithinShare, isDefault(tolerance));
    files.write({run, scene, compared, verdict, comparisonRunToJson(run, scene, commandLine)});
    const std::string failure = verdict.isPassed ? "" : verdict.failure;
    return {comparisonSuite(run, scene, seconds, failure),
            {.title = scene.loaded.file.filename().string(),
             .verdict = verdict.isPassed ? verdict.text : failure,
             .isPassed = verdict.isPassed,
             .picture = thumbnail(compared.imageA),
             .errors = thumbnail(compared.comparison.flipMap)}};
}

} // namespace hyalite::core
