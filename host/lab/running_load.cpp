#include "host/lab/running_load.h"

#include "host/base/error.h"
#include "host/base/summary.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <chrono>
#include <span>
#include <utility>
#include <vector>

namespace hyalite::core {

namespace {

constexpr int maxDeviceFailures = 3; // of a load

std::string nowText() {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                       fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

} // namespace

void Soak::report(SoakFault fault) {
    if (verdict.faults.size() >= maxSoakFaults)
        return;
    if (events.onFault)
        events.onFault(fault);
    verdict.faults.push_back(std::move(fault));
}

RunningLoad::RunningLoad(Soak &soak, std::string name, std::string unit)
    : soak_(soak), index_(soak.verdict.loads.size()) {
    soak.verdict.loads.push_back({std::move(name), std::move(unit)});
}

void RunningLoad::runFor(double seconds) {
    if (isDone())
        return;
    const std::uint64_t before = load().passes;
    const double begin = soak_.seconds();
    runGuarded(TimeLimit(seconds));
    if (const std::uint64_t passes = load().passes - before; passes > 0) {
        const std::span<const float> all = load().speeds;
        const std::span<const float> these = all.last(static_cast<std::size_t>(passes));
        load().slices.push_back(
            {begin, passes, quantile(std::vector<double>(these.begin(), these.end()), 0.5)});
    }
}

void RunningLoad::finish() {
    tellOpenFaults();
    if (load().passes == 0 && failures_ == 0 && load().lack.empty())
        load().lack = "no time was left for it";
}

bool RunningLoad::isDone() const {
    return !load().lack.empty() || failures_ >= maxDeviceFailures || soak_.isOver(load());
}

void RunningLoad::giveUp() { failures_ = maxDeviceFailures; }

SoakFault RunningLoad::newFault(SoakFault::Kind kind) const {
    SoakFault fault;
    fault.kind = kind;
    fault.load = load().name;
    fault.pass = load().passes;
    fault.time = nowText();
    return fault;
}

void RunningLoad::countPass(double work, double workSeconds, double checkSeconds) {
    ++load().passes;
    load().speeds.push_back(static_cast<float>(work / std::max(workSeconds, 1e-9)));
    load().workSeconds += workSeconds;
    load().checkSeconds += checkSeconds;
}

void RunningLoad::runGuarded(const TimeLimit &slice) {
    try {
        run(slice);
    } catch (const Error &error) {
        if (error.kind == ErrorKind::LimitExceeded && load().passes == 0) {
            load().lack = error.what();
            return;
        }
        ++failures_;
        ++load().wrongPasses;
        SoakFault fault = newFault(SoakFault::Kind::Device);
        fault.text = error.what();
        soak_.report(std::move(fault));
    }
}

} // namespace hyalite::core
