#include "host/base/error.h"
#include "host/base/json_text.h"
#include "host/cli/commands.h"
#include "host/cli/device_options.h"
#include "host/cli/options.h"
#include "host/cli/outliers.h"
#include "host/cli/scene_options.h"
#include "host/cli/statistical.h"
#include "host/image/comparison_json.h"
#include "host/image/heat_map.h"
#include "host/image/png.h"
#include "host/import/assets.h"
#include "host/reference/divergence.h"
#include "host/reference/explain.h"
#include "host/render/backend.h"
#include "host/scene/settings_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

namespace hyalite {

namespace {

struct CompareOptions {
    SceneOptions scene;
    std::string device = "auto";
    std::string against = "cpu";
    std::string tolerance = "0";
    double maxOutliers = 0.0;
    int threads = 0;
    DeviceOptions deviceOptions;
    std::string heatMap;
    std::string report;
    bool isStatistical = false;
    ZTestOptions zTest;
    std::optional<std::uint32_t> againstSeed;
    bool isQuiet = false;
};

glm::uvec2 imagePixel(const Crop &crop, const glm::ivec2 &pixel) {
    return {static_cast<std::uint32_t>(crop.x0 + pixel.x), static_cast<std::uint32_t>(crop.y0 + pixel.y)};
}

/// Retraces a pixel on both sides, sample by sample, until a step differs.
std::optional<Divergence> findFirstDivergence(Backend &a, Backend &b, const PreparedScene &scene,
                                              const glm::uvec2 &pixel) {
    const int sampleCount = scene.loaded.scene.settings.samplesPerPixel;
    for (int sample = 0; sample < sampleCount; ++sample) {
        const std::uint32_t index = static_cast<std::uint32_t>(sample);
        if (std::optional<Divergence> divergence =
                findDivergence(a.trace(scene, pixel, index), b.trace(scene, pixel, index)))
            return divergence;
    }
    return std::nullopt;
}

void printDivergence(const glm::uvec2 &pixel, const std::optional<Divergence> &divergence) {
    if (!divergence) {
        fmt::print(
            "divergence   pixel ({}, {}): the paths agree in every step; what differs is how work is cut or "
            "summed\n",
            pixel.x, pixel.y);
        return;
    }
    fmt::print("divergence   pixel ({}, {}), sample {}, bounce {}: {}\n", pixel.x, pixel.y,
               divergence->sampleIndex, divergence->rayDepth - 1, divergence->quantity);
    fmt::print("  first      {}\n  second     {}\n", divergence->valueA, divergence->valueB);
}

/// Explains outliers against the oracle, and returns how many are not explained by a decision near its boundary.
std::size_t explainOutliers(const PreparedScene &scene, const Pixels &outliers) {
    constexpr std::size_t mostExplained = 2000;
    constexpr std::size_t mostPrinted = 8;
    std::size_t unexplained = outliers.size() > mostExplained ? outliers.size() - mostExplained : 0;
    std::array<std::size_t, 5> counts{};
    for (std::size_t i = 0; i < std::min(outliers.size(), mostExplained); ++i) {
        const glm::uvec2 pixel = imagePixel(scene.crop, outliers[i]);
        const reference::Explanation why =
            reference::explainOutlier(scene.packed, scene.loaded.scene.settings, pixel);
        ++counts[static_cast<std::size_t>(why.cause)];
        const bool isExplained = why.cause != reference::Cause::Rounding && why.marginPixels;
        unexplained += isExplained ? 0u : 1u;
        if (i < mostPrinted)
            fmt::print("  ({}, {})  {}{}\n", pixel.x, pixel.y, reference::causeName(why.cause),
                       why.marginPixels
                           ? fmt::format(", sample {}, bounce {}: the oracle decides so {:.2g} pixels "
                                         "away",
                                         why.sampleIndex, why.rayDepth - 1, *why.marginPixels)
                           : ", no reason found within a quarter of a pixel");
    }
    if (outliers.size() > mostPrinted)
        fmt::print("  ...\n");
    for (std::size_t cause = 0; cause < counts.size(); ++cause)
        if (counts[cause] > 0)
            fmt::print("  {:<22} {}\n", reference::causeName(static_cast<reference::Cause>(cause)),
                       counts[cause]);
    return unexplained;
}

void printMetrics(const ImageComparison &comparison, const Image &a, const Image &b) {
    const PixelMetrics &pixels = comparison.pixels;
    fmt::print("pixels       {} of {} differ\n", pixels.differingPixelCount, pixels.pixelCount);
    if (!pixels.identical()) {
        const glm::ivec2 worst = worstPixel(a, b, pixels);
        const glm::vec3 &x = a.at(worst.x, worst.y);
        const glm::vec3 &y = b.at(worst.x, worst.y);
        fmt::print(
            "largest      {} ULP; {:.6g} at ({}, {}): ({:.9g} {:.9g} {:.9g}) and ({:.9g} {:.9g} {:.9g})\n",
            pixels.maxUlpDistance, pixels.maxAbsoluteDifference, worst.x, worst.y, x.x, x.y, x.z, y.x, y.y,
            y.z);
    }
    fmt::print("PSNR         {:.2f} dB\n", pixels.psnrDecibels());
    fmt::print("HDR-FLIP     mean {:.6f}, max {:.6f}\n", comparison.flip.mean, comparison.flip.max);
}

nlohmann::ordered_json divergenceToJson(const glm::uvec2 &pixel,
                                        const std::optional<Divergence> &divergence) {
    nlohmann::ordered_json json;
    json["pixel"] = {pixel.x, pixel.y};
    if (!divergence)
        return json;
    json["sample"] = divergence->sampleIndex;
    json["bounce"] = divergence->rayDepth - 1;
    json["quantity"] = divergence->quantity;
    json["first"] = divergence->valueA;
    json["second"] = divergence->valueB;
    return json;
}

struct Contestants {
    std::unique_ptr<Backend> first;
    std::unique_ptr<Backend> second;
};

Contestants openContestants(const CompareOptions &options, const PreparedScene &scene) {
    const gpu::ProcessorUse processors = processorsFor(options.threads, scene);
    std::unique_ptr<Backend> first =
        openBackend(options.device, processors, batchingFor(options.deviceOptions));
    return {std::move(first),
            openBackend(options.against, processors,
                        isReference(options.against) ? gpu::Batching{} : batchingFor(options.deviceOptions))};
}

void printContestants(const PreparedScene &scene, const Contestants &contestants) {
    fmt::print("scene        {}: {}x{}, {} spp\n", scene.loaded.file.string(), scene.crop.width(),
               scene.crop.height(), scene.loaded.scene.settings.samplesPerPixel);
    fmt::print("first        {}\nsecond       {}\n", contestants.first->description(),
               contestants.second->description());
    for (const Backend *backend : {contestants.first.get(), contestants.second.get()})
        if (!backend->unpromisedBits().empty())
            fmt::print("note         bits are not promised by {}: {}\n", backend->name(),
                       backend->unpromisedBits());
}

/// Two renders with different seeds, as estimates of one picture.
ExitCode runStatisticalCompare(const CompareOptions &options, const std::string &commandLine) {
    requireDistinctFiles({{"--report", options.report}}, {resolveScene(options.scene.scene).string()});
    std::optional<AtomicFile> reportFile;
    if (!options.report.empty())
        reportFile.emplace(options.report);
    PreparedScene scene = prepareScene(options.scene, Source::Dropped, options.isQuiet);
    requireDistinctFiles({{"--report", options.report}}, scene.loaded.inputFiles);
    requireFilmMemory(scene.crop, 4); // two of them become estimates, of about their size
    RenderSettings &settings = scene.loaded.scene.settings;
    const std::uint32_t firstSeed = settings.seed;
    const std::uint32_t secondSeed = options.againstSeed.value_or(firstSeed + 1);
    if (firstSeed == secondSeed)
        throw Error(
            ErrorKind::Usage,
            fmt::format("--against-seed {}: the first render has this seed; name another", secondSeed));
    const Contestants contestants = openContestants(options, scene);
    if (!options.isQuiet) {
        printContestants(scene, contestants);
        fmt::print("seeds        {} and {}\n", firstSeed, secondSeed);
    }
    const auto render = [&](Backend &backend, std::uint32_t seed) {
        settings.seed = scene.packed.frame.seed = seed;
        return estimateOf(renderWithProgress(backend, scene, backend.name(), options.isQuiet).film);
    };
    const Estimate a = render(*contestants.first, firstSeed);
    const Estimate b = render(*contestants.second, secondSeed);
    const ZTestResult result = testAndPrint(a, b, options.zTest, scene.loaded.file.string());
    if (reportFile) {
        settings.seed = scene.packed.frame.seed = firstSeed;
        nlohmann::ordered_json json = provenanceToJson(provenanceOf(scene, commandLine));
        json["first"] = rendererToJson(contestants.first->identity(scene.packed, settings.integrator));
        json["second"] = rendererToJson(contestants.second->identity(scene.packed, settings.integrator));
        json["seeds"] = {firstSeed, secondSeed};
        json["statistical"] = zTestToJson(result, options.zTest);
        json["passed"] = result.isPassed();
        reportFile->write(jsonText(json));
        reportFile->commit();
    }
    return result.isPassed() ? ExitCode::Ok : ExitCode::AnswerIsNo;
}

ExitCode runCompare(const CompareOptions &options, const std::string &commandLine) {
    const Tolerance tolerance = parseTolerance(options.tolerance);
    const std::vector<NamedFile> outputs{{"--diff", options.heatMap}, {"--report", options.report}};
    requireDistinctFiles(outputs, {resolveScene(options.scene.scene).string()});
    std::optional<AtomicFile> heatMapFile;
    std::optional<AtomicFile> reportFile;
    if (!options.heatMap.empty()) {
        if (imageFormatOf(options.heatMap) != ImageFormat::Png)
            throw Error(ErrorKind::Usage, fmt::format("--diff {}: the heat map is a .png", options.heatMap));
        heatMapFile.emplace(options.heatMap);
    }
    if (!options.report.empty())
        reportFile.emplace(options.report);

    const PreparedScene scene = prepareScene(options.scene, Source::Dropped, options.isQuiet);
    requireDistinctFiles(outputs, scene.loaded.inputFiles);
    if (heatMapFile)
        requirePngSize(options.heatMap, scene.crop.width(), scene.crop.height());
    requireFilmMemory(scene.crop, 2);
    const Contestants contestants = openContestants(options, scene);
    Backend *const first = contestants.first.get();
    Backend *const second = contestants.second.get();
    const bool isAgainstOracle = options.against == "cpu-double";
    if (!options.isQuiet)
        printContestants(scene, contestants);
    const BackendResult a = renderWithProgress(*first, scene, first->name(), options.isQuiet);
    const BackendResult b = renderWithProgress(*second, scene, second->name(), options.isQuiet);
    const Image imageA = a.film.toImage();
    const Image imageB = b.film.toImage();
    const ImageComparison comparison = compareImages(imageB, imageA, Encoding::Linear);
    const bool isDefaultTolerance = tolerance.absolute == 0.0 && tolerance.ulps == 0;
    const Pixels outliers = isAgainstOracle && isDefaultTolerance ? findVisibleOutliers(imageA, imageB)
                                                                  : findOutliers(imageA, imageB, tolerance);
    printMetrics(comparison, imageA, imageB);
    const double outlierShare =
        static_cast<double>(outliers.size()) / static_cast<double>(comparison.pixels.pixelCount);
    const bool areCountsEqual = a.rays == b.rays;
    if (isAgainstOracle || !isDefaultTolerance)
        fmt::print("outliers     {} pixels ({:.4f} %) {}\n", outliers.size(), outlierShare * 100.0,
                   isAgainstOracle && isDefaultTolerance ? "by more than 2/255 as a PNG shows them"
                                                         : "beyond the tolerance");

    nlohmann::ordered_json report = nlohmann::ordered_json::object();
    bool isPassed = outlierShare <= options.maxOutliers;
    if (isAgainstOracle) {
        const std::size_t unexplained = explainOutliers(scene, outliers);
        report["unexplainedOutliers"] = unexplained;
        isPassed = isPassed || unexplained == 0;
        fmt::print("{}\n", outliers.empty()   ? "no outliers"
                           : unexplained == 0 ? "every outlier is explained"
                                              : fmt::format("{} outliers are not explained", unexplained));
    } else {
        if (!comparison.pixels.identical()) {
            const glm::uvec2 pixel = imagePixel(scene.crop, worstPixel(imageA, imageB, comparison.pixels));
            const std::optional<Divergence> divergence = findFirstDivergence(*first, *second, scene, pixel);
            printDivergence(pixel, divergence);
            report["divergence"] = divergenceToJson(pixel, divergence);
        }
        if (!areCountsEqual)
            fmt::print("rays         {} and {}: the counts differ\n", a.rays.total(), b.rays.total());
        fmt::print("{}\n", comparison.pixels.identical() ? "equal, bit for bit"
                           : isPassed                    ? "equal within the tolerance"
                                                         : "NOT equal");
    }
    const RenderSettings &settings = scene.loaded.scene.settings;
    nlohmann::ordered_json origin = provenanceToJson(provenanceOf(scene, commandLine));
    origin["first"] = rendererToJson(first->identity(scene.packed, settings.integrator));
    origin["second"] = rendererToJson(second->identity(scene.packed, settings.integrator));
    if (heatMapFile) {
        writePng(*heatMapFile, imageA.width(), imageA.height(), heatMap(comparison.flipMap),
                 attributesOf(origin));
        heatMapFile->commit();
    }
    if (reportFile) {
        nlohmann::ordered_json json = origin;
        json.update(comparisonToJson(comparison, imageB, imageA));
        json["outliers"] = outliers.size();
        json["areRayCountsEqual"] = areCountsEqual;
        json.update(report);
        json["passed"] = isPassed;
        reportFile->write(jsonText(json));
        reportFile->commit();
    }
    return isPassed ? ExitCode::Ok : ExitCode::AnswerIsNo;
}

} // namespace

void addCompareCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command = app.add_subcommand("compare", "render a scene twice and compare the two, to the bit");
    const auto options = std::make_shared<CompareOptions>();
    addSceneOptions(*command, options->scene);
    command->add_option("--device", options->device, "the first renderer: as for `hyalite render`")
        ->type_name("DEVICE")
        ->capture_default_str();
    command
        ->add_option(
            "--against", options->against,
            "the second one: cpu, the twin of the kernels; cpu-double, which tells the error of float32 and "
            "explains every outlier; or another device")
        ->type_name("DEVICE")
        ->capture_default_str();
    command
        ->add_option("--tolerance", options->tolerance,
                     "how far a channel may be off: linear radiance (1e-5) or ULPs (4ulp)")
        ->type_name("DIFFERENCE")
        ->capture_default_str();
    addNumber(*command, "--max-outliers", options->maxOutliers, limits::fraction,
              "share of pixels that may be further off")
        ->default_str("0");
    addThreadsOption(*command, options->threads);
    addDeviceOptions(*command, options->deviceOptions);
    addFile(*command, "--diff", options->heatMap, "FILE.png",
            "write a heat map of the difference (HDR-FLIP)");
    addFile(*command, "--report", options->report, "FILE.json", "write all metrics");
    command->add_flag("--quiet", options->isQuiet, "print the result only");
    CLI::Option *statistical = command->add_flag("--statistical", options->isStatistical,
                                                 "render with two seeds, and ask whether both can be "
                                                 "estimates of one picture, as `hyalite diff` does");
    addSignificanceOption(*command, options->zTest)->needs(statistical);
    addNumber(*command, "--against-seed", options->againstSeed, rangeOf(&RenderSettings::seed),
              "of the second render of --statistical; default: one more than the first's")
        ->needs(statistical);
    for (const char *option : {"--tolerance", "--max-outliers", "--diff"})
        statistical->excludes(command->get_option(option));
    command->callback([options, &context] {
        const auto run = options->isStatistical ? runStatisticalCompare : runCompare;
        context.exitCode = run(*options, context.commandLine);
    });
}

} // namespace hyalite
