// Progress of a long task, on standard error.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace hyalite::core {

/// Estimate of the remaining time, by the speed during the second half of the time so far: parts of an image differ in
/// cost, and recent ones predict the next ones best.
class TimeLeft {
  public:
    /// Starts at a moment: what was finished before it, while files were read or a driver compiled, says nothing of
    /// speed.
    void begin(double elapsedSeconds, double share) { moments_ = {{elapsedSeconds, share}}; }

    /// In seconds, after `elapsedSeconds` in which `share` of the work was finished. Both never decrease. Empty if
    /// no work was finished recently.
    [[nodiscard]] std::optional<double> update(double elapsedSeconds, double share);

  private:
    struct Moment {
        double elapsedSeconds;
        double share;
    };
    std::deque<Moment> moments_{{0.0, 0.0}}; ///< the first one begins the half
};

/// On a terminal, one line that is redrawn, with the remaining time; elsewhere a `key=value` line every few seconds.
/// Prints nothing if quiet, or for tasks that end within half a second.
class ProgressLine {
  public:
    ProgressLine(std::string task, bool isQuiet);
    /// Clears the line.
    ~ProgressLine();
    ProgressLine(const ProgressLine &) = delete;
    ProgressLine &operator=(const ProgressLine &) = delete;

    /// Unless update() is called within a second, says that a driver compiles: it may for long, and tells nobody.
    void expectCompiler();
    /// `share` of the work is finished, in [0, 1].
    void update(double share);
    /// The noise that a render has reached, and what it is to be.
    void setNoise(double reached, double wanted) { noise_ = {reached, wanted}; }

  private:
    using Clock = std::chrono::steady_clock;

    /// The work itself has begun: stops watching.
    void begin();

    std::string task_;
    bool isQuiet_;
    bool isTerminal_;
    bool isDrawn_ = false;
    bool isUpdated_ = false;
    std::optional<std::pair<double, double>> noise_; ///< reached and wanted
    TimeLeft timeLeft_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point lastPrint_ = start_;
    std::mutex mutex_; ///< of what follows
    std::condition_variable begun_;
    bool hasBegun_ = false;
    std::jthread watch_; ///< until it has begun
};

} // namespace hyalite::core
