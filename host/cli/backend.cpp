#include "host/cli/backend.h"

#include "host/reference/renderer.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

namespace hyalite {

namespace {

class CpuBackend : public Backend {
  public:
    CpuBackend(reference::Precision precision, int threadCount)
        : precision_(precision), threadCount_(threadCount) {}

    [[nodiscard]] std::string name() const override {
        return precision_ == reference::Precision::Float32 ? "cpu" : "cpu-double";
    }
    [[nodiscard]] std::string driver() const override { return "reference renderer"; }
    [[nodiscard]] std::string description() const override {
        return precision_ == reference::Precision::Float32
                   ? "cpu, the reference renderer"
                   : "cpu-double, the reference renderer in double precision";
    }
    [[nodiscard]] BackendResult render(const PreparedScene &scene,
                                       const std::function<void(double)> &onProgress) override {
        using Clock = std::chrono::steady_clock;
        const Clock::time_point start = Clock::now();
        reference::Result result = reference::render(scene.packed, scene.loaded.scene.settings, scene.crop,
                                                     {precision_, threadCount_, onProgress});
        RenderTiming timing;
        timing.renderSeconds = std::chrono::duration<double>(Clock::now() - start).count();
        return {std::move(result.film), result.rays, timing};
    }
    [[nodiscard]] std::vector<layout::TraceEvent> trace(const PreparedScene &scene, const glm::uvec2 &pixel,
                                                        std::uint32_t sampleIndex) override {
        return reference::trace(scene.packed, scene.loaded.scene.settings, pixel, sampleIndex, precision_);
    }

  private:
    reference::Precision precision_;
    int threadCount_;
};

class DeviceBackend : public Backend {
  public:
    DeviceBackend(const gpu::DeviceInfo &device, const gpu::Batching &batching)
        : device_(device), renderer_(device, batching) {}

    [[nodiscard]] std::string name() const override { return device_.name; }
    [[nodiscard]] std::string driver() const override { return device_.driver; }
    [[nodiscard]] std::string description() const override {
        return fmt::format("{}, {} ({}){}", device_.index, device_.name, device_.driver,
                           device_.isSoftware() ? ": a software device, it computes on the CPU" : "");
    }
    [[nodiscard]] BackendResult render(const PreparedScene &scene,
                                       const std::function<void(double)> &onProgress) override {
        gpu::Result result =
            renderer_.render(scene.packed, scene.loaded.scene.settings, scene.crop, onProgress);
        return {std::move(result.film), result.rays, result.timing};
    }
    [[nodiscard]] std::vector<layout::TraceEvent> trace(const PreparedScene &scene, const glm::uvec2 &pixel,
                                                        std::uint32_t sampleIndex) override {
        return renderer_.trace(scene.packed, scene.loaded.scene.settings, pixel, sampleIndex);
    }

  private:
    gpu::DeviceInfo device_;
    gpu::Renderer renderer_;
};

} // namespace

std::unique_ptr<Backend> openBackend(const std::string &name, int threadCount,
                                     const gpu::Batching &batching) {
    if (name == "cpu")
        return std::make_unique<CpuBackend>(reference::Precision::Float32, threadCount);
    if (name == "cpu-double")
        return std::make_unique<CpuBackend>(reference::Precision::Float64, threadCount);
    // lavapipe reads the number of its threads when its driver is loaded.
    if (threadCount > 0)
        setenv("LP_NUM_THREADS", std::to_string(threadCount).c_str(), 1);
    return std::make_unique<DeviceBackend>(gpu::chooseDevice(gpu::listDevices(), name), batching);
}

} // namespace hyalite
