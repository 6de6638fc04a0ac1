#include "host/base/json_text.h"
#include "host/base/message.h"
#include "host/cli/compare_options.h"
#include "host/cli/options.h"
#include "host/cli/requested_file.h"
#include "host/cli/statistical.h"
#include "host/cli/terminal_observer.h"
#include "host/film/timeline.h"
#include "host/import/assets.h"

#include <fmt/format.h>

#include <span>
#include <vector>

namespace hyalite::core {

namespace {

/// The seed of the second render, which must differ from the first.
std::uint32_t secondSeedOf(const CompareOptions &options, std::uint32_t firstSeed) {
    const std::uint32_t secondSeed = options.againstSeed.value_or(firstSeed + 1);
    if (firstSeed == secondSeed)
        throw Error(
            ErrorKind::Usage,
            fmt::format("--against-seed {}: the first render has this seed; name another", secondSeed));
    return secondSeed;
}

} // namespace

ExitCode runStatisticalCompare(const CompareOptions &options, const std::string &commandLine) {
    if (!options.moreScenes.empty())
        throw Error(ErrorKind::Usage, fmt::format("--statistical: found {} scenes; allowed: for one",
                                                  options.moreScenes.size() + 1));
    const std::vector<NamedFile> outputs{{"--report", options.report}, {"--junit", options.junit}};
    requireDistinctFiles(outputs, {resolveScene(options.scene.scene).string()});
    RequestedFile reportFile(options.report);
    RequestedFile junitFile(options.junit);
    TerminalObserver observer(options.isQuiet);
    const PreparedScene scene = prepareScene(options.scene, Source::Dropped, observer);
    requireDistinctFiles(outputs, scene.loaded.inputFiles);
    requireFilmMemory(scene.crop, 4); // two films, and two estimates of about the same size
    const std::uint32_t firstSeed = scene.loaded.settings.seed;
    const std::uint32_t secondSeed = secondSeedOf(options, firstSeed);
    const ComparisonRun run = openComparison(options.comparison, scene, observer);
    if (!options.isQuiet) {
        printRenderers(scene, run);
        printResult("seeds        {} and {}\n", firstSeed, secondSeed);
    }
    Stopwatch watch;
    const auto estimate = [&](Backend &backend, std::uint32_t seed) {
        RenderSettings settings = scene.loaded.settings;
        settings.seed = seed;
        return estimateOf(unlessFailed(render(backend, scene.packed, settings, scene.crop, observer,
                                              {.name = backend.name()}))
                              .film);
    };
    const Estimate a = estimate(*run.first, firstSeed);
    const Estimate b = estimate(*run.second, secondSeed);
    const WelchResult result = testAndPrint(a, b, options.welch, scene.loaded.file.string());
    if (reportFile) {
        nlohmann::ordered_json json = comparisonRunToJson(run, scene, commandLine);
        json["seeds"] = {firstSeed, secondSeed};
        json["statistical"] = welchToJson(result, options.welch);
        json["passed"] = result.isPassed();
        reportFile.store(jsonText(json));
    }
    if (junitFile) {
        const TestSuite suite = comparisonSuite(run, scene, watch.lap().seconds(), failureOf(result));
        junitFile.store(comparisonsToJunit(std::span(&suite, 1)));
    }
    return result.isPassed() ? ExitCode::Ok : ExitCode::AnswerIsNo;
}

} // namespace hyalite::core
