#include "host/cli/progress.h"

#include "host/base/message.h"
#include "host/base/quantities.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include <unistd.h>

namespace hyalite::core {

namespace {

constexpr double firstPrintSeconds = 0.5;
constexpr double terminalIntervalSeconds = 0.1;
constexpr double logIntervalSeconds = 2.0;
constexpr std::chrono::seconds patience{1};
constexpr int barWidth = 24;

/// The escapes are ours, and pass by what removes those of names.
void redrawLine(const std::string &text) {
    std::fputs("\r\033[K", stderr);
    printMessage("{}", text);
}

} // namespace

std::optional<double> TimeLeft::update(double elapsedSeconds, double share) {
    moments_.push_back({elapsedSeconds, share});
    while (moments_.size() > 2 && moments_[1].elapsedSeconds <= 0.5 * elapsedSeconds)
        moments_.pop_front();
    const double finished = share - moments_.front().share;
    if (!(finished > 0.0))
        return std::nullopt;
    return (1.0 - share) * (elapsedSeconds - moments_.front().elapsedSeconds) / finished;
}

ProgressLine::ProgressLine(std::string task, bool isQuiet)
    : task_(std::move(task)), isQuiet_(isQuiet), isTerminal_(isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
    begin();
    if (isDrawn_)
        redrawLine("");
}

void ProgressLine::expectCompiler() {
    if (isQuiet_)
        return;
    watch_ = std::jthread([this] {
        std::unique_lock lock(mutex_);
        if (begun_.wait_for(lock, patience, [this] { return hasBegun_; }))
            return;
        if (isTerminal_)
            redrawLine(task_ + ": the driver compiles ...");
        else
            printMessage("{}: the driver compiles\n", task_);
        isDrawn_ = isTerminal_;
    });
}

void ProgressLine::begin() {
    if (!watch_.joinable())
        return;
    {
        const std::lock_guard lock(mutex_);
        hasBegun_ = true;
    }
    begun_.notify_one();
    watch_.join();
}

void ProgressLine::update(double share) {
    begin();
    const Clock::time_point now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    if (!std::exchange(isUpdated_, true))
        timeLeft_.begin(elapsed, share);
    const double sinceLast = std::chrono::duration<double>(now - lastPrint_).count();
    if (isQuiet_ || elapsed < firstPrintSeconds ||
        sinceLast < (isTerminal_ ? terminalIntervalSeconds : logIntervalSeconds))
        return;
    lastPrint_ = now;
    const std::optional<double> left = timeLeft_.update(elapsed, share);
    if (isTerminal_) {
        const int filled = static_cast<int>(share * barWidth);
        redrawLine(fmt::format(
            "{} [{:#<{}}{:.<{}}] {:3.0f} %  {} left{}", task_, "", filled, "", barWidth - filled,
            share * 100.0, left ? durationText(*left) : "?",
            noise_ ? fmt::format(", noise {} of {}", percentText(noise_->first), percentText(noise_->second))
                   : ""));
        isDrawn_ = true;
    } else {
        printMessage("task={} progress={:.3f} elapsed_s={:.1f} left_s={}{}\n", task_, share, elapsed,
                     left ? fmt::format("{:.1f}", *left) : "?",
                     noise_ ? fmt::format(" noise={:.4f} wanted_noise={:.4f}", noise_->first, noise_->second)
                            : "");
    }
}

} // namespace hyalite::core
