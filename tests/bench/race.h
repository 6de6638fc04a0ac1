// Timing of one thing beside others, in turns: what else happens on the machine then happens to all of them, and their
// ratio holds where each time by itself does not.
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <span>
#include <string>

namespace hyalite::bench {

/// Runs once what is timed, and returns the seconds that count.
using Runner = std::function<double()>;

/// The runner of a function, all of which counts.
[[nodiscard]] Runner timed(std::function<void()> function);

struct Rival {
    std::string
        counter; ///< gets the rival's time divided by the contestant's: above 1 the contestant is faster
    Runner run;
};

/// Runs the contestant and then each rival, for each iteration of `state`, which uses manual time. Counters get medians:
/// "seconds" and the rivals'. Nothing is run before to warm up: who checks results has done that.
void race(benchmark::State &state, const Runner &contestant, std::span<const Rival> rivals);

} // namespace hyalite::bench
