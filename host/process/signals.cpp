#include "host/process/signals.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <string_view>

#include <unistd.h>

namespace hyalite::core {

namespace {

constexpr std::array<int, 3> stoppingSignals{SIGINT, SIGTERM, SIGHUP};

// Signal handlers may use only lock-free atomics, and only globals.
std::atomic<std::int64_t> firstNanoseconds{0}; ///< time of the first signal; 0: none
std::atomic<int> firstSignal{0};
std::atomic<bool> hasResults{false};
static_assert(std::atomic<std::int64_t>::is_always_lock_free && std::atomic<int>::is_always_lock_free &&
              std::atomic<bool>::is_always_lock_free);

std::string_view answer; ///< to the first signal
std::array<struct sigaction, stoppingSignals.size()> actionsBefore;
struct sigaction pipeActionBefore;

std::int64_t nanosecondsNow() noexcept {
    return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The acknowledgement of the first signal. On a terminal it replaces the progress line.
std::string_view answerTo(bool isTerminal) {
    return isTerminal ? "\r\033[Kstopping after the work in progress; repeat the signal to stop at once\n"
                      : "stopping after the work in progress; repeat the signal to stop at once\n";
}

void noteSignal(int signal) {
    const int errorNumber = errno;
    const std::int64_t now = nanosecondsNow();
    std::int64_t first = 0;
    if (hasResults && firstNanoseconds.compare_exchange_strong(first, now)) {
        firstSignal = signal;
        static_cast<void>(!write(STDERR_FILENO, answer.data(), answer.size()));
    } else if (static_cast<double>(now - first) >
               CaughtSignals::echoSeconds * 1e9) { // without results: first is 0
        std::signal(signal, SIG_DFL);
        raise(signal); // blocked in here, and delivered on return
    }
    errno = errorNumber;
}

} // namespace

CaughtSignals::CaughtSignals(bool isQuiet) {
    answer = isQuiet ? std::string_view() : answerTo(isatty(STDERR_FILENO) == 1);
    firstNanoseconds = 0;
    firstSignal = 0;
    hasResults = false;
    struct sigaction action {};
    action.sa_handler = noteSignal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    // The reader of our messages, such as head, may exit first: that must not lose the results.
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;
    sigemptyset(&ignore.sa_mask);
    sigaction(SIGPIPE, &ignore, &pipeActionBefore);
    for (std::size_t i = 0; i < stoppingSignals.size(); ++i) {
        sigaction(stoppingSignals[i], nullptr, &actionsBefore[i]);
        if (actionsBefore[i].sa_handler != SIG_IGN)
            sigaction(stoppingSignals[i], &action, nullptr);
    }
}

CaughtSignals::~CaughtSignals() {
    for (std::size_t i = 0; i < stoppingSignals.size(); ++i)
        sigaction(stoppingSignals[i], &actionsBefore[i], nullptr);
    sigaction(SIGPIPE, &pipeActionBefore, nullptr);
}

// Signals reach the whole process, and whoever catches them is asked.
// NOLINTBEGIN(readability-convert-member-functions-to-static)
void CaughtSignals::keepResults() noexcept { hasResults = true; }

int CaughtSignals::first() const noexcept { return firstSignal; }
// NOLINTEND(readability-convert-member-functions-to-static)

const char *signalName(int signal) {
    return signal == SIGINT ? "SIGINT" : signal == SIGHUP ? "SIGHUP" : "SIGTERM";
}

ErrorKind errorKindOf(int signal) {
    return signal == SIGINT   ? ErrorKind::Interrupted
           : signal == SIGHUP ? ErrorKind::HungUp
                              : ErrorKind::Terminated;
}

} // namespace hyalite::core
