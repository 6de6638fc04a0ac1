// Opening renderers by name: Vulkan devices, the CPU twin, and the double twin.
#pragma once

#include "host/engine/backend.h"
#include "host/engine/prepare.h"
#include "host/gpu/processor_use.h"
#include "host/gpu/render_config.h"

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

/// Whether openBackend opens the reference renderer by this name.
[[nodiscard]] bool isReference(const std::string &name);

/// Options of a Vulkan device. None affects the image.
struct DeviceOptions {
    std::optional<const gpu::KernelRow *> kernel; ///< null: by device and scene
    double maxDispatchMillis = gpu::RenderConfig{}.dispatchSeconds * 1e3;
};

/// The render config for these options.
[[nodiscard]] gpu::RenderConfig renderConfigFor(const DeviceOptions &options);

/// The best use of the processors for a scene. `threadCount` 0: all threads.
[[nodiscard]] gpu::ProcessorUse processorsFor(int threadCount, const SceneOutline &outline);
[[nodiscard]] gpu::ProcessorUse processorsFor(int threadCount, const PreparedScene &scene);

/// Opens "cpu", "cpu-double", or a device by "auto", index or part of its name. The observer is asked for settings of
/// the driver first, if there is one. Throws Error{NoDevice}, and Error{Usage} if a kernel is chosen for the reference
/// renderer.
[[nodiscard]] std::unique_ptr<Backend> openBackend(const std::string &name, Observer &observer,
                                                   const gpu::ProcessorUse &processors = {},
                                                   const gpu::RenderConfig &config = {});

/// Names of renderers, as openBackend() takes them; several, or "all".
using RendererNames = std::vector<std::string>;

struct OpenedRenderers {
    std::unique_ptr<Backend> backend;
    std::vector<std::string> notes; ///< who is left out, each with the reason
};

/// Opens one renderer, or several that share each picture (shared_backend.h). "all" is every usable device, and the CPU
/// unless a software device computes on it, too. Of several, those that cannot be opened, or whose bits are their own,
/// are left out. Throws Error{NoDevice} if none is left, and OverrideError "device" for names that do not go together.
[[nodiscard]] OpenedRenderers openRenderers(const RendererNames &names, Observer &observer,
                                            const gpu::ProcessorUse &processors = {},
                                            const gpu::RenderConfig &config = {});

/// The same, in a thread of its own. `config.spirv` refers to memory that, as the observer, must live until the future
/// is ready.
[[nodiscard]] std::future<OpenedRenderers> beginOpeningRenderers(const RendererNames &names,
                                                                 Observer &observer,
                                                                 const gpu::ProcessorUse &processors,
                                                                 const gpu::RenderConfig &config = {});

} // namespace hyalite::core
