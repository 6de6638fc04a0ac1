// Files that are written again and again while a render runs.
#pragma once

#include "host/film/continuation.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace hyalite {

/// Something that is written at intervals, after the end of the last time that it was begun.
struct PeriodicFile {
    double intervalSeconds;
    /// Called by a thread of its own. Throws Error where it fails: this is told, and the render goes on.
    std::function<void(const Film &film, const RayCounts &rays)> write;
};

/// Writes them beside the render, which only waits for its film to be copied. Where writing takes longer than the
/// interval, the next time is left out.
class PeriodicFiles : public SnapshotTaker {
  public:
    /// `crop` is the film's. The first interval begins now.
    PeriodicFiles(const Crop &crop, std::vector<PeriodicFile> files);
    /// As finish().
    ~PeriodicFiles() override;

    /// Ends the last writing and begins none. The render is over.
    void finish();

    [[nodiscard]] bool isWanted() const noexcept override {
        return isWanted_.load(std::memory_order_relaxed);
    }
    void take(const std::function<void(std::span<layout::FilmPixel>)> &copyFilm,
              const RayCounts &rays) override;

  private:
    using Clock = std::chrono::steady_clock;

    struct Timed {
        PeriodicFile file;
        Clock::time_point due;
        bool isFailing = false;
    };

    void run();
    [[nodiscard]] Clock::time_point nextDue() const;
    static void writeNow(Timed &timed, const Film &film, const RayCounts &rays);

    Crop crop_;
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

} // namespace hyalite
