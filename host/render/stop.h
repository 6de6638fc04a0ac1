// SIGINT, SIGTERM and SIGHUP as a wish to stop, for work whose results so far are worth keeping.
#pragma once

#include "host/base/error.h"

namespace hyalite {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP is only noted, and SIGPIPE is ignored. Another wish to stop ends
/// the program at once, as if none of this existed; one that follows within `echoSeconds` is taken for the same, since
/// `timeout` and terminals behind wrappers send each signal twice. A signal that the program was started to ignore, as
/// in the background of a script, stays ignored.
/// At most one of them lives at a time.
class CaughtSignals {
  public:
    static constexpr double echoSeconds = 0.2;

    /// Unless quiet, the first signal is answered on standard error.
    explicit CaughtSignals(bool isQuiet);
    /// Puts back what was there before.
    ~CaughtSignals();
    CaughtSignals(const CaughtSignals &) = delete;
    CaughtSignals &operator=(const CaughtSignals &) = delete;

    /// The number of the signal that came first, or 0. From any thread.
    [[nodiscard]] int first() const noexcept;
};

/// "SIGINT", "SIGTERM" or "SIGHUP".
[[nodiscard]] const char *signalName(int signal);

/// What a render is that the signal ended.
[[nodiscard]] ErrorKind errorKindOf(int signal);

} // namespace hyalite
