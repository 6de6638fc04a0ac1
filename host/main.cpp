// The program's entry: the standard streams, the command line, the one catch, and the exit code.
#include "host/base/json_reader.h"
#include "host/base/message.h"
#include "host/base/shell.h"
#include "host/base/version.h"
#include "host/cli/commands.h"
#include "host/cli/failure.h"
#include "host/cli/help_formatter.h"
#include "host/cli/manual.h"
#include "host/gpu/vk/instance.h"
#include "host/import/assets.h"
#include "host/process/bundled_driver.h"
#include "host/process/process.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <span>
#include <sstream>
#include <vector>

#include <fcntl.h>
#include <omp.h>
#include <unistd.h>

namespace {

using namespace hyalite::core;

/// A file that is opened takes the lowest free descriptor. If that of a stream were free, messages would end up in an
/// image.
void openMissingStreams() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(descriptor, F_GETFD) == -1 && errno == EBADF && open("/dev/null", O_RDWR) != descriptor)
            std::_Exit(static_cast<int>(ExitCode::OutputNotWritten)); // and there is nowhere to say why
}

bool hasEnded = false;

/// Libraries may end the program on their own: OpenMP does, with the code of a wrong answer, where it cannot start its
/// threads.
void explainEndByLibrary() {
    if (hasEnded)
        return;
    printMessage("hyalite: a library ended the program, as OpenMP does if it cannot start its threads; lower "
                 "OMP_NUM_THREADS and OMP_STACKSIZE, or raise the limits (ulimit -u, ulimit -v)\n");
    std::_Exit(static_cast<int>(ExitCode::LimitExceeded));
}

/// Throws Error{Usage} for more threads than OpenMP survives: it keeps them on the stack.
void requireThreadCount() {
    constexpr int maxThreads = 4096;
    if (const int count = omp_get_max_threads(); count > maxThreads)
        throw Error(ErrorKind::Usage,
                    fmt::format("OMP_NUM_THREADS: found {}; allowed: a whole number from 1 to {}", count,
                                maxThreads));
}

/// Flushes the standard output: a run whose results are lost is no success.
ExitCode finishOutput(ExitCode code) {
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0)
        return code;
    if (code != ExitCode::Ok && code != ExitCode::AnswerIsNo)
        return code;
    printMessage("hyalite: cannot write to standard output: the output is incomplete\n");
    return ExitCode::OutputNotWritten;
}

std::vector<std::string> commandNames(const CLI::App &app) {
    std::vector<std::string> names;
    for (const CLI::App *command : app.get_subcommands({}))
        names.push_back(command->get_name());
    return names;
}

std::vector<std::string> optionNames(const CLI::App &command) {
    std::vector<std::string> names;
    for (const CLI::Option *option : command.get_options())
        names.push_back(option->get_name());
    return names;
}

std::string suggestionFor(const std::string &word, const std::vector<std::string> &names) {
    const std::vector<std::string_view> candidates(names.begin(), names.end());
    return suggestion(word, candidates);
}

/// The option of one value that is given more than once, or null.
const CLI::Option *repeatedOption(const CLI::App &command) {
    for (const CLI::Option *option : command.get_options())
        if (option->nonpositional() && option->get_items_expected_max() == 1 &&
            option->results().size() > 1 &&
            option->get_multi_option_policy() == CLI::MultiOptionPolicy::Throw)
            return option;
    return nullptr;
}

/// `hyalite help render` as `hyalite render --help`. A word that is no command stays, to be refused.
std::vector<char *> withoutHelpCommand(std::span<char *> arguments, const CLI::App &app) {
    static char helpFlag[] = "--help";
    std::vector<char *> words(arguments.begin(), arguments.end());
    if (words.size() < 2 || std::string_view(words[1]) != "help")
        return words;
    words.erase(words.begin() + 1);
    const std::vector<std::string> names = commandNames(app);
    const bool isCommand = words.size() > 1 && std::ranges::find(names, words[1]) != names.end();
    if (words.size() == 1 || isCommand)
        words.push_back(helpFlag);
    return words;
}

/// Why the command line cannot be parsed.
std::string describeMistake(const CLI::App &app, const CLI::ParseError &error) {
    if (app.get_subcommands().empty()) {
        const std::vector<std::string> unknown = app.remaining();
        if (unknown.empty())
            return fmt::format("no command given\n\n{}", app.help());
        const std::vector<std::string> names = commandNames(app);
        return fmt::format("there is no command \"{}\"; the commands are {}{}\n", unknown.front(),
                           fmt::join(names, ", "), suggestionFor(unknown.front(), names));
    }
    const CLI::App &command = *app.get_subcommands().front();
    const std::vector<std::string> unknown = command.remaining();
    const CLI::Option *const repeated = repeatedOption(command);
    const std::string mistake =
        repeated != nullptr ? fmt::format("{} is given {}", repeated->get_name(),
                                          repeated->results().size() == 2 ? "twice" : "more than once")
        : unknown.empty()   ? error.what()
                            : fmt::format("\"{}\" is not expected{}", unknown.front(),
                                          suggestionFor(unknown.front(), optionNames(command)));
    return fmt::format("{}\n`hyalite {} --help` lists the options\n", mistake, command.get_name());
}

ExitCode run(std::span<char *> arguments, CommandContext &context) {
    CLI::App app(
        "Hyalite renders scenes on any Vulkan device, with compute shaders whose every pixel can be checked "
        "against a reference renderer on the CPU.",
        "hyalite");
    app.require_subcommand(1);
    app.set_help_flag("-h,--help", "print this page");
    app.formatter(std::make_shared<HelpFormatter>());
    addRenderCommand(app, context);
    addViewCommand(app, context);
    addMergeCommand(app, context);
    addCompareCommand(app, context);
    addVerifyCommand(app, context);
    addProfileCommand(app, context);
    addDevicesCommand(app, context);
    addDoctorCommand(app, context);
    addInspectCommand(app, context);
    addDiffCommand(app, context);
    addToneMapCommand(app, context);
    addDenoiseCommand(app, context);
    addNewCommand(app, context);
    // After the commands, which would take it over.
    app.footer("`hyalite COMMAND --help`, or `hyalite help COMMAND`, explains a command. Exit codes: 0 ok, 1 "
               "the answer is no, 2 usage, 3 bad "
               "input, 4 no usable device, 5 memory or device limit, 6 device lost, 7 output not written, "
               "70 internal error, 129, 130 and 143 stopped by SIGHUP, SIGINT and SIGTERM.");
    app.set_version_flag("--version", "hyalite " HYALITE_VERSION, "print the version");
    for (CLI::App *command : app.get_subcommands([](const CLI::App *) { return true; }))
        command->set_version_flag("--version", "hyalite " HYALITE_VERSION)->group("");
    // For the build, which installs what they print.
    app.add_flag_callback("--manual-page",
                          [&app] {
                              fmt::print("{}", manualPage(app));
                              throw CLI::Success();
                          })
        ->trigger_on_parse() // before CLI11 from 2.5 on demands a command
        ->group("");
    app.add_flag_callback("--bash-completion",
                          [&app] {
                              fmt::print("{}", bashCompletion(app));
                              throw CLI::Success();
                          })
        ->trigger_on_parse() // before CLI11 from 2.5 on demands a command
        ->group("");
    // For that completion.
    app.add_flag_callback("--scene-names",
                          [] {
                              fmt::print("{}\n", fmt::join(availableScenes(), "\n"));
                              throw CLI::Success();
                          })
        ->trigger_on_parse() // before CLI11 from 2.5 on demands a command
        ->group("");
    app.parse_complete_callback([] { // of a command that runs
        requireThreadCount();
        offerBundledDriver();
    });
    try {
        std::vector<char *> words = withoutHelpCommand(arguments, app);
        app.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::Success &request) { // of --help or --version
        std::ostringstream page;
        app.exit(request, page);
        fmt::print("{}", page.str());
        return ExitCode::Ok;
    } catch (const CLI::ParseError &error) {
        printMessage("hyalite: {}", describeMistake(app, error));
        return ExitCode::Usage;
    }
    return context.exitCode;
}

ExitCode runAndReport(std::span<char *> arguments) {
    CommandContext context;
    context.commandLine = shellLine(arguments);
    context.words.assign(arguments.begin(), arguments.end());
    try {
        return run(arguments, context);
    } catch (...) {
        const Failure failure = describeFailure(std::current_exception(), context.commandLine);
        if (failure.code == ExitCode::Internal && std::ferror(stdout) != 0) // fmt::print throws
            return ExitCode::Ok;                                            // which finishOutput corrects
        printMessage("hyalite: {}\n", failure.message);
        return failure.code;
    }
}

} // namespace

int main(int argumentCount, char **arguments) {
    prepareProcess();
    gpu::onValidationMessage = [](const char *message) { printMessage("validation: {}\n", message); };
    openMissingStreams();
    // A file beyond the shell's limit is an error of its own, as one on a full disk is.
    std::signal(SIGXFSZ, SIG_IGN);
    std::atexit(explainEndByLibrary);
    const ExitCode code = finishOutput(runAndReport({arguments, static_cast<std::size_t>(argumentCount)}));
    hasEnded = true;
    return static_cast<int>(code);
}
