#include "tests/bench/race.h"
#include "tests/bench/rendering.h"
#include "tests/bench/subject.h"
#include "tests/bench/suites.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace hyalite::bench {

namespace {

/// By its index: names of devices may be alike.
std::string deviceArgument(const Context &context) { return std::to_string(context.device().index); }

void measureFrame(benchmark::State &state, Rendering &rendering) {
    race(state, [&] { return rendering.run(); }, {});
    if (!areProcessorSecondsCounted())
        state.counters["seconds in all"] = median(rendering.processSeconds());
}

void measureFrameOnDevice(benchmark::State &state, const Context &context, const Frame &frame) {
    Rendering onDevice(frame, deviceArgument(context));
    Rendering onCpu(frame, "cpu");
    onDevice.run();
    onCpu.run();
    if (!std::ranges::equal(onDevice.picture().pixels(), onCpu.picture().pixels()))
        state.SkipWithError("the image differs from the reference's");
    else
        measureFrame(state, onDevice);
}

void measureFrameOnCpu(benchmark::State &state, const Frame &frame) {
    Rendering onCpu(frame, "cpu");
    measureFrame(state, onCpu);
}

enum class ShaderCache { Warm, Cold };

/// The least that a render can take.
void measureStartUp(benchmark::State &state, const Frame &frame, const std::string &deviceName,
                    ShaderCache cache) {
    const TemporaryFolder folder;
    const std::vector<std::string> arguments = argumentsOf(frame, deviceName, folder.path() / "image.png");
    const auto run = [&] {
        const TemporaryFolder empty;
        return cache == ShaderCache::Warm
                   ? runHyalite(arguments)
                   : runHyalite(arguments, {"MESA_SHADER_CACHE_DIR=" + empty.path().string()});
    };
    run();
    race(state, run, {});
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
        addBenchmark(row + "device", 3,
                     [=, &context](benchmark::State &state) { measureFrameOnDevice(state, context, frame); });
        addBenchmark(row + "CPU reference", 2,
                     [=](benchmark::State &state) { measureFrameOnCpu(state, frame); });
    }
}

void registerStartUp(Context &context) {
    const std::vector<std::string> fewPixels{"--spp", "1", "--width", "48", "--height", "32"};
    const Frame frames[] = {{"spheres at 1 spp", "spheres", {"--spp", "1"}},
                            {"caustics at 48x32 and 1 spp", "caustics", fewPixels},
                            {"still-life at 48x32 and 1 spp", "still-life", fewPixels}};
    for (const Frame &frame : frames) {
        const std::string row = fmt::format("start-up/{}/", frame.name);
        addBenchmark(row + "device", 5, [=, &context](benchmark::State &state) {
            measureStartUp(state, frame, deviceArgument(context), ShaderCache::Warm);
        });
        addBenchmark(row + "device, cold shader cache", 3, [=, &context](benchmark::State &state) {
            measureStartUp(state, frame, deviceArgument(context), ShaderCache::Cold);
        });
        addBenchmark(row + "CPU reference", 5, [=](benchmark::State &state) {
            measureStartUp(state, frame, "cpu", ShaderCache::Warm);
        });
    }
}

} // namespace hyalite::bench
