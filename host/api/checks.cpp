#include "hyalite/checks.h"

#include "host/api/contents.h"
#include "host/base/json_text.h"
#include "host/gpu/render_config.h"
#include "host/gpu/vk/device_list.h"
#include "host/image/comparison_json.h"
#include "host/image/ssim.h"
#include "host/lab/comparison_run.h"
#include "host/lab/device_report.h"
#include "host/lab/measurement.h"
#include "host/lab/scene_summary_json.h"
#include "host/lab/verify_report.h"
#include "host/packing/light_planes.h"
#include "host/report/profile_json.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

namespace hyalite {

namespace {

constexpr const char *byProgram = "(by a program)"; ///< in place of a command line

/// The squared errors of pixels, averaged over the channels; without NaN as they are in PSNR.
std::vector<float> errorsOf(const core::Image &a, const core::Image &b) {
    std::vector<float> errors;
    errors.reserve(a.pixels().size());
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        double sum = 0.0;
        for (glm::length_t channel = 0; channel < 3; ++channel) {
            const double error = double{a.pixels()[i][channel]} - double{b.pixels()[i][channel]};
            sum += error * error;
        }
        errors.push_back(static_cast<float>(sum / 3.0));
    }
    return errors;
}

Difference differenceOf(const core::ImageComparison &comparison, const core::Image &reference,
                        const core::Image &test) {
    Difference difference;
    difference.isIdentical = comparison.identical();
    if (comparison.alpha) {
        difference.alphaMax = comparison.alpha->maxAbsoluteDifference;
        difference.alphaMean = comparison.alpha->meanAbsoluteDifference;
    }
    difference.differingPixels = comparison.pixels.differingPixelCount;
    difference.psnrDecibels = comparison.pixels.psnrDecibels();
    difference.ssim = comparison.ssim;
    difference.flip = comparison.flip.mean;
    difference.width = reference.width();
    difference.height = reference.height();
    difference.flipMap = comparison.flipMap.errors;
    difference.ssimMap = core::ssimMap(reference, test);
    difference.errorMap = errorsOf(reference, test);
    difference.json = core::jsonText(core::comparisonToJson(comparison, reference, test));
    return difference;
}

core::LoadedImage loadedOf(const Image::Content &content) {
    return {content.image, content.encoding, content.alpha};
}

Device deviceOf(const nlohmann::ordered_json &json) {
    return {json.at("name"), json.at("type"), json.at("driver"), json.at("isUsable"), core::jsonText(json)};
}

/// The first step at which the paths of the worst pixel part.
nlohmann::ordered_json divergenceOf(const core::ComparisonRun &run, const core::PreparedScene &scene,
                                    const core::ComparedRenders &renders) {
    const glm::uvec2 pixel = core::imagePixel(scene.crop, core::worstPixel(renders));
    return core::divergenceToJson(pixel, core::findFirstDivergence(*run.first, *run.second, scene, pixel));
}

} // namespace

std::vector<Device> devices() {
    return withThreads([] {
        std::vector<Device> all;
        for (const core::gpu::DeviceInfo &device : core::gpu::listDevices())
            all.push_back(deviceOf(core::deviceToJson(device, core::nobody())));
        all.push_back(deviceOf(core::referenceToJson()));
        return all;
    });
}

Difference diff(const Image &reference, const Image &test) {
    return guarded([&] {
        if (reference.width() != test.width() || reference.height() != test.height())
            throw Error(ErrorKind::Usage,
                        fmt::format("diff: found {} x {} and {} x {} pixels; allowed: images of one size",
                                    reference.width(), reference.height(), test.width(), test.height()));
        core::LoadedImage a = loadedOf(reference.content());
        core::LoadedImage b = loadedOf(test.content());
        if (a.encoding != b.encoding) {
            core::LoadedImage &linear = a.encoding == core::Encoding::Linear ? a : b;
            linear = core::asDisplayed(linear);
        }
        return differenceOf(core::compareImages(a, b), a.composite(), b.composite());
    });
}

Comparison compare(const Scene &scene, const Settings &settings, const std::string &device,
                   const std::string &against, const Watch &watch) {
    WatchObserver observer(watch);
    return watched(observer, [&] {
        const core::PreparedScene prepared =
            core::prepareScene(sceneOptionsOf(scene, settings), core::Source::Dropped, observer);
        core::requireFilmMemory(prepared.crop, 2,
                                2 * core::lightPlanesOf(prepared.packed, prepared.loaded.settings).count());
        const core::ComparisonRun run =
            core::openComparison({.device = device, .against = against}, prepared, observer);
        core::ComparedRenders renders = core::renderBoth(run, prepared, observer);
        observer.rethrow();
        if (observer.isStopped())
            throw Error(ErrorKind::Stopped, "stopped before both renders were finished");
        nlohmann::ordered_json json = core::comparisonRunToJson(run, prepared, byProgram);
        json.update(core::comparisonToJson(renders.comparison, renders.imageB, renders.imageA));
        json["areRayCountsEqual"] = renders.a.rays == renders.b.rays;
        const bool isEqual = renders.comparison.identical() && renders.differingLight == 0;
        if (!renders.comparison.identical())
            json["divergence"] = divergenceOf(run, prepared, renders);
        json["passed"] = isEqual;
        Difference difference = differenceOf(renders.comparison, renders.imageB, renders.imageA);
        const auto imageBy = [&](const core::Backend &backend, core::BackendResult &&result) {
            return imageOf(prepared, backend.identity(prepared.packed, prepared.loaded.settings.integrator),
                           std::move(result), {});
        };
        return Comparison{isEqual, imageBy(*run.first, std::move(renders.a)),
                          imageBy(*run.second, std::move(renders.b)), std::move(difference),
                          core::jsonText(json)};
    });
}

Profile profile(const Scene &scene, const Settings &settings, const ProfileOptions &options) {
    WatchObserver observer(options.watch);
    return watched(observer, [&] {
        core::MeasurementRequest request;
        request.scene = sceneOptionsOf(scene, settings);
        request.device = options.device;
        request.warmupCount = options.warmups;
        request.repeatCount = options.repeats;
        request.timeLimitSeconds = options.timeLimitSeconds;
        request.isCounting = options.countsWork;
        request.isUnverified = options.isUnverified;
        requireTimeLimit(request.timeLimitSeconds);
        if (request.warmupCount < 0 || request.repeatCount < 1)
            throw Error(ErrorKind::Usage,
                        fmt::format("profile: found {} warm-ups and {} repeats; allowed: at least 0 and 1",
                                    request.warmupCount, request.repeatCount));
        const core::MeasurementSubject subject = core::prepareMeasurement(request, byProgram, observer);
        const core::Measurement measured = core::measure(subject, request, false, observer);
        observer.rethrow();
        if (observer.isStopped())
            throw Error(ErrorKind::Stopped, "stopped before all frames were measured");
        if (measured.fault)
            throw Error(
                ErrorKind::DeviceLost,
                fmt::format("not verified: {}; nothing was measured. compare() says more", *measured.fault));
        Profile profile;
        profile.frameMillis = core::frameMillis(measured.profile);
        profile.medianMillis = core::quantile(profile.frameMillis, 0.5);
        std::uint64_t rays = 0;
        for (const core::DispatchRecord &dispatch : measured.profile.frames.back().timeline.dispatches)
            rays += dispatch.rays.total();
        profile.megaraysPerSecond = static_cast<double>(rays) / (profile.medianMillis * 1e3);
        profile.json = core::jsonText(core::profileToJson(measured.profile));
        return profile;
    });
}

std::string inspect(const Scene &scene, const Settings &settings, bool withCoverage, const Watch &watch) {
    WatchObserver observer(watch);
    return watched(observer, [&] {
        const core::PreparedScene prepared =
            core::prepareScene(sceneOptionsOf(scene, settings), core::Source::Kept, observer);
        std::optional<core::Coverage> coverage;
        if (withCoverage)
            coverage = core::measureCoverage(prepared);
        return core::jsonText(core::sceneToJson(core::summariseScene(prepared), coverage, {}, byProgram));
    });
}

Verification verify(const std::string &device, const std::vector<std::string> &kernels, const Watch &watch) {
    WatchObserver observer(watch);
    return watched(observer, [&] {
        std::vector<std::string> present;
        for (const std::string &kernel : kernels) {
            present.emplace_back(core::gpu::presentKernel(kernel));
            static_cast<void>(core::chosenFrom(core::gpu::namedKernels, present.back(), "kernels"));
        }
        const core::ShippedFilms shipped = core::readShippedFilms();
        observer.begin("verify", false);
        const std::array verdicts{
            core::verifyDevice(device, shipped, observer, present,
                               [&](const core::FilmVerdict &, double share) { observer.progress(share); })};
        observer.end();
        return Verification{verdicts[0].isPassed(),
                            core::jsonText(core::verificationToJson(shipped, verdicts, byProgram))};
    });
}

} // namespace hyalite
