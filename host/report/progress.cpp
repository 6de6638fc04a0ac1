#include "host/report/progress.h"

#include "host/base/message.h"
#include "host/base/quantities.h"

#include <fmt/format.h>

#include <utility>

#include <unistd.h>

namespace hyalite {

namespace {

constexpr double firstPrintSeconds = 0.5;
constexpr double terminalIntervalSeconds = 0.1;
constexpr double logIntervalSeconds = 2.0;
constexpr int barWidth = 24;

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
    if (isDrawn_)
        printMessage("\r\033[K");
}

void ProgressLine::update(double share) {
    const Clock::time_point now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double sinceLast = std::chrono::duration<double>(now - lastPrint_).count();
    if (isQuiet_ || elapsed < firstPrintSeconds ||
        sinceLast < (isTerminal_ ? terminalIntervalSeconds : logIntervalSeconds))
        return;
    lastPrint_ = now;
    const std::optional<double> left = timeLeft_.update(elapsed, share);
    if (isTerminal_) {
        const int filled = static_cast<int>(share * barWidth);
        printMessage("\r\033[K{} [{:#<{}}{:.<{}}] {:3.0f} %  {} left", task_, "", filled, "",
                     barWidth - filled, share * 100.0, left ? durationText(*left) : "?");
        isDrawn_ = true;
    } else {
        printMessage("task={} progress={:.3f} elapsed_s={:.1f} left_s={}\n", task_, share, elapsed,
                     left ? fmt::format("{:.1f}", *left) : "?");
    }
}

} // namespace hyalite
