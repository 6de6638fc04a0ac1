// Error: the exception type of the program, with a message, a kind and a remedy.
//
// A programmer's error is an assert. Wrong input and a failing environment throw `Error`. The message names the
// object, the file (and line) and the size, and is shown to the user unchanged. The command line turns the kind into
// an exit code and the remedy into words about options (host/cli/failure.h).
#pragma once

#include <stdexcept>
#include <string>

namespace hyalite::core {

enum class ErrorKind {
    Usage,            ///< the request contradicts itself
    BadInput,         ///< a scene, mesh or image cannot be used
    NoDevice,         ///< no usable Vulkan device
    LimitExceeded,    ///< not enough memory, or a device limit is too low
    DeviceLost,       ///< the device failed, hung, or computed wrong bits
    OutputNotWritten, ///< an output file could not be written
    HungUp,           ///< SIGHUP, before there was a result
    Interrupted,      ///< SIGINT, likewise
    Terminated,       ///< SIGTERM, likewise
    Internal          ///< a bug of ours; so is every other exception, except for lack of memory or threads
};

/// Remedies. The command line has the words for them.
enum class Remedy {
    None,
    SmallerImage,     ///< or render the image in parts
    SmallerRender,    ///< fewer triangles, parts of the image, or the reference renderer
    ReferenceInstead, ///< the CPU renderer needs no Vulkan
    NoKernelChoice,   ///< let the program choose the kernel
    CompareRenders,   ///< a comparison shows where two renders differ
    OneDevice,        ///< a picture by one device alone has no seams
    BeginAnew,        ///< render with the checkpoint's settings, or without the checkpoint
    AllowPath,        ///< let the scene read files in another folder
    ProfileReport,    ///< a profile writes such a report
    Turntable,        ///< a turntable moves any camera
    DenoisingData     ///< render with the data of the denoiser
};

class Error : public std::runtime_error {
  public:
    Error(ErrorKind errorKind, const std::string &message, Remedy mayHelp = Remedy::None)
        : std::runtime_error(message), kind(errorKind), remedy(mayHelp) {}

    const ErrorKind kind;
    const Remedy remedy;
};

} // namespace hyalite::core
