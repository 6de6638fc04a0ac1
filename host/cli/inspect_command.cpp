#include "host/base/clean_text.h"
#include "host/base/json_text.h"
#include "host/cli/commands.h"
#include "host/cli/inspect_scene.h"
#include "host/cli/options.h"
#include "host/cli/scene_options.h"
#include "host/cli/terminal_observer.h"
#include "host/lab/scene_summary_json.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

namespace hyalite::core {

namespace {

struct InspectOptions {
    SceneOptions scene;
    std::optional<int> rayCount;
    bool isJson = false;
    bool hasCoverage = false;
};

ExitCode runInspect(const InspectOptions &options, const std::string &commandLine) {
    TerminalObserver observer(false);
    const PreparedScene prepared = prepareScene(options.scene, Source::Kept, observer);
    const SceneSummary summary = summariseScene(prepared);
    if (!options.isJson)
        printSummary(summary);
    std::optional<Coverage> coverage;
    if (options.hasCoverage)
        coverage = measureCoverage(prepared);
    if (coverage && !options.isJson)
        printCoverage(*coverage);
    std::optional<TreeCheck> check;
    if (options.rayCount)
        check = checkTree(prepared, *options.rayCount);
    if (check && !options.isJson)
        printTreeCheck(*check);
    if (options.isJson)
        fmt::print("{}", cleanText(jsonText(sceneToJson(summary, coverage, check, commandLine))));
    const bool isFaulty = summary.tree && !summary.tree->fault.empty();
    return isFaulty || (check && check->differenceCount > 0) ? ExitCode::AnswerIsNo : ExitCode::Ok;
}

} // namespace

void addInspectCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command = app.add_subcommand("inspect", "print the contents of a scene or mesh, and its tree");
    const auto options = std::make_shared<InspectOptions>();
    addSceneOptions(*command, options->scene);
    addNumber(*command, "--rays", options->rayCount, limits::inspectedRays,
              "trace this many primary rays through the tree and by brute force; compare hits and times");
    command->add_flag(
        "--coverage", options->hasCoverage,
        "trace a ray through the centre of each pixel, and tell which objects and materials cover "
        "which share of the picture");
    command->add_flag("--json", options->isJson, "print JSON");
    command->callback([options, &context] { context.exitCode = runInspect(*options, context.commandLine); });
}

} // namespace hyalite::core
