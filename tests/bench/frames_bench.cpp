#include "host/base/error.h"
#include "host/image/image_file.h"
#include "tests/bench/process.h"
#include "tests/bench/race.h"
#include "tests/bench/subject.h"
#include "tests/bench/suites.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <vector>

namespace hyalite::bench {

namespace {

struct Frame {
    const char *name;
    std::string scene; ///< as `hyalite render` takes it
    std::vector<std::string> options{};
};

/// What `hyalite` is given to render a frame.
std::vector<std::string> argumentsOf(const Frame &frame, const std::string &deviceName,
                                     const std::filesystem::path &image) {
    std::vector<std::string> arguments{"render",   frame.scene, "--quiet",     "--device",
                                       deviceName, "--output",  image.string()};
    arguments.insert(arguments.end(), frame.options.begin(), frame.options.end());
    return arguments;
}

std::string contentsOf(const std::filesystem::path &file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// `hyalite render` of one frame on one device, again and again, to a file that is overwritten.
class Rendering {
  public:
    Rendering(const Frame &frame, const std::string &deviceName)
        : arguments_(argumentsOf(frame, deviceName, image())) {
        arguments_.insert(arguments_.end(), {"--report", report().string()});
    }

    /// Returns the seconds of all dispatches, or of the reference renderer; of the processor's only those of the whole
    /// process are known. Keeps these.
    double run() {
        processSeconds_.push_back(runHyalite(arguments_));
        if (areProcessorSecondsCounted())
            return processSeconds_.back();
        return nlohmann::json::parse(contentsOf(report())).at("seconds").at("render").get<double>();
    }

    /// The files themselves say which device made them.
    [[nodiscard]] Image picture() const { return readImage(image()).image; }
    [[nodiscard]] const std::vector<double> &processSeconds() const { return processSeconds_; }

  private:
    [[nodiscard]] std::filesystem::path image() const { return folder_.path() / "image.png"; }
    [[nodiscard]] std::filesystem::path report() const { return folder_.path() / "report.json"; }

    TemporaryFolder folder_;
    std::vector<std::string> arguments_;
    std::vector<double> processSeconds_;
};

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
