// hyalite_bench [--device=NAME] [--benchmark_filter=...] [--benchmark_out=FILE.json]...
//
// Verifies, measures, and prints tables in the end. Exit code 1: a result was wrong or something was missing.
#include "tests/bench/subject.h"
#include "tests/bench/suites.h"
#include "tests/bench/table.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

namespace {

/// The value of an argument such as --device=llvmpipe, which is taken away; "auto" without one.
std::string takeDevice(int &argumentCount, char **arguments) {
    constexpr std::string_view option = "--device=";
    for (int i = 1; i < argumentCount; ++i) {
        const std::string argument = arguments[i];
        if (!argument.starts_with(option))
            continue;
        for (int next = i; next < argumentCount; ++next) // the last one is a null pointer
            arguments[next] = arguments[next + 1];
        --argumentCount;
        return argument.substr(option.size());
    }
    return "auto";
}

} // namespace

int main(int argumentCount, char **arguments) {
    using namespace hyalite;
    try {
        const std::string deviceName = takeDevice(argumentCount, arguments);
        benchmark::Initialize(&argumentCount, arguments);
        if (benchmark::ReportUnrecognizedArguments(argumentCount, arguments))
            return 2;
        bench::chooseBenchDevice(deviceName);
        benchmark::AddCustomContext("device", bench::device().name);
        benchmark::AddCustomContext("driver", bench::device().driver);
        bench::registerRays();
        bench::registerBruteForce();
        bench::registerBuilding();
        bench::registerReading();
        bench::registerFrames();
        bench::registerStartUp();
        bench::TableReporter reporter;
        benchmark::RunSpecifiedBenchmarks(&reporter);
        fmt::print("\n{}", reporter.markdown());
        return reporter.hasFailures() ? 1 : 0;
    } catch (const std::exception &error) {
        fmt::print(stderr, "hyalite_bench: {}\n", error.what());
        return 1;
    }
}
