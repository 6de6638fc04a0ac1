#include "hyalite/renderer.h"

#include "host/api/contents.h"
#include "host/engine/time_limit.h"
#include "host/gpu/render_config.h"
#include "host/jobs/denoising.h"
#include "host/jobs/layers.h"
#include "host/packing/light_planes.h"
#include "host/scene/limits.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <string>
#include <utility>

namespace hyalite {

struct Renderer::Content {
    std::unique_ptr<core::Backend> backend;
    std::timed_mutex mutex; ///< of a render
    // The last scene, and what it was prepared with.
    std::optional<core::PreparedScene> prepared;
    std::shared_ptr<const Scene::Content> scene;
    core::SceneOptions sceneOptions;
    core::RendererIdentity identity; ///< with the kernel for it

    /// Prepares the scene, or moves the one that is there. Another object is another scene: its file may have changed.
    void prepare(const Scene &wanted, core::SceneOptions &&options, core::Observer &observer) {
        if (prepared && scene == wanted.content() && core::isOtherView(*prepared, sceneOptions, options)) {
            core::changeView(*prepared, options);
            core::tellWarnings(prepared->loaded, observer);
        } else {
            prepared.reset(); // the memory first
            prepared = core::prepareScene(options, core::Source::Dropped, observer);
            scene = wanted.content();
            identity = backend->identity(prepared->packed, prepared->loaded.settings.integrator);
        }
        sceneOptions = std::move(options);
    }
};

namespace {

core::DeviceOptions deviceOptionsOf(const RendererOptions &options) {
    core::DeviceOptions device;
    if (!options.kernel.empty())
        device.kernel = core::chosenFrom(core::gpu::kernelNames,
                                         std::string(core::gpu::presentKernel(options.kernel)), "kernel");
    if (options.dispatchMillis > 0.0)
        device.maxDispatchMillis = options.dispatchMillis;
    return device;
}

/// The renderer's turn. While other threads have it, this one may be stopped.
std::unique_lock<std::timed_mutex> turnOf(Renderer::Content &content, WatchObserver &observer) {
    if (WatchObserver::isCalledBy(&content))
        throw Error(
            ErrorKind::Usage,
            "render: found a callback of this renderer; allowed: another renderer, or after the callback");
    constexpr std::chrono::milliseconds patience{50};
    std::unique_lock lock(content.mutex, std::defer_lock);
    while (!lock.try_lock_for(patience))
        if (observer.wantsStop())
            throw Error(ErrorKind::Stopped, "stopped before the render had its turn");
    return lock;
}

/// A task may have been stopped before it had anything to show.
void requireSample(const core::BackendResult &result) {
    if (std::ranges::all_of(result.film.pixels, [](const auto &pixel) { return pixel.sampleCount == 0; }))
        throw Error(ErrorKind::Stopped, "stopped before the first sample was finished");
}

} // namespace

Renderer::Renderer(const std::string &device, const RendererOptions &options)
    : content_(withThreads([&] {
          if (options.threads != 0 &&
              !core::limits::threadCount.contains(static_cast<double>(options.threads)))
              throw core::OverrideError(
                  "threads",
                  core::refusalText(std::to_string(options.threads),
                                    "a whole number " + core::limits::threadCount.text() + ", or 0 for all"));
          const Watch nothing;
          WatchObserver observer(nothing);
          auto content = std::make_unique<Content>();
          content->backend = core::openRenderers({device}, observer, {.threadCount = options.threads},
                                                 core::renderConfigFor(deviceOptionsOf(options)))
                                 .backend;
          return content;
      })) {}

Renderer::~Renderer() {
    if (isForked()) // waiting for threads that are not there would never end
        static_cast<void>(content_.release());
}

Renderer::Renderer(Renderer &&) noexcept = default;

Renderer &Renderer::operator=(Renderer &&other) noexcept {
    const Renderer old(std::move(*this)); // its destructor knows what to do
    content_ = std::move(other.content_);
    return *this;
}

std::string Renderer::name() const { return content_->backend->name(); }
std::string Renderer::description() const { return content_->backend->description(); }
std::string Renderer::equalBits() const { return core::gpu::describe(content_->backend->bits()); }

Image Renderer::render(const Scene &scene, const Settings &settings, const RenderOptions &options) {
    WatchObserver observer(options.watch, content_.get());
    return watched(observer, [&, scene = scene] { // as it is now, not when the turn comes
        const std::unique_lock turn = turnOf(*content_, observer);
        core::SceneOptions wanted = sceneOptionsOf(scene, settings, options.layers);
        content_->prepare(scene, std::move(wanted), observer);
        observer.rethrow();
        const core::PreparedScene &prepared = *content_->prepared;
        const core::RenderSettings &used = prepared.loaded.settings;
        const std::vector<core::PictureView> layers = core::viewsOf(prepared);
        core::requireFilmMemory(prepared.crop, 1 + static_cast<unsigned>(layers.size()),
                                core::lightPlanesOf(prepared.packed, used).count(),
                                core::denoisingBytes(used, prepared.crop, 1));
        requireTimeLimit(options.timeLimitSeconds);
        const core::TimeLimit limit(options.timeLimitSeconds);
        std::vector<core::ViewFilm> views =
            core::renderViews(*content_->backend, prepared, layers, {}, {}, observer, limit);
        core::BackendResult result = core::unlessFailed(
            core::render(*content_->backend, prepared.packed, used, core::Film(prepared.crop), observer,
                         {.name = "render", .limit = limit, .keepsFirst = true}));
        observer.rethrow();
        requireSample(result);
        std::optional<core::Image> clean;
        if (core::isToBeDenoised(used))
            clean = core::denoised(*content_->backend, result.film, views, observer);
        return imageOf(prepared, content_->identity, std::move(result), std::move(views), std::move(clean));
    });
}

} // namespace hyalite
