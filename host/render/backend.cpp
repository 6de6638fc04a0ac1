#include "host/render/backend.h"

#include "host/base/error.h"
#include "host/base/host_memory.h"
#include "host/base/message.h"
#include "host/base/quantities.h"
#include "host/gpu/vk/instance.h"
#include "host/reference/renderer.h"
#include "host/render/tuning.h"
#include "host/report/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <new>
#include <optional>
#include <utility>

namespace hyalite {

namespace {

/// The part of `driver` that `name` does not say: "Mesa 22.3.6" for the driver "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)" of
/// the device "llvmpipe (LLVM 15.0.6, 256 bits)"; empty for "SwiftShader driver".
std::string driverBesideName(const std::string &driver, const std::string &name) {
    std::string text = driver.substr(0, driver.find(" ("));
    const std::size_t firstWordEnd = std::min(text.find(' '), text.size());
    if (name.starts_with(text.substr(0, firstWordEnd)))
        text.erase(0, firstWordEnd + 1);
    return text == "driver" ? std::string() : text;
}

class CpuBackend : public Backend {
  public:
    CpuBackend(reference::Precision precision, int threadCount)
        : precision_(precision), threadCount_(threadCount) {}

    [[nodiscard]] std::string name() const override {
        return precision_ == reference::Precision::Float32 ? "cpu" : "cpu-double";
    }
    [[nodiscard]] RendererIdentity identity(const PackedScene &, Integrator) const override {
        return {name(),
                "reference renderer",
                "native / and sqrt: IEEE 754",
                precision_ == reference::Precision::Float32 ? "promised"
                                                            : "none: it computes in double precision",
                "",
                0};
    }
    [[nodiscard]] std::string precision() const override {
        // A film holds sums in single precision.
        return precision_ == reference::Precision::Float32 ? Backend::precision() : std::string();
    }
    [[nodiscard]] std::string description() const override {
        return precision_ == reference::Precision::Float32
                   ? "cpu, the reference renderer"
                   : "cpu-double, the reference renderer in double precision";
    }
    [[nodiscard]] BackendResult render(const PreparedScene &scene,
                                       const std::function<void(double)> &onProgress, Timeline *timeline,
                                       const std::function<bool()> &shouldStop,
                                       Continuation continuation) override {
        const RenderSettings &settings = scene.loaded.scene.settings;
        Stopwatch watch;
        reference::Result result = reference::render(
            scene.packed, settings, scene.crop, {precision_, threadCount_, onProgress, false, shouldStop},
            std::move(continuation));
        const Span span = watch.lap();
        if (timeline != nullptr) {
            timeline->clock = "the host's clock, from call to return";
            timeline->stages.push_back({"dispatches", span});
            timeline->dispatches.push_back(describeCall(scene, result.rays, span));
        }
        RenderTiming timing;
        timing.renderSeconds = span.seconds();
        return {std::move(result.film), result.rays, timing, result.work, {}};
    }
    [[nodiscard]] std::vector<layout::TraceEvent> trace(const PreparedScene &scene, const glm::uvec2 &pixel,
                                                        std::uint32_t sampleIndex) override {
        return reference::trace(scene.packed, scene.loaded.scene.settings, pixel, sampleIndex, precision_);
    }

  private:
    /// The whole render as one dispatch of one tile.
    [[nodiscard]] DispatchRecord describeCall(const PreparedScene &scene, const RayCounts &rays,
                                              const Span &span) const {
        DispatchRecord record;
        record.kernel = name();
        record.tileX = scene.crop.x0;
        record.tileY = scene.crop.y0;
        record.tileWidth = scene.crop.width();
        record.tileHeight = scene.crop.height();
        record.sampleEnd = static_cast<std::uint32_t>(scene.loaded.scene.settings.samplesPerPixel);
        record.rays = rays;
        record.invocations =
            static_cast<std::uint64_t>(record.tileWidth) * static_cast<std::uint64_t>(record.tileHeight);
        record.times.host = span;
        return record;
    }

    reference::Precision precision_;
    int threadCount_;
};

class DeviceBackend : public Backend {
  public:
    DeviceBackend(const gpu::DeviceInfo &device, const gpu::RenderConfig &config)
        : DeviceBackend(device, config, readTuning(device)) {}

    [[nodiscard]] std::string name() const override { return device_.name; }
    [[nodiscard]] RendererIdentity identity(const PackedScene &scene, Integrator integrator) const override {
        const gpu::ArithmeticChoice &choice = renderer_.arithmetic();
        return {device_.name,
                device_.driver,
                fmt::format("{} / and sqrt: {}", choice.isNative ? "native" : "own", choice.reason),
                gpu::describe(bits_),
                std::string(renderer_.kernelName(scene, integrator)),
                renderer_.kernelHash(scene, integrator)};
    }
    [[nodiscard]] gpu::BitGuarantee bits() const override { return bits_; }
    [[nodiscard]] std::string precision() const override {
        return bits().degree == gpu::BitDegree::None
                   ? fmt::format("float32 of {}, {}", device_.name, device_.driver)
                   : Backend::precision();
    }
    [[nodiscard]] std::string description() const override {
        const std::string driver = driverBesideName(device_.driver, device_.name);
        return fmt::format("{}, {}{}{}{}", device_.index, device_.name, driver.empty() ? "" : ", ", driver,
                           device_.isSoftware() ? ": software, computes on the CPU" : "");
    }
    [[nodiscard]] BackendResult render(const PreparedScene &scene,
                                       const std::function<void(double)> &onProgress, Timeline *timeline,
                                       const std::function<bool()> &shouldStop,
                                       Continuation continuation) override {
        gpu::Result result = renderer_.render(scene.packed, scene.loaded.scene.settings, scene.crop,
                                              onProgress, timeline, shouldStop, std::move(continuation));
        return {std::move(result.film), result.rays,   result.timing, result.work,
                result.lanes,           result.memory, result.faults, result.failure};
    }
    [[nodiscard]] std::vector<layout::TraceEvent> trace(const PreparedScene &scene, const glm::uvec2 &pixel,
                                                        std::uint32_t sampleIndex) override {
        return renderer_.trace(scene.packed, scene.loaded.scene.settings, pixel, sampleIndex);
    }

  private:
    DeviceBackend(const gpu::DeviceInfo &device, const gpu::RenderConfig &config, const Tuning &tuning)
        : device_(withTuning(device, tuning)), renderer_(device_, config, tuning.kernels),
          bits_(guaranteeOf(renderer_.bits(), tuning)) {
        if (device_.hasSlowShuffles != renderer_.device().hasSlowShuffles)
            keepLaneExchange(tuning);
    }

    static gpu::DeviceInfo withTuning(gpu::DeviceInfo device, const Tuning &tuning) {
        device.hasSlowShuffles = tuning.hasSlowShuffles;
        return device;
    }

    /// Keeps what was measured just now, which takes a tenth of the time of a small render.
    void keepLaneExchange(Tuning tuning) const {
        tuning.hasSlowShuffles = renderer_.device().hasSlowShuffles;
        try {
            storeTuning(device_, tuning);
        } catch (const Error &) { // the next render measures again
        }
    }

    gpu::DeviceInfo device_;
    gpu::Renderer renderer_;
    gpu::BitGuarantee bits_;
};

/// Memory for a film and its image. Tone mapping and packing come later and take less.
std::uint64_t filmBytes(const Crop &crop) {
    return static_cast<std::uint64_t>(crop.width()) * static_cast<std::uint64_t>(crop.height()) *
           (sizeof(layout::FilmPixel) + sizeof(glm::vec3));
}

[[noreturn]] void refuseFilm(const Crop &crop, std::uint64_t neededBytes, const std::string &available) {
    throw Error(ErrorKind::LimitExceeded,
                fmt::format("{}x{} pixels take {} of memory, and {}", crop.width(), crop.height(),
                            sizeText(neededBytes), available),
                Remedy::SmallerImage);
}

gpu::LoadedDevices loadDevices() {
    try {
        return gpu::loadDevices();
    } catch (const Error &error) {
        if (error.kind != ErrorKind::NoDevice)
            throw;
        throw Error(error.kind, error.what(), Remedy::ReferenceInstead);
    }
}

std::unique_ptr<Backend> open(const std::string &name, int threadCount, const gpu::RenderConfig &config) {
    if (isReference(name) && config.traversal != gpu::Traversal::Automatic)
        throw Error(ErrorKind::Usage,
                    fmt::format("only Vulkan devices have kernels to choose from, {} has none", name),
                    Remedy::NoKernelChoice);
    if (name == "cpu")
        return std::make_unique<CpuBackend>(reference::Precision::Float32, threadCount);
    if (name == "cpu-double")
        return std::make_unique<CpuBackend>(reference::Precision::Float64, threadCount);
    reserveHeap();                                   // for the driver's compiler
    const gpu::LoadedDevices loaded = loadDevices(); // until the chosen device has an instance of its own
    return std::make_unique<DeviceBackend>(gpu::chooseDevice(loaded.devices, name), config);
}

void tellLavapipe(gpu::ProcessorUse processors, const gpu::RenderConfig &config) {
    processors.hasStack = config.traversal == gpu::Traversal::Stack;
    gpu::tellLavapipe(processors);
}

} // namespace

void requireFilmMemory(const Crop &crop, unsigned filmCount) {
    const std::uint64_t neededBytes = filmCount * filmBytes(crop);
    const std::optional<std::uint64_t> available = availableHostBytes();
    if (available && neededBytes > *available)
        refuseFilm(crop, neededBytes, sizeText(*available) + " are available");
}

BackendResult renderWithProgress(Backend &backend, const PreparedScene &scene, const std::string &task,
                                 bool isQuiet, Timeline *timeline, const std::function<bool()> &shouldStop,
                                 Continuation continuation) {
    ProgressLine progress(task, isQuiet);
    const double others = continuation.shareOfOthers;
    if (!isReference(backend.name()))
        progress.expectCompiler();
    try {
        BackendResult result = backend.render(
            scene, [&](double share) { progress.update(std::max(share - others, 0.0) / (1.0 - others)); },
            timeline, shouldStop, std::move(continuation));
        if (result.failure && !shouldStop)
            throw Error(*result.failure);
        const std::size_t survived = result.faults.size() - (result.failure ? 1 : 0);
        for (std::size_t i = 0; i < survived; ++i)
            printMessage("note: {}; reopened the device to do half as much at a time\n", result.faults[i]);
        return result;
    } catch (const std::bad_alloc &) {
        refuseFilm(scene.crop, filmBytes(scene.crop), "that much is not to be had");
    }
}

bool isReference(const std::string &name) { return name == "cpu" || name == "cpu-double"; }

gpu::RenderConfig renderConfigFor(const DeviceOptions &options) {
    gpu::RenderConfig config;
    config.dispatchSeconds = options.maxDispatchMillis * 1e-3;
    if (options.kernel) {
        config.traversal = options.kernel->traversal;
        config.slotsPerInvocation = options.kernel->slotsPerInvocation;
    }
    return config;
}

gpu::ProcessorUse processorsFor(int threadCount, const SceneOutline &outline) {
    return {threadCount, outline.hasMeshes, outline.settings.integrator, outline.settings.maxDepth};
}

gpu::ProcessorUse processorsFor(int threadCount, const PreparedScene &scene) {
    return processorsFor(threadCount, SceneOutline{scene.packed.hasTriangles, scene.loaded.scene.settings});
}

std::unique_ptr<Backend> openBackend(const std::string &name, const gpu::ProcessorUse &processors,
                                     const gpu::RenderConfig &config) {
    tellLavapipe(processors, config);
    return open(name, processors.threadCount, config);
}

std::future<std::unique_ptr<Backend>> beginOpeningBackend(const std::string &name,
                                                          const gpu::ProcessorUse &processors,
                                                          const gpu::RenderConfig &config) {
    tellLavapipe(processors, config); // here, as other threads may read the environment from now on
    return std::async(std::launch::async, [=] { return open(name, processors.threadCount, config); });
}

} // namespace hyalite
