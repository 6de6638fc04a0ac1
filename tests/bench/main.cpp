// hyalite_bench [--device=NAME] [--driver=FILE.json]... [--cpu-time] [--benchmark_filter=...] [--benchmark_out=FILE]...
//
// Verifies, measures, and prints tables in the end. --driver names the manifest of a Vulkan driver, which gets a column
// of its own where processes are timed. --cpu-time counts processor seconds instead of time: for machines that do other
// things meanwhile, and for devices that compute on the CPU. Exit code 1: a result was wrong or something was missing.
#include "host/process/lavapipe.h"
#include "tests/bench/race.h"
#include "tests/bench/subject.h"
#include "tests/bench/suites.h"
#include "tests/bench/table.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace {

/// What begins with `option` is taken away; returns the rest of it, or nothing without one.
std::optional<std::string> takeOption(std::string_view option, int &argumentCount, char **arguments) {
    for (int i = 1; i < argumentCount; ++i) {
        const std::string argument = arguments[i];
        if (!argument.starts_with(option))
            continue;
        for (int next = i; next < argumentCount; ++next) // the last one is a null pointer
            arguments[next] = arguments[next + 1];
        --argumentCount;
        return argument.substr(option.size());
    }
    return std::nullopt;
}

} // namespace

int main(int argumentCount, char **arguments) {
    using namespace hyalite::core;
    try {
        const std::string deviceName = takeOption("--device=", argumentCount, arguments).value_or("auto");
        std::vector<std::string> manifests;
        while (const auto manifest = takeOption("--driver=", argumentCount, arguments))
            manifests.push_back(*manifest);
        if (takeOption("--cpu-time", argumentCount, arguments))
            bench::countProcessorSeconds();
        benchmark::Initialize(&argumentCount, arguments);
        if (benchmark::ReportUnrecognizedArguments(argumentCount, arguments))
            return 2;
        configureLavapipe({}); // vectors as wide as renders have them
        bench::Context context(gpu::chooseDevice(gpu::listDevices(), deviceName));
        benchmark::AddCustomContext("device", context.device().name);
        benchmark::AddCustomContext("driver", context.device().driver);
        for (const std::string &manifest : manifests)
            context.addTarget(bench::targetOf(manifest));
        bench::registerRays(context);
        bench::registerBruteForce(context);
        bench::registerBuilding(context);
        bench::registerReading();
        bench::registerFrames(context);
        bench::registerSizes(context);
        bench::registerNoise(context);
        bench::registerStartUp(context);
        bench::registerFarm(context);
        bench::TableReporter reporter;
        benchmark::RunSpecifiedBenchmarks(&reporter);
        fmt::print("\n{}", reporter.markdown(context.device()));
        return reporter.hasFailures() ? 1 : 0;
    } catch (const std::exception &error) {
        fmt::print(stderr, "hyalite_bench: {}\n", error.what());
        return 1;
    }
}
