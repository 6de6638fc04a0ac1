// The one exception type of the program, and the exit codes that it carries to main().
//
// A programmer's error is an assert. Wrong input and a failing environment throw `Error`: its message names
// the object, the file (and line), the size and the remedy, and is shown to the user as it stands.
#pragma once

#include <stdexcept>
#include <string>

namespace hyalite {

/// Exit codes of every command.
enum class ExitCode : int {
    Ok = 0,
    AnswerIsNo = 1,       ///< images differ, a gate or a baseline failed
    Usage = 2,            ///< the command line is wrong
    BadInput = 3,         ///< a scene, mesh or image cannot be used
    NoDevice = 4,         ///< no usable Vulkan device
    LimitExceeded = 5,    ///< memory or a device limit does not suffice
    DeviceLost = 6,       ///< the device failed or hung while rendering
    OutputNotWritten = 7, ///< a result could not be stored
    HungUp = 129,         ///< SIGHUP
    Interrupted = 130,    ///< SIGINT
    Terminated = 143,     ///< SIGTERM
};

class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string &message) : std::runtime_error(message), exitCode(code) {}

    const ExitCode exitCode;
};

} // namespace hyalite
