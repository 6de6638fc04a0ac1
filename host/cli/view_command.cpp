#include "host/base/message.h"
#include "host/base/shell.h"
#include "host/cli/commands.h"
#include "host/cli/device_options.h"
#include "host/cli/options.h"
#include "host/cli/scene_options.h"
#include "host/cli/terminal_observer.h"
#include "host/process/signals.h"
#include "host/scene/names.h"
#include "host/scene/settings_table.h"
#include "host/view/view_site.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace hyalite::core {

namespace {

using std::chrono::milliseconds;

struct ViewerOptions {
    SceneOptions scene;
    RendererNames devices{"auto"};
    std::string against;
    int threadCount = 0;
    DeviceOptions deviceOptions{{}, 30.0}; ///< short dispatches end soon
    int port = 0;
    std::string listen = "127.0.0.1";
    bool isQuiet = false;
};

/// Of the viewer alone: `render` has no such options.
const std::set<std::string> ofViewer{"--port", "--listen", "--against", "--quiet"};

/// Whether `render` takes this option with the integrator that is shown.
bool hasEffect(const std::string &name, std::optional<Integrator> shown) {
    const auto setting = std::ranges::find(settingsTable, name.substr(2), &Setting::option);
    return !shown || setting == settingsTable.end() || setting->integrators.empty() ||
           std::ranges::find(setting->integrators, *shown) != setting->integrators.end();
}

/// The words of an option as it was given.
std::vector<std::string> wordsOf(const CLI::Option &option) {
    const std::string name = option.get_name();
    std::vector<std::string> words;
    if (option.get_items_expected_max() == 0) {
        words.push_back(option.as<bool>() ? name : name + "=false");
    } else if (option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll &&
               option.get_delimiter() == '\0') {
        for (const std::string &value : option.results())
            words.push_back(fmt::format("{}={}", name, value));
    } else {
        words.push_back(fmt::format("{}={}", name, fmt::join(option.results(), ",")));
    }
    return words;
}

/// The options of the scene and its renderers that `command` was given: their names and words.
std::vector<std::pair<std::string, std::vector<std::string>>> givenOptions(const CLI::App &command) {
    std::vector<std::pair<std::string, std::vector<std::string>>> given;
    for (const CLI::Option *option : command.get_options())
        if (option->nonpositional() && option->count() > 0 && !ofViewer.contains(option->get_name()))
            given.emplace_back(option->get_name(), wordsOf(*option));
    return given;
}

/// Makes the command line that renders a view. `against`: the second renderer.
auto renderCommandOf(const CLI::App &command, const std::string &scene, const std::string &against) {
    return [given = givenOptions(command), scene, against](const ViewToRender &view) {
        std::set<std::string> replaced{"--denoise"};
        std::vector<std::string> added;
        for (const auto &[name, value] : view.changes) {
            replaced.insert("--" + name);
            added.push_back(fmt::format("--{}={}", name, textOf(value)));
        }
        if (view.shown) {
            replaced.insert("--integrator");
            added.push_back(fmt::format("--integrator={}", nameOf(*view.shown)));
        }
        if (view.isDenoised)
            added.emplace_back(*view.isDenoised ? "--denoise" : "--denoise=false");
        if (view.renderer == 1) {
            replaced.insert("--device");
            added.push_back("--device=" + against);
        }
        std::vector<std::string> words{"hyalite", "render", scene};
        for (const auto &[name, own] : given)
            if (!replaced.contains(name) && hasEffect(name, view.shown))
                words.insert(words.end(), own.begin(), own.end());
        words.insert(words.end(), added.begin(), added.end());
        words.insert(words.end(), {"-o", "picture.png"});
        std::vector<const char *> pointers(words.size());
        std::ranges::transform(words, pointers.begin(), &std::string::c_str);
        return shellLine(pointers);
    };
}

void printAddress(const ViewSite &site, const ViewerOptions &options) {
    printResult("{}\n", site.url());
    std::fflush(stdout); // a script waits for it
    if (options.isQuiet)
        return;
    if (options.listen != ViewerOptions().listen)
        printMessage("note: others on the network can read what is sent: it is not encrypted. An ssh tunnel "
                     "(ssh -L {0}:127.0.0.1:{0}) is\n",
                     site.port());
    printMessage("open this address in a browser; Ctrl-C ends the viewer\n");
}

ExitCode runView(const ViewerOptions &options, ViewRequest request) {
    if (request.renderers.size() == 2 && request.renderers[0] == request.renderers[1])
        throw Error(
            ErrorKind::Usage,
            fmt::format("--against: found {}, as --device; allowed: another renderer", options.against));
    TerminalObserver observer(options.isQuiet);
    Viewer viewer(std::move(request), observer);
    ViewSite site(viewer, options.listen, options.port);
    CaughtSignals signals(true);
    signals.keepResults();
    printAddress(site, options);
    while (signals.first() == 0)
        std::this_thread::sleep_for(milliseconds(50));
    const ExitCode code = exitCodeOf(errorKindOf(signals.first()));
    const bool haveEnded = viewer.stop(milliseconds(600));
    site.stop();
    if (!haveEnded) // a driver is compiling, which nothing interrupts, and there is nothing to lose
        std::_Exit(static_cast<int>(code));
    return code;
}

} // namespace

void addViewCommand(CLI::App &app, CommandContext &context) {
    CLI::App *command = app.add_subcommand("view", "look at a scene in a browser, and move its camera");
    const auto options = std::make_shared<ViewerOptions>();
    command->footer("Prints an address, with a key in it. The page renders the scene better and better, and "
                    "offers the view as a "
                    "picture, a scene file and a command line. Files of the scene that change are read "
                    "again. The viewer writes no "
                    "file, and listens to this machine alone. From another one: ssh -L PORT:127.0.0.1:PORT, "
                    "and --port PORT.");
    addSceneOptions(*command, options->scene);
    addDevicesOption(*command, options->devices, "as for `hyalite render`");
    addWord(*command, "--against", options->against, "a renderer", "DEVICE",
            "a second renderer, such as cpu, whose pictures are shown beside and compared bit by bit");
    addThreadsOption(*command, options->threadCount);
    addDeviceOptions(*command, options->deviceOptions);
    addNumber(*command, "--port", options->port, {0, 65535}, "the port of the page; 0: any that is free")
        ->capture_default_str();
    addWord(*command, "--listen", options->listen, "an address of this machine", "ADDRESS",
            "where it listens: 0.0.0.0 lets other machines in, unencrypted, if they know the key")
        ->capture_default_str();
    command->add_flag("--quiet", options->isQuiet, "print the address and errors only");
    command->callback([options, command, &context] {
        ViewRequest request{.scene = options->scene,
                            .renderers = {options->devices},
                            .threadCount = options->threadCount,
                            .deviceOptions = options->deviceOptions,
                            .commandLine = context.commandLine,
                            .renderCommand =
                                renderCommandOf(*command, options->scene.scene, options->against)};
        if (!options->against.empty())
            request.renderers.push_back({options->against});
        context.exitCode = runView(*options, std::move(request));
    });
}

} // namespace hyalite::core
