#include "host/api/contents.h"
#include "host/process/process.h"

#include <fmt/format.h>

#include <algorithm>

namespace hyalite {

namespace {

/// How often a program is asked whether it wants a stop: often enough for people, and nothing for a render.
constexpr std::chrono::milliseconds askInterval{50};

std::atomic<bool> isProcessPrepared = false;

/// The owners of the callbacks that this thread runs, the innermost last.
thread_local std::vector<const void *> callers;

} // namespace

void prepareProcess() {
    core::prepareProcess(core::ProcessOwner::Library);
    isProcessPrepared = true;
}

void requireTimeLimit(const std::optional<double> &seconds) {
    constexpr core::Interval allowed{0.0, 1e9, false};
    if (seconds && !allowed.contains(*seconds))
        throw core::OverrideError("time-limit", core::refusalText(fmt::format("{}", *seconds),
                                                                  "a number of seconds, " + allowed.text()));
}

template <class Call> void WatchObserver::call(const Call &callback) {
    if (isStopped_)
        return;
    callers.push_back(owner_);
    try {
        callback();
    } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure_)
            failure_ = std::current_exception();
        isStopped_ = true;
    }
    callers.pop_back();
}

bool WatchObserver::isCalledBy(const void *owner) {
    return std::ranges::find(callers, owner) != callers.end();
}

void WatchObserver::begin(const std::string &task, bool /*mayCompile*/) {
    task_ = task;
    progress(0.0);
}

void WatchObserver::progress(double share) {
    if (watch_.progress)
        call([&] { watch_.progress(task_, share); });
}

void WatchObserver::tell(MessageKind kind, const std::string &text) {
    if (watch_.message)
        call([&] { watch_.message(kind, text); });
}

std::optional<core::Stop> WatchObserver::wantsStop() {
    const Clock::rep now = Clock::now().time_since_epoch().count();
    Clock::rep due = nextAsked_;
    if (watch_.shouldStop && now >= due &&
        nextAsked_.compare_exchange_strong(due, now + Clock::duration(askInterval).count()))
        call([&] { isStopped_ = isStopped_ || watch_.shouldStop(); });
    if (!isStopped_)
        return std::nullopt;
    return core::Stop{"the program", core::ErrorKind::Interrupted};
}

void WatchObserver::beforeDriver(const core::gpu::ProcessorUse &use) {
    if (isProcessPrepared)
        core::prepareDriver(use);
}

void WatchObserver::rethrow() const {
    const std::lock_guard lock(mutex_);
    if (failure_)
        std::rethrow_exception(failure_);
}

} // namespace hyalite
