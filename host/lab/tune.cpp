#include "host/lab/tune.h"

#include "host/base/error.h"
#include "host/engine/opening.h"
#include "host/engine/prepare.h"
#include "host/gpu/renderer.h"
#include "host/image/metrics.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <limits>
#include <new>
#include <optional>
#include <utility>

namespace hyalite {

namespace {

using Json = nlohmann::json;

/// A scene for each workload, with enough samples per pixel to fill the lanes of a subgroup.
struct Trial {
    gpu::Workload workload;
    const char *scene;
    int samplesPerPixel;
};

constexpr std::array<Trial, gpu::workloadNames.size()> trials{{{gpu::Workload::Spheres, "spheres", 4},
                                                               {gpu::Workload::Triangles, "cat", 8},
                                                               {gpu::Workload::Shading, "studio-cat", 8}}};
constexpr int imageSide = 192; // pixels
constexpr int rounds = 4;
constexpr double gainNeeded = 1.05; // over the default kernel, in each round: less is noise
constexpr double shareNeeded =
    0.5; // of the best rate in the first round: slower kernels are not measured again

KernelRates measure(const Trial &trial, const std::string &deviceName) {
    SceneOptions options;
    options.scene = trial.scene;
    options.width = options.height = imageSide;
    options.settings.push_back(
        {[&trial](RenderSettings &settings) { settings.samplesPerPixel = trial.samplesPerPixel; }});
    const PreparedScene scene = prepareScene(options, Source::Dropped, true);
    gpu::tellLavapipe(processorsFor(0, scene));
    const gpu::DeviceInfo device = gpu::chooseDevice(gpu::listDevices(), deviceName);
    const RenderSettings &settings = scene.loaded.scene.settings;

    const gpu::Workload workload = gpu::workloadOf(scene.packed, settings.integrator);
    const std::string_view usual = gpu::kernelName(gpu::completed({}, device, workload));
    KernelRates rates{trial.workload, trial.scene, std::vector<double>(gpu::namedKernels.size(), 0.0), 0};
    std::vector<gpu::Renderer> renderers;
    for (const auto &[name, choice] : gpu::namedKernels) {
        gpu::RenderConfig config;
        config.traversal = choice.traversal;
        config.slotsPerInvocation = choice.slotsPerInvocation;
        if (name == usual)
            rates.best = renderers.size();
        renderers.emplace_back(device, config);
    }
    std::vector<double> minGain(renderers.size(),
                                std::numeric_limits<double>::max()); // over the default kernel
    std::optional<Film> wanted;
    for (int round = 0; round < rounds; ++round) {
        const double bestRate = std::ranges::max(rates.megaraysPerSecond);
        std::vector<double> rateNow(renderers.size(), 0.0);
        for (std::size_t i = 0; i < renderers.size(); ++i) {
            if (rates.megaraysPerSecond[i] < shareNeeded * bestRate && i != rates.best)
                continue;
            gpu::Result result = renderers[i].render(scene.packed, settings, scene.crop);
            if (result.failure)
                throw Error(*result.failure);
            if (!wanted)
                wanted = std::move(result.film);
            else if (device.areBitsPromised() && differingPixelCount(*wanted, result.film) > 0)
                throw Error(ErrorKind::DeviceLost,
                            fmt::format("the kernels {} and {} render {} differently on {}",
                                        gpu::namedKernels.front().first, gpu::namedKernels[i].first,
                                        trial.scene, device.name),
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

/// Reads until the writer closes the pipe.
std::string drain(int pipe) {
    std::string text;
    std::array<char, 4096> block{};
    for (;;) {
        const ssize_t count = read(pipe, block.data(), block.size());
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return text;
        text.append(block.data(), static_cast<std::size_t>(count));
    }
}

/// Runs `work`, writes its result or error, and exits without destructors: objects of the parent are not ours to
/// destroy.
[[noreturn]] void sendResult(int pipe, const std::function<Json()> &work) {
    Json said;
    try {
        said["result"] = work();
    } catch (const Error &error) {
        said = {{"kind", static_cast<int>(error.kind)}, {"error", error.what()}};
    } catch (const std::bad_alloc &) {
        said = {{"kind", static_cast<int>(ErrorKind::LimitExceeded)}, {"error", "out of memory"}};
    } catch (const std::exception &error) {
        said = {{"kind", static_cast<int>(ErrorKind::Internal)}, {"error", error.what()}};
    }
    const std::string text = said.dump(); // fits into the buffer of a pipe
    const bool isWritten = write(pipe, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    _exit(isWritten ? 0 : 1);
}

/// Runs `work` in a process of its own and returns its result. Throws the Error that it throws.
Json inOwnProcess(const std::function<Json()> &work) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("pipe for a measurement: {}", std::strerror(errno)));
    const pid_t child = fork();
    if (child == 0)
        sendResult(ends[1], work);
    const int forkError = errno;
    close(ends[1]);
    const std::string text = child > 0 ? drain(ends[0]) : std::string();
    close(ends[0]);
    if (child < 0)
        throw Error(ErrorKind::LimitExceeded,
                    fmt::format("fork for a measurement: {}", std::strerror(forkError)));
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status))
        throw Error(ErrorKind::DeviceLost, fmt::format("a measurement was killed by signal {}: {}",
                                                       WTERMSIG(status), strsignal(WTERMSIG(status))));
    const Json said = Json::parse(text);
    if (said.contains("error"))
        throw Error(static_cast<ErrorKind>(said.at("kind").get<int>()), said.at("error"));
    return said.at("result");
}

} // namespace

std::vector<KernelRates> measureKernels(const std::string &deviceName) {
    std::vector<KernelRates> all;
    for (const Trial &trial : trials) {
        const Json result = inOwnProcess([&] { return toJson(measure(trial, deviceName)); });
        all.push_back({trial.workload, trial.scene, result.at("rates"), result.at("best")});
    }
    return all;
}

} // namespace hyalite
