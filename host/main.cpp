// The program's entry: the command line, the one catch, and the exit code.
#include "host/cli/commands.h"
#include "host/cli/help_formatter.h"
#include "host/error.h"
#include "host/version.h"

#include <fmt/format.h>

#include <exception>
#include <memory>
#include <new>

namespace {

/// As it was typed, with quotes where a shell needs them.
std::string joinArguments(int count, char **arguments) {
    std::string line;
    for (int i = 0; i < count; ++i) {
        const std::string argument = arguments[i];
        const bool isPlain =
            !argument.empty() && argument.find_first_of(" \t\n\"'\\$*?;&|<>()") == std::string::npos;
        line += (i > 0 ? " " : "") + (isPlain ? argument : "'" + argument + "'");
    }
    return line;
}

int run(int argumentCount, char **arguments) {
    using namespace hyalite;
    CLI::App app(
        "Hyalite renders scenes on any Vulkan device, with compute shaders whose every pixel can be checked "
        "against a reference renderer on the CPU.",
        "hyalite");
    app.set_version_flag("--version", "hyalite " HYALITE_VERSION);
    app.require_subcommand(1);
    app.formatter(std::make_shared<HelpFormatter>());
    app.footer(
        "`hyalite COMMAND --help` explains a command. Exit codes: 0 ok, 1 the answer is no, 2 usage, 3 bad "
        "input,\n4 no usable device, 5 memory or device limit, 6 device lost, 7 output not written.");
    CommandContext context;
    context.commandLine = joinArguments(argumentCount, arguments);
    addRenderCommand(app, context);
    addCompareCommand(app, context);
    addDevicesCommand(app, context);
    addInspectCommand(app, context);
    addDiffCommand(app, context);
    try {
        app.parse(argumentCount, arguments);
    } catch (const CLI::ParseError &error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::Usage);
    }
    return context.exitCode;
}

} // namespace

int main(int argumentCount, char **arguments) {
    using hyalite::ExitCode;
    try {
        return run(argumentCount, arguments);
    } catch (const hyalite::Error &error) {
        fmt::print(stderr, "hyalite: {}\n", error.what());
        return static_cast<int>(error.exitCode);
    } catch (const std::bad_alloc &) {
        fmt::print(stderr, "hyalite: out of memory\n");
        return static_cast<int>(ExitCode::LimitExceeded);
    } catch (const std::exception &error) {
        fmt::print(stderr, "hyalite: internal error: {}\n", error.what());
        return static_cast<int>(ExitCode::BadInput);
    }
}
