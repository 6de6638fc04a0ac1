#include "host/report/progress.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <utility>

#include <unistd.h>

namespace hyalite {

namespace {

constexpr double firstPrintSeconds = 0.5;
constexpr double terminalIntervalSeconds = 0.1;
constexpr double logIntervalSeconds = 2.0;
constexpr int barWidth = 24;

} // namespace

std::string durationText(double seconds) {
    const long whole = std::lround(seconds);
    if (whole < 60)
        return fmt::format("{} s", whole);
    if (whole < 3600)
        return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

ProgressLine::ProgressLine(std::string task, bool isQuiet)
    : task_(std::move(task)), isQuiet_(isQuiet), isTerminal_(isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
    if (isDrawn_)
        fmt::print(stderr, "\r\033[K");
}

void ProgressLine::update(double share) {
    const Clock::time_point now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double sinceLast = std::chrono::duration<double>(now - lastPrint_).count();
    if (isQuiet_ || elapsed < firstPrintSeconds ||
        sinceLast < (isTerminal_ ? terminalIntervalSeconds : logIntervalSeconds))
        return;
    lastPrint_ = now;
    const double left = share > 0.0 ? elapsed * (1.0 - share) / share : 0.0;
    if (isTerminal_) {
        const int filled = static_cast<int>(share * barWidth);
        fmt::print(stderr, "\r\033[K{} [{:#<{}}{:.<{}}] {:3.0f} %  {} left", task_, "", filled, "",
                   barWidth - filled, share * 100.0, share > 0.0 ? durationText(left) : "?");
        isDrawn_ = true;
    } else {
        fmt::print(stderr, "task={} progress={:.3f} elapsed_s={:.1f} left_s={:.1f}\n", task_, share, elapsed,
                   left);
    }
    std::fflush(stderr);
}

} // namespace hyalite
