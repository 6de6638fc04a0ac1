#include "tests/bench/race.h"

#include <algorithm>
#include <ctime>
#include <exception>

namespace hyalite::core::bench {

namespace {

clockid_t clockInUse = CLOCK_MONOTONIC;

double now() {
    timespec time{};
    clock_gettime(clockInUse, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

void countProcessorSeconds() { clockInUse = CLOCK_PROCESS_CPUTIME_ID; }

bool areProcessorSecondsCounted() { return clockInUse == CLOCK_PROCESS_CPUTIME_ID; }

Runner timed(std::function<void()> function) {
    return [function = std::move(function)] {
        const double start = now();
        function();
        return now() - start;
    };
}

void race(benchmark::State &state, const Runner &contestant, std::span<const Rival> rivals) {
    std::vector<double> seconds;
    std::vector<std::vector<double>> ratios(rivals.size());
    for ([[maybe_unused]] const auto iteration : state) {
        seconds.push_back(contestant());
        state.SetIterationTime(seconds.back());
        for (std::size_t i = 0; i < rivals.size(); ++i)
            ratios[i].push_back(rivals[i].run() / seconds.back());
    }
    state.counters["seconds"] = median(seconds);
    for (std::size_t i = 0; i < rivals.size(); ++i)
        state.counters[rivals[i].counter] = median(ratios[i]);
}

void addBenchmark(const std::string &name, int iterations,
                  const std::function<void(benchmark::State &)> &measure) {
    const auto guarded = [measure](benchmark::State &state) {
        try {
            measure(state);
        } catch (const std::exception &error) {
            state.SkipWithError(error.what());
        }
    };
    benchmark::RegisterBenchmark(name.c_str(), guarded)
        ->UseManualTime()
        ->Iterations(iterations)
        ->Unit(benchmark::kMillisecond);
}

} // namespace hyalite::core::bench
