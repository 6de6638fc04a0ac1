// Timing of one thing beside others, in turns: what else happens on the machine then happens to all of them, and their
// ratio holds where each time by itself does not.
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core::bench {

/// Runs once what is timed, and returns the seconds that count.
using Runner = std::function<double()>;

/// From now on runners count the processor's seconds on all threads together instead of time: less
/// like what a user waits for, but the same on a machine that does other things meanwhile.
void countProcessorSeconds();
[[nodiscard]] bool areProcessorSecondsCounted();

/// The runner of a function, all of which counts.
[[nodiscard]] Runner timed(std::function<void()> function);

struct Rival {
    std::string
        counter; ///< gets the rival's time divided by the contestant's: above 1 the contestant is faster
    Runner run;
};

/// Of at least one value.
[[nodiscard]] double median(std::vector<double> values);

/// Runs the contestant and then each rival, for each iteration of `state`, which uses manual time. Counters get
/// medians: "seconds" and the rivals'. Nothing is run before to warm up: who checks results has done that.
void race(benchmark::State &state, const Runner &contestant, std::span<const Rival> rivals);

/// Registers a benchmark that uses manual time. What `measure` throws is shown as its error.
void addBenchmark(const std::string &name, int iterations,
                  const std::function<void(benchmark::State &)> &measure);

} // namespace hyalite::core::bench
