// Error: the exception type of the program, with a message, a kind and a remedy.
//
// A programmer's error is an assert. Wrong input and a failing environment throw `Error`: its message names
// the object, the file (and line), the size and the remedy, and is shown to the user as it stands. The command line
// turns kinds into exit codes and remedies into options (host/cli/failure.h).
#pragma once

#include <stdexcept>
#include <string>

namespace hyalite {

enum class ErrorKind {
    Usage,            ///< the request contradicts itself
    BadInput,         ///< a scene, mesh or image cannot be used
    NoDevice,         ///< no usable Vulkan device
    LimitExceeded,    ///< memory or a device limit does not suffice
    DeviceLost,       ///< the device failed or hung while rendering
    OutputNotWritten, ///< a result could not be stored
    HungUp,           ///< SIGHUP, before there was a result
    Interrupted,      ///< SIGINT, likewise
    Terminated,       ///< SIGTERM, likewise
    Internal          ///< a bug of ours; so is every exception that is not an Error
};

/// Remedies. The command line has the words for them.
enum class Remedy {
    None,
    SmallerImage,     ///< or parts of it
    SmallerRender,    ///< fewer triangles, parts of the image, or the reference renderer
    ReferenceInstead, ///< it needs no Vulkan
    NoKernelChoice,   ///< to leave the kernel open
    CompareRenders    ///< it tells where two differ
};

class Error : public std::runtime_error {
  public:
    Error(ErrorKind errorKind, const std::string &message, Remedy mayHelp = Remedy::None)
        : std::runtime_error(message), kind(errorKind), remedy(mayHelp) {}

    const ErrorKind kind;
    const Remedy remedy;
};

} // namespace hyalite
