#include "host/engine/device_backend.h"

#include "host/base/error.h"
#include "host/engine/tuning.h"
#include "host/gpu/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace hyalite::core {

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

class DeviceBackend : public Backend {
  public:
    DeviceBackend(const gpu::DeviceInfo &device, const gpu::RenderConfig &config, Observer &observer)
        : DeviceBackend(device, config, readTuning(device, observer), observer) {}

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
    [[nodiscard]] BackendResult render(const PackedScene &scene, const RenderSettings &settings, Film begun,
                                       const RenderHooks &hooks) override {
        gpu::Result result = renderer_.render(scene, settings, std::move(begun), hooks);
        return {std::move(result.film), result.rays,   result.timing, result.work,
                result.lanes,           result.memory, result.faults, result.failure};
    }
    void repeat(const PackedScene &scene, const RenderSettings &settings, const Film &expected,
                const RepeatHooks &hooks) override {
        renderer_.repeat(scene, settings, expected, hooks);
    }
    [[nodiscard]] std::vector<layout::TraceEvent> trace(const PackedScene &scene,
                                                        const RenderSettings &settings,
                                                        const glm::uvec2 &pixel,
                                                        std::uint32_t sampleIndex) override {
        return renderer_.trace(scene, settings, pixel, sampleIndex);
    }
    [[nodiscard]] Image denoise(const NoisyPicture &picture) override { return renderer_.denoise(picture); }

  private:
    DeviceBackend(const gpu::DeviceInfo &device, const gpu::RenderConfig &config, const Tuning &tuning,
                  Observer &observer)
        : device_(withTuning(device, tuning)), renderer_(device_, config, tuning.kernels),
          bits_(guaranteeOf(renderer_.bits(), tuning)) {
        if (device_.hasSlowShuffles != renderer_.device().hasSlowShuffles)
            keepLaneExchange(tuning, observer);
    }

    static gpu::DeviceInfo withTuning(gpu::DeviceInfo device, const Tuning &tuning) {
        device.hasSlowShuffles = tuning.hasSlowShuffles;
        return device;
    }

    /// Keeps what was measured just now, which takes a tenth of the time of a small render.
    void keepLaneExchange(Tuning tuning, Observer &observer) const {
        tuning.hasSlowShuffles = renderer_.device().hasSlowShuffles;
        try {
            storeTuning(device_, tuning, observer);
        } catch (const Error &) { // the next render measures again
        }
    }

    gpu::DeviceInfo device_;
    gpu::Renderer renderer_;
    gpu::BitGuarantee bits_;
};

} // namespace

std::unique_ptr<Backend> makeDeviceBackend(const gpu::DeviceInfo &device, const gpu::RenderConfig &config,
                                           Observer &observer) {
    return std::make_unique<DeviceBackend>(device, config, observer);
}

} // namespace hyalite::core
