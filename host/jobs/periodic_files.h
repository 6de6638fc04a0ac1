// Files that are written periodically during a render.
#pragma once

#include "host/engine/observer.h"
#include "host/film/render_hooks.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace hyalite::core {

/// A file that is written at intervals.
struct PeriodicFile {
    double intervalSeconds;
    /// Called by a thread of its own. If it throws Error, the observer gets a note, and the render goes on.
    std::function<void(const Film &film, const RayCounts &rays)> write;
};

/// Writes the files in a thread of its own; the render waits only for copies of its film. If writing takes longer than
/// the interval, the next time is skipped.
class PeriodicFiles : public SnapshotTaker {
  public:
    /// The first interval begins now. `observer` must outlive it.
    PeriodicFiles(std::vector<PeriodicFile> files, Observer &observer);
    /// As finish().
    ~PeriodicFiles() override;

    /// Waits for the last write and starts no other. Call it after the render.
    void finish();

    [[nodiscard]] bool isWanted() const noexcept override {
        return isWanted_.load(std::memory_order_relaxed);
    }
    void take(const std::function<void(Film &)> &copyTo, const RayCounts &rays) override;

  private:
    using Clock = std::chrono::steady_clock;

    struct Timed {
        PeriodicFile file;
        Clock::time_point due;
        bool isFailing = false;
    };

    void run();
    [[nodiscard]] Clock::time_point nextDue() const;
    void writeNow(Timed &timed, const Film &film, const RayCounts &rays);

    Observer &observer_;
    std::vector<Timed> files_; ///< touched by the writing thread alone
    Film film_{Crop{}};        ///< of the last snapshot; empty until there is one
    RayCounts rays_;
    std::atomic<bool> isWanted_ = false;
    bool isTaken_ = false;
    bool isFinished_ = false;
    std::mutex mutex_; ///< of both, and of the film until it is taken
    std::condition_variable changed_;
    std::thread thread_; ///< last: it uses the others
};

} // namespace hyalite::core
