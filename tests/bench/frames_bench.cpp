#include "tests/bench/race.h"
#include "tests/bench/rendering.h"
#include "tests/bench/subject.h"
#include "tests/bench/suites.h"

#include <fmt/format.h>

#include <span>
#include <string>
#include <vector>

namespace hyalite::core::bench {

namespace {

/// What of a run counts: all dispatches, or the process, whose kernels Mesa has or has not in its cache.
enum class Counted { Dispatches, Process, ColdProcess };

double run(Rendering &rendering, Counted counted) {
    if (counted == Counted::ColdProcess)
        rendering.forgetKernels();
    const double dispatchSeconds = rendering.run();
    return counted == Counted::Dispatches ? dispatchSeconds : rendering.processSeconds();
}

void raceRenderings(benchmark::State &state, Rendering &contestant, std::span<const Rival> rivals,
                    Counted counted) {
    std::vector<double> processSeconds;
    const auto runContestant = [&] {
        const double seconds = run(contestant, counted);
        processSeconds.push_back(contestant.processSeconds());
        return seconds;
    };
    race(state, runContestant, rivals);
    if (counted == Counted::Dispatches && !areProcessorSecondsCounted())
        state.counters["seconds in all"] = median(processSeconds);
}

void measureOnDevice(benchmark::State &state, const Context &context, const Frame &frame,
                     const Target &target, Counted counted) {
    Rendering onCpu(frame, cpuReference);
    Rendering onDevice(frame, target);
    if (!haveEqualPictures(onDevice, onCpu, state))
        return;
    if (target.isOfSystem()) {
        raceRenderings(state, onDevice, {}, counted);
        return;
    }
    Rendering bySystem(frame, context.systemTarget());
    bySystem.run(); // so that its kernels are there
    const Rival rivals[] = {{"of the system's driver", [&] { return run(bySystem, counted); }}};
    raceRenderings(state, onDevice, rivals, counted);
}

void measureOnCpu(benchmark::State &state, const Frame &frame, Counted counted) {
    Rendering onCpu(frame, cpuReference);
    raceRenderings(state, onCpu, {}, counted);
}

} // namespace

void registerFrames(Context &context) {
    // At pixel centres all samples of a pixel are alike, and no lane waits for another.
    const std::vector<std::string> centres{"--sampler", "centre"};
    std::vector<Frame> frames{{"spheres", "spheres"},
                              {"cat", "cat"},
                              {"cat, pixel centres", "cat", centres},
                              {"cat of 4k", HYALITE_CAT_4K_SCENE},
                              {"cat of 4k, pixel centres", HYALITE_CAT_4K_SCENE, centres}};
    // Paths: diffuse walls, glass, metals below a sky, a mesh below a sky, many lights, textures with cut-outs.
    for (const char *scene : {"cornell", "caustics", "metals", "studio-cat", "many-lights", "still-life"})
        frames.push_back({scene, scene, {"--spp", "8"}});
    for (const Frame &frame : frames) {
        const std::string row = fmt::format("frames/{}/", frame.name);
        for (const Target &target : context.targets())
            addBenchmark(row + target.name, 3, [=, &context](benchmark::State &state) {
                measureOnDevice(state, context, frame, target, Counted::Dispatches);
            });
        addBenchmark(row + cpuReference.name, 2,
                     [=](benchmark::State &state) { measureOnCpu(state, frame, Counted::Dispatches); });
    }
}

void registerStartUp(Context &context) {
    const std::vector<std::string> fewPixels{"--spp", "1", "--width", "48", "--height", "32"};
    const Frame frames[] = {{"spheres at 1 spp", "spheres", {"--spp", "1"}},
                            {"caustics at 48x32 and 1 spp", "caustics", fewPixels},
                            {"still-life at 48x32 and 1 spp", "still-life", fewPixels}};
    for (const Frame &frame : frames) {
        const std::string row = fmt::format("start-up/{}/", frame.name);
        for (const Target &target : context.targets()) {
            addBenchmark(row + target.name, 5, [=, &context](benchmark::State &state) {
                measureOnDevice(state, context, frame, target, Counted::Process);
            });
            addBenchmark(row + target.name + ", cold shader cache", 3,
                         [=, &context](benchmark::State &state) {
                             measureOnDevice(state, context, frame, target, Counted::ColdProcess);
                         });
        }
        addBenchmark(row + cpuReference.name, 5,
                     [=](benchmark::State &state) { measureOnCpu(state, frame, Counted::Process); });
    }
}

} // namespace hyalite::core::bench
