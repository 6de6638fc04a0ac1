// The progress of a long task, on standard error.
#pragma once

#include <chrono>
#include <string>

namespace hyalite {

/// On a terminal one line that is drawn over and over, with the time left; elsewhere a `key=value` line every few
/// seconds. Prints nothing at all if quiet, nor for tasks that end within half a second.
class ProgressLine {
  public:
    ProgressLine(std::string task, bool isQuiet);
    /// Clears the line.
    ~ProgressLine();
    ProgressLine(const ProgressLine &) = delete;
    ProgressLine &operator=(const ProgressLine &) = delete;

    /// `share` of the work is finished, in [0, 1].
    void update(double share);

  private:
    using Clock = std::chrono::steady_clock;

    std::string task_;
    bool isQuiet_;
    bool isTerminal_;
    bool isDrawn_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point lastPrint_ = start_;
};

/// "12 s", "3 min 05 s", "2 h 10 min".
[[nodiscard]] std::string durationText(double seconds);

} // namespace hyalite
