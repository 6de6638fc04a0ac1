// SIGINT, SIGTERM and SIGHUP as requests to stop, for work whose partial results are worth keeping.
#pragma once

#include "host/base/error.h"

namespace hyalite::core {

/// During its lifetime SIGPIPE is ignored. SIGINT, SIGTERM and SIGHUP end the program at once, by their default action,
/// until there are results to keep: from then on the first one is only recorded, and a second one ends the program. One
/// within `echoSeconds` counts as the same signal, because `timeout` and terminals behind wrappers send each signal
/// twice. Signals that were ignored when the program started, as in background jobs of a script, stay ignored. At most
/// one object exists at a time.
class CaughtSignals {
  public:
    static constexpr double echoSeconds = 0.2;

    /// Unless quiet, the first signal is acknowledged on standard error.
    explicit CaughtSignals(bool isQuiet);
    /// Restores the previous handlers.
    ~CaughtSignals();
    CaughtSignals(const CaughtSignals &) = delete;
    CaughtSignals &operator=(const CaughtSignals &) = delete;

    /// From now on the first signal is only recorded. Thread-safe.
    void keepResults() noexcept;
    /// The number of the first signal, or 0. Thread-safe.
    [[nodiscard]] int first() const noexcept;
};

/// "SIGINT", "SIGTERM" or "SIGHUP".
[[nodiscard]] const char *signalName(int signal);

/// The kind of error of a render that the signal ended.
[[nodiscard]] ErrorKind errorKindOf(int signal);

} // namespace hyalite::core
