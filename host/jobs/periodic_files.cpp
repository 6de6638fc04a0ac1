#include "host/jobs/periodic_files.h"

#include <algorithm>
#include <exception>
#include <string>
#include <utility>

namespace hyalite::core {

PeriodicFiles::PeriodicFiles(std::vector<PeriodicFile> files, Observer &observer) : observer_(observer) {
    const Clock::time_point now = Clock::now();
    for (PeriodicFile &file : files) {
        const auto interval = std::chrono::duration<double>(file.intervalSeconds);
        files_.push_back({std::move(file), now + std::chrono::duration_cast<Clock::duration>(interval)});
    }
    if (!files_.empty())
        thread_ = std::thread([this] { run(); });
}

PeriodicFiles::~PeriodicFiles() { finish(); }

void PeriodicFiles::finish() {
    {
        const std::lock_guard lock(mutex_);
        isFinished_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable())
        thread_.join();
}

void PeriodicFiles::take(const std::function<void(Film &)> &copyTo, const RayCounts &rays) {
    {
        const std::lock_guard lock(mutex_);
        copyTo(film_);
        rays_ = rays;
        isWanted_ = false;
        isTaken_ = true;
    }
    changed_.notify_all();
}

PeriodicFiles::Clock::time_point PeriodicFiles::nextDue() const {
    const auto isSooner = [](const Timed &a, const Timed &b) { return a.due < b.due; };
    return std::min_element(files_.begin(), files_.end(), isSooner)->due;
}

void PeriodicFiles::writeNow(Timed &timed, const Film &film, const RayCounts &rays) {
    try {
        timed.file.write(film, rays);
        timed.isFailing = false;
    } catch (const std::exception &error) {
        if (!timed.isFailing) // reported once: the disk may stay full for long
            observer_.note(std::string(error.what()) + "; the render goes on, and this is tried again");
        timed.isFailing = true;
    }
}

void PeriodicFiles::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        if (changed_.wait_until(lock, nextDue(), [this] { return isFinished_; }))
            return;
        isWanted_ = true;
        changed_.wait(lock, [this] { return isTaken_ || isFinished_; });
        if (!isTaken_)
            return;
        isTaken_ = false;
        const Clock::time_point now = Clock::now();
        // Until another film is wanted, this one belongs to this thread.
        lock.unlock();
        for (Timed &timed : files_)
            if (timed.due <= now) {
                const auto interval = std::chrono::duration<double>(timed.file.intervalSeconds);
                timed.due = now + std::chrono::duration_cast<Clock::duration>(interval);
                writeNow(timed, film_, rays_);
            }
        lock.lock();
    }
}

} // namespace hyalite::core
