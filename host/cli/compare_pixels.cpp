#include "host/base/atomic_file.h"
#include "host/base/json_text.h"
#include "host/base/message.h"
#include "host/cli/compare_options.h"
#include "host/cli/explanations.h"
#include "host/cli/options.h"
#include "host/cli/outliers.h"
#include "host/cli/terminal_observer.h"
#include "host/image/comparison_json.h"
#include "host/image/heat_map.h"
#include "host/image/png.h"
#include "host/import/assets.h"
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
    nlohmann::ordered_json reasons = nlohmann::ordered_json::object(); ///< for the report
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

/// The requested files, opened before the work begins.
class CompareFiles {
  public:
    explicit CompareFiles(const CompareOptions &options) : heatMapPath_(options.heatMap) {
        if (!options.heatMap.empty()) {
            if (imageFormatOf(options.heatMap) != ImageFormat::Png)
                throw Error(ErrorKind::Usage,
                            fmt::format("--diff {}: the heat map must be a .png file", options.heatMap));
            heatMap_.emplace(options.heatMap);
        }
        if (!options.report.empty())
            report_.emplace(options.report);
    }

    void requireSize(const Crop &crop) const {
        if (heatMap_)
            requirePngSize(heatMapPath_, crop.width(), crop.height());
    }

    void write(const nlohmann::ordered_json &origin, const Compared &compared, const Verdict &verdict) {
        if (heatMap_) {
            writePng(*heatMap_, compared.imageA.width(), compared.imageA.height(),
                     hyalite::core::heatMap(compared.comparison.flipMap), attributesOf(origin));
            heatMap_->commit();
        }
        if (!report_)
            return;
        nlohmann::ordered_json json = origin;
        json.update(comparisonToJson(compared.comparison, compared.imageB, compared.imageA));
        json["outliers"] = compared.outliers.size();
        if (!compared.a.film.light.empty())
            json["differingLight"] = compared.differingLight;
        json["areRayCountsEqual"] = compared.a.rays == compared.b.rays;
        json.update(verdict.reasons);
        json["passed"] = verdict.isPassed;
        report_->write(jsonText(json));
        report_->commit();
    }

  private:
    std::string heatMapPath_;
    std::optional<AtomicFile> heatMap_;
    std::optional<AtomicFile> report_;
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
    printResult("{}\n", compared.outliers.empty() ? "no outliers"
                        : unexplained == 0        ? "every outlier is explained"
                                           : fmt::format("{} outliers are not explained", unexplained));
    return verdict;
}

/// Comparison of renders that should be equal. If they are not, it reports the first step that differs.
Verdict judgeBits(const ComparisonRun &run, const PreparedScene &scene, const Compared &compared,
                  bool isWithinShare, bool isExact) {
    Verdict verdict;
    // A tolerance is for what is seen.
    verdict.isPassed = isWithinShare && (compared.differingLight == 0 || !isExact);
    const bool areEqual = compared.comparison.identical() && compared.differingLight == 0;
    if (!compared.comparison.identical()) {
        const glm::uvec2 pixel = imagePixel(scene.crop, worstPixel(compared));
        const std::optional<Divergence> divergence =
            findFirstDivergence(*run.first, *run.second, scene, pixel);
        printDivergence(pixel, divergence);
        verdict.reasons["divergence"] = divergenceToJson(pixel, divergence);
    }
    if (compared.a.rays != compared.b.rays)
        printResult("rays         {} and {}: the counts differ\n", compared.a.rays.total(),
                    compared.b.rays.total());
    printResult("{}\n", areEqual           ? "equal, bit for bit"
                        : verdict.isPassed ? "equal within the tolerance"
                                           : "NOT equal");
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

ExitCode runCompare(const CompareOptions &options, const std::string &commandLine) {
    const Tolerance tolerance = parseTolerance(options.tolerance);
    const std::vector<NamedFile> outputs{{"--diff", options.heatMap}, {"--report", options.report}};
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
    const Compared compared = compareRenders(options, tolerance, run, scene, observer);
    printMetrics(compared);
    printOutliers(options, tolerance, compared);
    const bool isWithinShare = compared.outlierShare() <= options.maxOutliers;
    const Verdict verdict = isAgainstOracle(options)
                                ? judgeOutliers(scene, compared, isWithinShare)
                                : judgeBits(run, scene, compared, isWithinShare, isDefault(tolerance));
    files.write(comparisonRunToJson(run, scene, commandLine), compared, verdict);
    return verdict.isPassed ? ExitCode::Ok : ExitCode::AnswerIsNo;
}

} // namespace hyalite::core
