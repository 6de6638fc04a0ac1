#include "host/lab/measurement.h"

#include "host/image/metrics.h"
#include "host/report/figure_text.h"
#include "host/report/render_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
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

Measurement::Measurement(const MeasurementRequest &request, const std::string &commandLine,
                         Observer &observer)
    : request_(request), observer_(observer) {
    profile_.origin.commandLine = commandLine;
}

void Measurement::prepareScene() {
    watch_ = {};
    scene_ = hyalite::prepareScene(request_.scene, Source::Dropped, observer_);
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
    backend_ = openBackend(request_.device, observer_, processorsFor(request_.threadCount, scene_),
                           renderConfigFor(request_.deviceOptions));
    profile_.hostStages.push_back({"open the device", watch_.lap()});
    profile_.device = backend_->identity(scene_.packed, profile_.origin.settings.integrator);
}

void Measurement::startTime(bool isCounting) {
    limit_ = TimeLimit(request_.timeLimitSeconds);
    measuring_ = limit_.share(isCounting ? 0.5 : 1.0);
    profile_.timeLimitSeconds = request_.timeLimitSeconds;
}

BackendResult Measurement::render(Backend &backend, const RenderSettings &settings,
                                  const RenderTask &task) const {
    return unlessFailed(hyalite::render(backend, scene_.packed, settings, scene_.crop, observer_, task));
}

double Measurement::finishedShare(const Film &film) const {
    const int samplesPerPixel = scene_.loaded.settings.samplesPerPixel;
    const FinishedWork finished = finishedWork(film, std::span(&film.crop, 1), samplesPerPixel);
    return static_cast<double>(finished.sampleCount) / static_cast<double>(finished.wantedPixelCount) /
           samplesPerPixel;
}

bool Measurement::renderFrame(const std::string &label, bool isMeasured) {
    Frame frame;
    frame.label = label;
    Stopwatch watch;
    BackendResult result = render(*backend_, scene_.loaded.settings,
                                  {.name = label, .limit = measuring_, .timeline = &frame.timeline});
    frame.span = watch.lap();
    frame.finishedShare = finishedShare(result.film);
    const bool isFinished = frame.finishedShare == 1.0;
    frame.isMeasured = isMeasured && isFinished;
    if (!film_ || frame.finishedShare > filmShare_) {
        filmShare_ = frame.finishedShare;
        film_ = std::move(result.film);
    }
    profile_.frames.push_back(std::move(frame));
    return isFinished;
}

std::optional<std::string> Measurement::verify() {
    if (request_.isUnverified || !isVerifiable()) {
        profile_.verification =
            request_.isUnverified ? "not verified, as asked" : "not verified: it is the reference itself";
        return std::nullopt;
    }
    profile_.verification = "not verified: the time limit came before the CPU twin had finished";
    if (!renderFrame("verification", false)) {
        profile_.leftOut.emplace_back("the verification");
        return std::nullopt;
    }
    const std::unique_ptr<Backend> twin = openBackend("cpu", observer_);
    Stopwatch watch;
    const BackendResult wanted =
        render(*twin, scene_.loaded.settings, {.name = "the CPU twin", .limit = measuring_.share(0.5)});
    profile_.hostStages.push_back({"the CPU twin", watch.lap()});
    if (finishedShare(wanted.film) < 1.0) {
        profile_.leftOut.emplace_back("the verification");
        return std::nullopt;
    }
    if (const std::size_t count = differingPixelCount(*film_, wanted.film); count > 0)
        return fmt::format("{} of {} pixels differ from the CPU twin's", count, wanted.film.pixels.size());
    if (const RayCounts rays = raysOf(profile_.frames.back()); rays != wanted.rays)
        return fmt::format("{} rays were traced, and {} by the CPU twin", rays.total(), wanted.rays.total());
    profile_.isVerified = true;
    profile_.verification = "equal to the CPU twin, bit for bit, ray counts too";
    return std::nullopt;
}

void Measurement::measure() {
    const auto isTimeLeft = [this] { return profile_.frames.empty() || !measuring_.isReached(); };
    for (int i = 1; i <= request_.warmupCount && isTimeLeft(); ++i)
        (void)renderFrame(fmt::format("warm-up {}", i), false);
    int measuredCount = 0;
    while (measuredCount < request_.repeatCount && isTimeLeft() &&
           renderFrame(fmt::format("repeat {}", measuredCount + 1), true))
        ++measuredCount;
    if (measuredCount == request_.repeatCount)
        return;
    if (measuredCount > 0) {
        profile_.leftOut.push_back(
            fmt::format("{} of {} repeats", request_.repeatCount - measuredCount, request_.repeatCount));
        return;
    }
    Frame &most = *std::ranges::max_element(profile_.frames, {}, &Frame::finishedShare);
    most.isMeasured = true;
    profile_.leftOut.push_back(fmt::format(
        "all repeats: the measured frame is the {}, {}", most.label,
        most.finishedShare < 1.0 ? fmt::format("ended at {} of its samples", shareText(most.finishedShare))
                                 : "which is finished"));
}

void Measurement::cutCount(const char *what, double share) {
    isCountCut_ = true;
    profile_.leftOut.push_back(fmt::format("{}, of which {} are there", what, shareText(share)));
}

void Measurement::countWork() {
    const std::unique_ptr<Backend> counter =
        openBackend(request_.device, observer_, processorsFor(request_.threadCount, scene_));
    RenderSettings settings = scene_.loaded.settings;
    settings.isWorkShown = true;
    const BackendResult result = render(
        *counter, settings, {.name = "counting", .limit = limit_.share(request_.isCounting ? 0.5 : 1.0)});
    if (const double share = finishedShare(result.film); share < 1.0)
        cutCount("the work of the rays: the heat map shows the samples", share);
    else
        profile_.work = result.work;
    const std::vector<float> tests = testsPerSample(result.film);
    std::vector<float> ofSampled;
    for (std::size_t i = 0; i < tests.size(); ++i)
        if (result.film.pixels[i].sampleCount > 0)
            ofSampled.push_back(tests[i]);
    profile_.workHistogram = binWork(ofSampled);
    heatMap_ = drawCost(result.film);
}

void Measurement::countKernelWork() {
    if (!isVerifiable())
        return;
    gpu::RenderConfig config = renderConfigFor(request_.deviceOptions);
    config.isCounting = true;
    const std::unique_ptr<Backend> counter =
        openBackend(request_.device, observer_, processorsFor(request_.threadCount, scene_), config);
    const BackendResult result =
        render(*counter, scene_.loaded.settings, {.name = "counting the kernel's work", .limit = limit_});
    if (const double share = finishedShare(result.film); share < 1.0)
        cutCount("the work of the kernel: the samples", share);
    else
        profile_.kernelWork =
            KernelWork{counter->identity(scene_.packed, scene_.loaded.settings.integrator).kernel,
                       result.work, result.lanes};
}

} // namespace hyalite
