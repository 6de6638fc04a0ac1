#include "host/lab/tune.h"

#include "host/base/error.h"
#include "host/engine/open_backends.h"
#include "host/gpu/renderer.h"
#include "host/image/metrics.h"
#include "host/lab/trials.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

namespace hyalite::core {

namespace {

using Json = nlohmann::json;

constexpr int rounds = 4;
constexpr double gainNeeded = 1.05; // over the default kernel, in each round: less is noise
constexpr double shareNeeded =
    0.5; // of the best rate in the first round: slower kernels are not measured again

KernelRates measure(const Trial &trial, const std::string &deviceName, Observer &observer) {
    const PreparedScene scene = prepareTrial(trial);
    observer.beforeDriver(processorsFor(0, scene));
    const gpu::DeviceInfo device = gpu::chooseDevice(gpu::listDevices(), deviceName);
    const RenderSettings &settings = scene.loaded.settings;

    const gpu::Workload workload = gpu::workloadOf(scene.packed, settings.integrator);
    const gpu::KernelRow &usual = gpu::chooseKernel(device, workload);
    KernelRates rates{trial.workload, trial.scene, std::vector<double>(gpu::kernelTable.size(), 0.0), 0};
    std::vector<gpu::Renderer> renderers;
    for (const gpu::KernelRow &kernel : gpu::kernelTable) {
        if (&kernel == &usual)
            rates.best = renderers.size();
        renderers.emplace_back(device, gpu::RenderConfig{.kernel = &kernel});
    }
    std::vector<double> minGain(renderers.size(),
                                std::numeric_limits<double>::max()); // over the default kernel
    std::optional<Film> wanted;
    for (int round = 0; round < rounds; ++round) {
        const double bestRate = std::ranges::max(rates.megaraysPerSecond);
        std::vector<double> rateNow(renderers.size(), 0.0);
        for (std::size_t i = 0; i < renderers.size(); ++i) {
            const bool isSlow = rates.megaraysPerSecond[i] < shareNeeded * bestRate && i != rates.best;
            if (isSlow || gpu::kernelTable[i].suits.placeOn(device, workload) == 0)
                continue;
            gpu::Result result = renderers[i].render(scene.packed, settings, scene.crop);
            if (result.failure)
                throw Error(*result.failure);
            if (!wanted)
                wanted = std::move(result.film);
            else if (device.areBitsPromised() && differingPixelCount(*wanted, result.film) > 0)
                throw Error(ErrorKind::DeviceLost,
                            fmt::format("the kernels {} and {} render {} differently on {}",
                                        gpu::kernelTable.front().name, gpu::kernelTable[i].name, trial.scene,
                                        device.name),
                            Remedy::CompareRenders);
            rateNow[i] = static_cast<double>(result.rays.total()) * 1e-6 /
                         std::max(result.timing.renderSeconds, std::numeric_limits<double>::min());
        }
        for (std::size_t i = 0; i < renderers.size(); ++i) {
            minGain[i] = std::min(minGain[i], rateNow[i] / rateNow[rates.best]);
            rates.megaraysPerSecond[i] = std::max(rates.megaraysPerSecond[i], rateNow[i]);
        }
    }
    const auto fastest = std::ranges::max_element(minGain);
    if (*fastest > gainNeeded)
        rates.best = static_cast<std::size_t>(fastest - minGain.begin());
    return rates;
}

Json toJson(const KernelRates &rates) { return {{"rates", rates.megaraysPerSecond}, {"best", rates.best}}; }

} // namespace

std::vector<KernelRates> measureKernels(const std::string &deviceName, Observer &observer,
                                        const RunApart &runApart) {
    std::vector<KernelRates> all;
    for (const Trial &trial : trials) {
        const Json result = runApart([&] { return toJson(measure(trial, deviceName, observer)); });
        all.push_back({trial.workload, trial.scene, result.at("rates"), result.at("best")});
    }
    return all;
}

} // namespace hyalite::core
