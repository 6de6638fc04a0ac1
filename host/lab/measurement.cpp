#include "host/lab/measurement.h"

#include "host/base/quantities.h"
#include "host/image/false_colour.h"
#include "host/image/metrics.h"
#include "host/reference/renderer.h"
#include "host/report/figure_text.h"
#include "host/report/render_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace hyalite::core {

namespace {

RayCounts raysOf(const Frame &frame) {
    RayCounts rays;
    for (const DispatchRecord &dispatch : frame.timeline.dispatches)
        rays += dispatch.rays;
    return rays;
}

class MeasurementRun {
  public:
    MeasurementRun(const MeasurementSubject &subject, const MeasurementRequest &request, bool wantsHeatMap,
                   Observer &observer)
        : scene_(subject.scene), device_(*subject.device), request_(request),
          isCounting_(request.isCounting || wantsHeatMap),
          isCharging_(request.isCharging && reference::canChargeWork(subject.scene.loaded.settings)),
          observer_(observer), limit_(request.timeLimitSeconds),
          measuring_(limit_.share(isCounting_ || isCharging_ ? 0.5 : 1.0)) {
        profile_ = subject.profile;
        profile_.timeLimitSeconds = request.timeLimitSeconds;
    }

    Measurement measure() {
        result_.fault = verify();
        if (result_.fault)
            return std::move(result_);
        renderFrames();
        if (isCounting_)
            countWork();
        if (request_.isCounting)
            countKernelWork();
        if (isCharging_)
            chargeWork();
        result_.isCut = result_.isCut || measuredShare(profile_) < 1.0;
        return std::move(result_);
    }

  private:
    [[nodiscard]] bool isVerifiable() const { return !isReference(request_.device); }

    /// Returns whether the frame is finished.
    bool renderFrame(const std::string &label, bool isMeasured) {
        Frame frame;
        frame.label = label;
        Stopwatch watch;
        BackendResult result = render(device_, scene_.loaded.settings,
                                      {.name = label, .limit = measuring_, .timeline = &frame.timeline});
        frame.span = watch.lap();
        frame.finishedShare = finishedShare(result.film);
        const bool isFinished = frame.finishedShare == 1.0;
        frame.isMeasured = isMeasured && isFinished;
        if (frame.finishedShare > filmShare_) {
            filmShare_ = frame.finishedShare;
            result_.film = std::move(result.film);
        }
        profile_.frames.push_back(std::move(frame));
        return isFinished;
    }

    /// Returns how the first frame differs from the CPU twin's, or nothing.
    std::optional<std::string> verify() {
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
        if (const std::size_t count = differingPixelCount(result_.film, wanted.film); count > 0)
            return fmt::format("{} of {} pixels differ from the CPU twin's", count,
                               wanted.film.pixels.size());
        if (const RayCounts rays = raysOf(profile_.frames.back()); rays != wanted.rays)
            return fmt::format("{} rays were traced, and {} by the CPU twin", rays.total(),
                               wanted.rays.total());
        profile_.isVerified = true;
        profile_.verification = "equal to the CPU twin, bit for bit, ray counts too";
        return std::nullopt;
    }

    /// Renders the warm-ups and the repeats.
    void renderFrames() {
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
        profile_.leftOut.push_back(
            fmt::format("all repeats: the measured frame is the {}, {}", most.label,
                        most.finishedShare < 1.0
                            ? fmt::format("ended at {} of its samples", shareText(most.finishedShare))
                            : "which is finished"));
    }

    /// Counts the work of the rays of the integrator, in a traversal with a stack, whichever kernel is measured.
    void countWork() {
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
        result_.heatMap = drawCost(result.film);
    }

    /// Renders once more and counts the work of the measured kernel's traversal, if it has one.
    void countKernelWork() {
        if (!isVerifiable())
            return;
        gpu::RenderConfig config = renderConfigFor(request_.deviceOptions);
        config.isCounting = true;
        const std::unique_ptr<Backend> counter =
            openBackend(request_.device, observer_, processorsFor(request_.threadCount, scene_), config);
        const BackendResult result =
            render(*counter, scene_.loaded.settings, {.name = "counting the kernel's work", .limit = limit_});
        if (const double share = finishedShare(result.film); share < 1.0) {
            cutCount("the work of the kernel: the samples", share);
        } else {
            const std::string kernel =
                counter->identity(scene_.packed, scene_.loaded.settings.integrator).kernel;
            const gpu::KernelRow *row = gpu::findKernel(kernel);
            const bool isDevices = row != nullptr && row->tree == gpu::KernelTree::PrimitiveBoxes;
            profile_.kernelWork = KernelWork{kernel, result.work, result.lanes, !isDevices};
        }
    }

    /// So few samples that they are a small part of most profiles; the same for pictures of one size.
    [[nodiscard]] int chargedSamples() const {
        constexpr int most = 4;
        constexpr std::size_t samplesMax = std::size_t{1} << 20;
        const std::size_t pixelCount = result_.film.pixels.size();
        const auto fitting =
            static_cast<int>(std::min<std::size_t>(samplesMax / std::max<std::size_t>(pixelCount, 1), most));
        return std::min(std::max(fitting, 1), scene_.loaded.settings.samplesPerPixel);
    }

    /// Charges the rays of the first samples, by the CPU twin: the same on every machine, whatever is measured.
    void chargeWork() {
        RenderSettings settings = scene_.loaded.settings;
        settings.samplesPerPixel = chargedSamples();
        ObservedTask progress(observer_, "counting by objects", false);
        RenderHooks hooks;
        hooks.onProgress = [&](double share) { progress.update(share); };
        hooks.shouldStop = [&] { return observer_.wantsStop().has_value() || limit_.isReached(); };
        const reference::Result result =
            reference::render(scene_.packed, settings, Film(scene_.crop),
                              {.threadCount = request_.threadCount, .isCharging = true}, hooks);
        if (!finishedWork(result.film, std::span(&result.film.crop, 1), settings.samplesPerPixel)
                 .isComplete) {
            profile_.leftOut.emplace_back("the work by objects and materials");
            return;
        }
        profile_.charges = chargesOf(result.ledger, static_cast<std::uint32_t>(settings.samplesPerPixel),
                                     scene_.packed.namesOf(Integrator::ObjectNumber),
                                     scene_.packed.namesOf(Integrator::MaterialNumber));
        if (sumOf(profile_.charges->totals).tests() == 0)
            return; // a few spheres, without a tree
        const Image means = result.film.toImage();
        for (glm::length_t stage = 0; stage < 3; ++stage) {
            std::vector<float> tests;
            for (const glm::vec3 &pixel : means.pixels())
                tests.push_back(pixel[stage]);
            result_.stagePictures.push_back(falseColours(
                scene_.crop.width(), scene_.crop.height(), tests,
                fmt::format("tests per sample, {} rays", pathStageNames[static_cast<std::size_t>(stage)])));
        }
    }

    /// Notes a count that the time limit cut.
    void cutCount(const char *what, double share) {
        result_.isCut = true;
        profile_.leftOut.push_back(fmt::format("{}, of which {} are there", what, shareText(share)));
    }

    BackendResult render(Backend &backend, const RenderSettings &settings, const RenderTask &task) const {
        return unlessFailed(
            hyalite::core::render(backend, scene_.packed, settings, scene_.crop, observer_, task));
    }

    double finishedShare(const Film &film) const {
        const int samplesPerPixel = scene_.loaded.settings.samplesPerPixel;
        const FinishedWork finished = finishedWork(film, std::span(&film.crop, 1), samplesPerPixel);
        return static_cast<double>(finished.sampleCount) / static_cast<double>(finished.wantedPixelCount) /
               samplesPerPixel;
    }

    const PreparedScene &scene_;
    Backend &device_;
    const MeasurementRequest &request_;
    const bool isCounting_;
    const bool isCharging_;
    Observer &observer_;
    const TimeLimit limit_;     ///< of all renders
    const TimeLimit measuring_; ///< of those before the counts
    Measurement result_;        ///< its film is that of the frame that is finished most
    Profile &profile_ = result_.profile;
    double filmShare_ = -1.0; ///< how much of that is finished
};

} // namespace

MeasurementSubject prepareMeasurement(const MeasurementRequest &request, const std::string &commandLine,
                                      Observer &observer) {
    Stopwatch watch;
    MeasurementSubject subject{prepareScene(request.scene, Source::Dropped, observer), {}, {}};
    if (const RenderSettings &settings = subject.scene.loaded.settings; isAdaptive(settings))
        throw OverrideError("noise",
                            fmt::format("found {}, and a measurement has as many samples in each pixel; "
                                        "allowed: 0%, with spp",
                                        percentText(settings.noise)));
    const PreparedScene &scene = subject.scene;
    Profile &profile = subject.profile;
    const Span prepared = watch.lap();
    const auto nanos = [](double seconds) { return std::llround(seconds * 1e9); };
    const std::int64_t loaded = prepared.beginNanos + nanos(scene.loadSeconds);
    profile.hostStages.push_back({"load", {prepared.beginNanos, loaded}});
    profile.hostStages.push_back({"build", {loaded, loaded + nanos(scene.buildSeconds)}});
    profile.origin = provenanceOf(scene, commandLine);
    profile.sceneBytes = scene.packed.sizeBytes();
    requireFilmMemory(scene.crop, 2);
    watch = {};
    subject.device = openBackend(request.device, observer, processorsFor(request.threadCount, scene),
                                 renderConfigFor(request.deviceOptions));
    profile.hostStages.push_back({"open the device", watch.lap()});
    profile.device = subject.device->identity(scene.packed, profile.origin.settings.integrator);
    return subject;
}

Measurement measure(const MeasurementSubject &subject, const MeasurementRequest &request, bool wantsHeatMap,
                    Observer &observer) {
    return MeasurementRun(subject, request, wantsHeatMap, observer).measure();
}

} // namespace hyalite::core
