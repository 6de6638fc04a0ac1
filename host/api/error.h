// Errors: the one exception type of the library. What callbacks throw passes through unchanged.
#pragma once

#include "hyalite/version.h"

#include <stdexcept>
#include <string>

namespace hyalite {

enum class ErrorKind {
    Usage,            ///< a setting or an argument that is not allowed, or that contradicts another
    BadInput,         ///< a scene, mesh or image cannot be used
    NoDevice,         ///< no usable Vulkan device
    LimitExceeded,    ///< not enough memory, or a device limit is too low
    DeviceLost,       ///< the device failed, hung, or computed wrong bits
    OutputNotWritten, ///< a file could not be written
    Stopped,          ///< a callback wanted a stop before there was a result
    Internal          ///< a bug of Hyalite
};

/// "usage", "bad input", ...: the kind in words.
[[nodiscard]] HYALITE_API const char *toText(ErrorKind kind) noexcept;

/// Its message names the object, what was found, what is allowed and the remedy.
class HYALITE_API Error : public std::runtime_error {
  public:
    Error(ErrorKind kind, const std::string &message);
    ~Error() override;

    [[nodiscard]] ErrorKind kind() const noexcept { return kind_; }

  private:
    ErrorKind kind_;
};

} // namespace hyalite
