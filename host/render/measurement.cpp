#include "host/render/measurement.h"

#include "host/image/metrics.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace hyalite {

namespace {

RayCounts raysOf(const Frame &frame) {
    RayCounts rays;
    for (const DispatchRecord &dispatch : frame.timeline.dispatches)
        rays += dispatch.rays;
    return rays;
}

} // namespace

Measurement::Measurement(const MeasurementRequest &request, const std::string &commandLine)
    : request_(request) {
    profile_.origin.commandLine = commandLine;
}

void Measurement::prepareScene() {
    watch_ = {};
    scene_ = hyalite::prepareScene(request_.scene, Source::Dropped, request_.isQuiet);
    const Span prepared = watch_.lap();
    const auto nanos = [](double seconds) { return std::llround(seconds * 1e9); };
    const std::int64_t loaded = prepared.beginNanos + nanos(scene_.loadSeconds);
    profile_.hostStages.push_back({"load", {prepared.beginNanos, loaded}});
    profile_.hostStages.push_back({"build", {loaded, loaded + nanos(scene_.buildSeconds)}});
    profile_.origin = provenanceOf(scene_, profile_.origin.commandLine);
    profile_.sceneBytes = scene_.packed.sizeBytes();
}

void Measurement::openDevice() {
    requireFilmMemory(scene_.crop, 2);
    watch_ = {};
    backend_ = openBackend(request_.device, processorsFor(request_.threadCount, scene_),
                           renderConfigFor(request_.deviceOptions));
    profile_.hostStages.push_back({"open the device", watch_.lap()});
    profile_.device = backend_->identity(scene_.packed, profile_.origin.settings.integrator);
}

Film Measurement::renderFrame(const std::string &label, bool isMeasured) {
    Frame frame;
    frame.label = label;
    frame.isMeasured = isMeasured;
    Stopwatch watch;
    BackendResult result = renderWithProgress(*backend_, scene_, label, request_.isQuiet, &frame.timeline);
    frame.span = watch.lap();
    profile_.frames.push_back(std::move(frame));
    return std::move(result.film);
}

std::optional<std::string> Measurement::verify() {
    if (request_.isUnverified || !isVerifiable()) {
        profile_.verification =
            request_.isUnverified ? "not verified, as asked" : "not verified: it is the reference itself";
        return std::nullopt;
    }
    const Film film = renderFrame("verification", false);
    const std::unique_ptr<Backend> twin = openBackend("cpu");
    Stopwatch watch;
    const BackendResult wanted = renderWithProgress(*twin, scene_, "the CPU twin", request_.isQuiet);
    profile_.hostStages.push_back({"the CPU twin", watch.lap()});
    if (const std::size_t count = differingPixelCount(film, wanted.film); count > 0)
        return fmt::format("{} of {} pixels differ from the CPU twin's", count, film.pixels.size());
    if (const RayCounts rays = raysOf(profile_.frames.back()); rays != wanted.rays)
        return fmt::format("{} rays were traced, and {} by the CPU twin", rays.total(), wanted.rays.total());
    profile_.isVerified = true;
    profile_.verification = "equal to the CPU twin, bit for bit, ray counts too";
    return std::nullopt;
}

void Measurement::measure() {
    for (int i = 1; i <= request_.warmupCount; ++i)
        static_cast<void>(renderFrame(fmt::format("warm-up {}", i), false));
    for (int i = 1; i <= request_.repeatCount; ++i)
        film_ = renderFrame(fmt::format("repeat {}", i), true);
}

void Measurement::countWork() {
    const std::unique_ptr<Backend> counter =
        openBackend(request_.device, processorsFor(request_.threadCount, scene_));
    RenderSettings &settings = scene_.loaded.scene.settings;
    const Integrator measured = std::exchange(settings.integrator, Integrator::Cost);
    const BackendResult result = renderWithProgress(*counter, scene_, "counting", request_.isQuiet);
    settings.integrator = measured;
    profile_.work = result.work;
    profile_.workHistogram = binWork(testsPerSample(result.film));
    heatMap_ = drawCost(result.film);
}

void Measurement::countKernelWork() {
    if (!isVerifiable())
        return;
    gpu::RenderConfig config = renderConfigFor(request_.deviceOptions);
    config.isCounting = true;
    const std::unique_ptr<Backend> counter =
        openBackend(request_.device, processorsFor(request_.threadCount, scene_), config);
    const BackendResult result =
        renderWithProgress(*counter, scene_, "counting the kernel's work", request_.isQuiet);
    profile_.kernelWork =
        KernelWork{counter->identity(scene_.packed, scene_.loaded.scene.settings.integrator).kernel,
                   result.work, result.lanes};
}

} // namespace hyalite
