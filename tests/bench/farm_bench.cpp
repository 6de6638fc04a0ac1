#include "host/engine/open_backends.h"
#include "host/engine/shared_backend.h"
#include "host/film/film_file.h"
#include "host/process/silent_observer.h"
#include "tests/bench/race.h"
#include "tests/bench/subject.h"
#include "tests/bench/suites.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hyalite::core::bench {

namespace {

/// A picture through the queue of tiles with one renderer in it, beside the same renderer alone: what scheduling costs.
void measureQueue(benchmark::State &state, const Context &context, const std::string &sceneName,
                  int samplesPerPixel) {
    SceneOptions options;
    options.scene = sceneName;
    options.settings.push_back(
        {[=](RenderSettings &settings) { settings.samplesPerPixel = samplesPerPixel; }});
    const PreparedScene scene = prepareScene(options, Source::Dropped, nobody());
    const std::string device = std::to_string(context.device().index);
    SilentObserver observer;
    const std::unique_ptr<Backend> alone = openBackend(device, observer, processorsFor(0, scene));
    std::vector<std::unique_ptr<Backend>> members;
    members.push_back(openBackend(device, observer, processorsFor(0, scene)));
    const std::unique_ptr<Backend> shared = shareBackends(std::move(members));
    const auto render = [&](Backend &backend) {
        return backend.render(scene.packed, scene.loaded.settings, scene.crop);
    };
    if (differingPixelCount(render(*alone).film, render(*shared).film) != 0) { // and the kernels are there
        state.SkipWithError("the pictures differ");
        return;
    }
    const Rival rivals[] = {{"alone", timed([&] { (void)render(*alone); })}};
    race(state, timed([&] { (void)render(*shared); }), rivals);
}

/// A tile of one workgroup with one sample: what setting up a tile takes.
void measureTile(benchmark::State &state, const Context &context, const std::string &sceneName) {
    SceneOptions options;
    options.scene = sceneName;
    options.settings.push_back({[](RenderSettings &settings) { settings.samplesPerPixel = 1; }});
    const PreparedScene scene = prepareScene(options, Source::Dropped, nobody());
    SilentObserver observer;
    const std::unique_ptr<Backend> backend =
        openBackend(std::to_string(context.device().index), observer, processorsFor(0, scene));
    const auto render = [&] { (void)backend->render(scene.packed, scene.loaded.settings, Crop{0, 8, 0, 8}); };
    render(); // the kernel is there
    race(state, timed(render), {});
}

} // namespace

void registerFarm(Context &context) {
    for (const char *scene : {"cornell", "cat", "studio-cat"})
        addBenchmark(fmt::format("farm/{}/tile", scene), 50,
                     [&context, scene](benchmark::State &state) { measureTile(state, context, scene); });
    for (const auto &[scene, samples] : {std::pair{"cornell", 64}, {"cat", 16}, {"studio-cat", 16}})
        addBenchmark(fmt::format("farm/{}/queue", scene), 7,
                     [&context, scene = std::string(scene), samples = samples](benchmark::State &state) {
                         measureQueue(state, context, scene, samples);
                     });
}

} // namespace hyalite::core::bench
