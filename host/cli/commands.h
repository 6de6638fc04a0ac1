// Commands: each adds itself to the command line, and runs if the user names it.
#pragma once

#include "host/cli/failure.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace hyalite::core {

/// State that commands share with main().
struct CommandContext {
    std::string commandLine;          ///< as typed, for reports
    std::vector<std::string> words;   ///< of the command line, the program first
    ExitCode exitCode = ExitCode::Ok; ///< what main() returns if nothing is thrown
};

void addRenderCommand(CLI::App &app, CommandContext &context);
void addCompareCommand(CLI::App &app, CommandContext &context);
void addDenoiseCommand(CLI::App &app, CommandContext &context);
void addDevicesCommand(CLI::App &app, CommandContext &context);
void addDoctorCommand(CLI::App &app, CommandContext &context);
void addDiffCommand(CLI::App &app, CommandContext &context);
void addInspectCommand(CLI::App &app, CommandContext &context);
void addMergeCommand(CLI::App &app, CommandContext &context);
void addNewCommand(CLI::App &app, CommandContext &context);
void addProfileCommand(CLI::App &app, CommandContext &context);
void addToneMapCommand(CLI::App &app, CommandContext &context);
void addVerifyCommand(CLI::App &app, CommandContext &context);
void addViewCommand(CLI::App &app, CommandContext &context);

} // namespace hyalite::core
