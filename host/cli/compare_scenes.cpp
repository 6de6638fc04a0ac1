#include "host/base/message.h"
#include "host/base/standard_stream.h"
#include "host/cli/compare_options.h"
#include "host/cli/options.h"
#include "host/cli/requested_file.h"
#include "host/import/assets.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <span>
#include <utility>

namespace hyalite::core {

namespace {

/// Throws Error{Usage} for files that are of one scene.
void requireFilesOfSeveral(const CompareOptions &options) {
    for (const auto &[option, path] :
         {std::pair("--diff", &options.heatMap), std::pair("--report", &options.report)})
        if (!path->empty())
            throw Error(ErrorKind::Usage, fmt::format("{}: found {} scenes; allowed: for one", option,
                                                      options.moreScenes.size() + 1));
    if (isStandardStream(options.html))
        throw Error(ErrorKind::Usage, "--html: found several scenes, whose pages are beside their index; "
                                      "allowed: the name of a file");
}

/// "index-2-cornell.html" for the second scene of "index.html".
std::string pageBeside(const std::filesystem::path &index, std::size_t number, const std::string &scene) {
    const std::string name = fmt::format("{}-{}-{}.html", index.stem().string(), number,
                                         std::filesystem::path(scene).stem().string());
    return (index.parent_path() / name).string();
}

/// What is wrong with a scene is printed, and ends neither other comparisons nor their reports.
std::pair<ComparedScene, ExitCode> compareOne(const CompareOptions &options, const std::string &commandLine) {
    try {
        ComparedScene compared = compareScene(options, commandLine);
        compared.row.page = std::filesystem::path(options.html).filename().string();
        return {compared, compared.row.isPassed ? ExitCode::Ok : ExitCode::AnswerIsNo};
    } catch (const Error &error) {
        const bool isOfScene = dynamic_cast<const OverrideError *>(&error) != nullptr;
        if (error.kind == ErrorKind::Usage && !isOfScene)
            throw; // it is wrong for all
        const Failure failure = describeFailure(std::current_exception(), commandLine);
        printMessage("hyalite: {}\n", failure.message);
        const std::string group = "hyalite compare";
        return {{{group, {{group, options.scene.scene, 0.0, failure.message}}},
                 {.title = options.scene.scene, .verdict = failure.message}},
                failure.code};
    }
}

ExitCode compareSeveral(const CompareOptions &options, const std::string &commandLine) {
    requireFilesOfSeveral(options);
    std::vector<std::string> scenes{options.scene.scene};
    scenes.insert(scenes.end(), options.moreScenes.begin(), options.moreScenes.end());
    std::vector<std::string> inputs;
    std::ranges::transform(scenes, std::back_inserter(inputs),
                           [](const std::string &scene) { return resolveScene(scene).string(); });
    requireDistinctFiles({{"--html", options.html}, {"--junit", options.junit}}, inputs);
    RequestedFile index(options.html);
    RequestedFile junit(options.junit);
    std::vector<TestSuite> suites;
    std::vector<IndexedComparison> rows;
    ExitCode code = ExitCode::Ok; // of the first error; without one, whether all passed
    for (const std::string &scene : scenes) {
        CompareOptions one = options;
        one.scene.scene = scene;
        if (index)
            one.html = pageBeside(options.html, rows.size() + 1, scene);
        if (options.isQuiet)
            printResult("scene        {}\n", scene); // which else nothing names
        auto [compared, ofScene] = compareOne(one, commandLine);
        if (code <= ExitCode::AnswerIsNo)
            code = std::max(code, ofScene);
        suites.push_back(std::move(compared.suite));
        rows.push_back(std::move(compared.row));
    }
    if (index)
        index.store(comparisonIndexHtml(rows));
    if (junit)
        junit.store(comparisonsToJunit(suites));
    printResult("{} of {} scenes passed\n", std::ranges::count(rows, true, &IndexedComparison::isPassed),
                rows.size());
    return code;
}

} // namespace

ExitCode runCompare(const CompareOptions &options, const std::string &commandLine) {
    if (!options.moreScenes.empty())
        return compareSeveral(options, commandLine);
    RequestedFile junit(options.junit);
    const auto [compared, code] = compareOne(options, commandLine);
    if (junit)
        junit.store(comparisonsToJunit(std::span(&compared.suite, 1)));
    return code;
}

} // namespace hyalite::core
