// hyalite_bench: Google Benchmark's options, and --device=NAME.
#include "tests/bench/subject.h"
#include "tests/bench/suites.h"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>

int main(int argumentCount, char **arguments) {
    using namespace hyalite;
    try {
        benchmark::Initialize(&argumentCount, arguments);
        bench::chooseBenchDevice("auto");
        bench::registerRays();
        benchmark::RunSpecifiedBenchmarks();
    } catch (const std::exception &error) {
        std::fprintf(stderr, "hyalite_bench: %s\n", error.what());
        return 1;
    }
    return 0;
}
