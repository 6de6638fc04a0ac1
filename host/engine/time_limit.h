// A limit of wall time for renders, which are stopped when it is reached.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

namespace hyalite::core {

/// Starts when it is made.
class TimeLimit {
  public:
    /// Empty: no limit.
    explicit TimeLimit(std::optional<double> seconds = {}) : seconds_(seconds) {}

    /// Seconds that are left, not below 0; empty: no limit. Thread-safe.
    [[nodiscard]] std::optional<double> secondsLeft() const {
        if (!seconds_)
            return std::nullopt;
        return std::max(*seconds_ - std::chrono::duration<double>(Clock::now() - begin_).count(), 0.0);
    }
    /// Thread-safe.
    [[nodiscard]] bool isReached() const { return secondsLeft() == 0.0; }
    /// A limit that starts now, of this share of the time that is left.
    [[nodiscard]] TimeLimit share(double share) const {
        const std::optional<double> left = secondsLeft();
        return TimeLimit(left ? std::optional(*left * share) : std::nullopt);
    }

  private:
    using Clock = std::chrono::steady_clock;

    std::optional<double> seconds_;
    Clock::time_point begin_ = Clock::now();
};

} // namespace hyalite::core
