// Failures: their exit codes and messages.
#pragma once

#include "host/base/error.h"

#include <exception>
#include <string>

namespace hyalite::core {

/// Exit codes of every command.
enum class ExitCode : int {
    Ok = 0,
    AnswerIsNo = 1, ///< images differ, a gate or a baseline failed
    Usage = 2,
    BadInput = 3,
    NoDevice = 4,
    LimitExceeded = 5,
    DeviceLost = 6,
    OutputNotWritten = 7,
    Internal = 70, ///< a bug of ours: EX_SOFTWARE of sysexits.h
    HungUp = 129,
    Interrupted = 130,
    Terminated = 143
};

[[nodiscard]] ExitCode exitCodeOf(ErrorKind kind);

/// The end of a command that threw.
struct Failure {
    ExitCode code;
    std::string message; ///< for standard error, behind the program's name
};

/// `commandLine` is for bug reports.
[[nodiscard]] Failure describeFailure(const std::exception_ptr &failure, const std::string &commandLine);

} // namespace hyalite::core
