#include "tests/random/scene_check.h"

#include "host/base/error.h"
#include "host/engine/prepare.h"
#include "host/gpu/kernel_needs.h"
#include "host/reference/renderer.h"
#include "host/scene/names.h"
#include "tests/fixtures/subnormals.h"
#include "tests/fixtures/test_device.h"
#include "tests/fixtures/test_scene.h"
#include "tests/random/furnace.h"
#include "tests/random/scene_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyalite::core::testing {
namespace {

std::string describe(const Film &film, std::size_t index) {
    const layout::FilmPixel &pixel = film.pixels[index];
    const std::size_t width = static_cast<std::size_t>(film.crop.width());
    return fmt::format("pixel ({}, {}) = ({}, {}, {}) of {} samples", index % width, index / width,
                       pixel.sum.x, pixel.sum.y, pixel.sum.z, pixel.sampleCount);
}

/// Extreme scenes may exceed the largest float, and have infinities and their differences.
std::optional<Fault> impossibleRadiance(const Film &film, bool isExtreme) {
    for (std::size_t i = 0; i < film.pixels.size(); ++i)
        for (glm::length_t channel = 0; channel < 3; ++channel) {
            const float value = film.pixels[i].sum[channel];
            if (value < 0.0f)
                return Fault{FaultKind::Negative, describe(film, i)};
            if (!std::isfinite(value) && !isExtreme)
                return Fault{FaultKind::NotFinite, describe(film, i)};
        }
    return {};
}

/// Tries the two brightest pixels.
std::optional<Fault> gain(const Film &film, const PackedScene &packed, const RenderSettings &settings) {
    std::vector<std::size_t> order(film.pixels.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    const auto meanOf = [&](std::size_t i) {
        return film.pixels[i].sum.x / static_cast<float>(film.pixels[i].sampleCount);
    };
    const double limit = maxFurnaceRadiance(packed) * (1.0 + furnaceAllowance);
    constexpr std::ptrdiff_t triedCount = 2;
    std::ranges::partial_sort(order, order.begin() + triedCount, std::greater(), meanOf);
    for (std::ptrdiff_t i = 0; i < triedCount; ++i) {
        const auto index = order[static_cast<std::size_t>(i)];
        const int at = static_cast<int>(index);
        const int width = film.crop.width();
        if (static_cast<double>(meanOf(index)) > limit && gains(packed, settings, {at % width, at / width}))
            return Fault{FaultKind::Gains, describe(film, index)};
    }
    return {};
}

std::optional<Fault> difference(const Film &film, const RayCounts &rays, const std::string &whose,
                                const reference::Result &cpu) {
    std::size_t count = 0;
    std::size_t first = 0;
    for (std::size_t i = film.pixels.size(); i-- > 0;)
        if (!haveEqualBits(film, cpu.film, i)) {
            ++count;
            first = i;
        }
    if (count > 0)
        return Fault{FaultKind::Differs, fmt::format("{} of {} pixels differ; the first: {} {}, CPU {}",
                                                     count, film.pixels.size(), whose, describe(film, first),
                                                     describe(cpu.film, first))};
    if (rays != cpu.rays)
        return Fault{FaultKind::Differs, whose + " has other numbers of rays"};
    return {};
}

} // namespace

SceneCheck::SceneCheck(const std::vector<std::string> &kernels) {
    for (const gpu::KernelRow &row : gpu::kernelTable)
        if (std::ranges::count(kernels, row.name) > 0 ||
            (kernels.empty() && gpu::lackFor(row, testDevice()).empty()))
            kernels_.push_back(row.name);
    if (std::ranges::count(kernels, noKernel) > 0)
        kernels_.push_back(noKernel);
    if (kernels_.size() < kernels.size() || kernels_.empty())
        throw Error(ErrorKind::Usage, "a name that is not a kernel, or a device without any");
}

Way SceneCheck::wayOf(std::uint64_t seed, const std::string &integrator) const {
    const std::uint64_t kind = seed / scenesOfKind;
    Way way{kernels_[kind % kernels_.size()], kind / 4 % 4 == 3, kind % 5 == 4, kind % 7 == 6};
    if (integrator == nameOf(Integrator::Cost) && way.kernel != noKernel) // counts a traversal with a stack
        way.kernel = "stack";
    return way;
}

gpu::Renderer &SceneCheck::rendererOf(const Way &way) {
    const auto found = renderers_.find({way.kernel, way.isHurried});
    if (found != renderers_.end())
        return found->second;
    gpu::RenderConfig config{.kernel = gpu::findKernel(way.kernel)};
    if (way.isHurried) {
        config.steps = 61;
        config.samplesInFlight = 2;
        config.tileWidth = config.tileHeight = 16;
    }
    return renderers_.try_emplace({way.kernel, way.isHurried}, testDevice(), config).first->second;
}

std::optional<Fault> SceneCheck::faultOf(const RandomScene &scene, const Way &way,
                                         const std::filesystem::path &folder) {
    try {
        return faultOfFile(scene, way, writeDocument(scene.document, folder));
    } catch (const Error &error) {
        return Fault{FaultKind::Refused, error.what()};
    } catch (const nlohmann::json::exception &error) { // a shrunk document of another form
        return Fault{FaultKind::Refused, error.what()};
    }
}

std::optional<Fault> SceneCheck::faultOfFile(const RandomScene &drawn, const Way &way,
                                             const std::filesystem::path &file) {
    SceneOptions options;
    options.scene = file.string();
    options.isFlattened = way.isFlattened;
    const nlohmann::json given = drawn.document.at("scene").value("settings", nlohmann::json::object());
    const bool hasTree = given.value("bvh", std::string()) != "none"; // instances need one
    options.keepsInstances = !way.isFlattened && hasTree;
    PreparedScene prepared = prepareScene(options, Source::Kept, nobody());
    const RenderSettings &settings = prepared.loaded.settings;
    const Crop &crop = prepared.crop;
    PackedScene packed = way.isEncoded
                             ? packScene(prepared.loaded.scene, prepared.bvh, {settings.lightChoice, 0})
                             : std::move(prepared.packed);
    const reference::Result cpu = reference::render(packed, settings, crop);
    if (std::optional<Fault> fault = impossibleRadiance(cpu.film, drawn.isExtreme))
        return fault;
    if (drawn.isFurnace)
        if (std::optional<Fault> fault = gain(cpu.film, packed, settings))
            return fault;
    const auto onOneThread = [&] { return reference::render(packed, settings, crop, {.threadCount = 1}); };
    const reference::Result flushed = withSubnormalsFlushed(onOneThread);
    if (std::optional<Fault> fault = difference(flushed.film, flushed.rays, "CPU without subnormals", cpu))
        return fault;
    if (way.kernel == noKernel)
        return {};
    const gpu::Result device = rendererOf(way).render(packed, settings, crop);
    if (device.failure)
        throw *device.failure;
    return difference(device.film, device.rays, "device", cpu);
}

} // namespace hyalite::core::testing
