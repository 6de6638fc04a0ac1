// The renderers that a command can name: Vulkan devices, the CPU twin, and the oracle in double precision.
#pragma once

#include "host/film/ray_counts.h"
#include "host/film/timeline.h"
#include "host/film/work_counts.h"
#include "host/gpu/processor_use.h"
#include "host/gpu/renderer.h"
#include "host/render/prepare.h"
#include "host/report/provenance.h"

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyalite {

struct BackendResult {
    Film film;
    RayCounts rays;           ///< traced by this call
    RenderTiming timing;      ///< only renderSeconds on the CPU
    WorkCounts work;          ///< all 0 unless counting was asked for, or the integrator is the cost
    LaneCounts lanes{};       ///< of a device, likewise
    gpu::MemoryPlan memory{}; ///< what it took of a device at most, and of the host for it
    std::vector<std::string>
        faults{}; ///< Vulkan calls that failed; after all of them, or all but the last, it went on
    std::optional<Error>
        failure{}; ///< why the render ended before all was finished, where the device was at fault
};

class Backend {
  public:
    virtual ~Backend() = default;

    [[nodiscard]] virtual std::string name() const = 0;        ///< "cpu", or as the device calls itself
    [[nodiscard]] virtual std::string description() const = 0; ///< for people
    [[nodiscard]] virtual RendererIdentity identity(const PackedScene &scene,
                                                    Integrator integrator) const = 0; ///< as what renders it
    /// Why images may differ from the CPU twin's in their bits, or empty where they may not.
    [[nodiscard]] virtual std::string unpromisedBits() const { return {}; }
    /// Backends that say the same add samples of the same bits to a film, and a film gives them all that they need to go
    /// on; empty: it does not.
    [[nodiscard]] virtual std::string precision() const { return "float32"; }
    /// `timeline`, where there is one, gets what was done when. Where `shouldStop`, which several threads may ask at
    /// once, says so, the film has the samples that are finished by then.
    [[nodiscard]] virtual BackendResult render(const PreparedScene &scene,
                                               const std::function<void(double)> &onProgress,
                                               Timeline *timeline, const std::function<bool()> &shouldStop,
                                               Continuation continuation) = 0;
    /// What one sample of one pixel of the whole image does.
    [[nodiscard]] virtual std::vector<layout::TraceEvent>
    trace(const PreparedScene &scene, const glm::uvec2 &pixel, std::uint32_t sampleIndex) = 0;
};

/// Renders with a progress line that `task` begins. Throws Error{LimitExceeded} with the film's size where there is not
/// the memory for it. Faults of the device are told; where a render that cannot be stopped, of which a part is of no
/// use, fails for them, its failure is thrown.
[[nodiscard]] BackendResult renderWithProgress(Backend &backend, const PreparedScene &scene,
                                               const std::string &task, bool isQuiet,
                                               Timeline *timeline = nullptr,
                                               const std::function<bool()> &shouldStop = {},
                                               Continuation continuation = {});

/// Throws Error{LimitExceeded} where memory cannot hold so many films of the crop and the images made of them.
void requireFilmMemory(const Crop &crop, unsigned filmCount);

/// Whether openBackend opens the reference renderer by this name.
[[nodiscard]] bool isReference(const std::string &name);

/// How a Vulkan device is to work; the image does not depend on it.
struct DeviceOptions {
    std::optional<gpu::KernelChoice> kernel;
    double maxDispatchMillis = gpu::RenderConfig{}.dispatchSeconds * 1e3;
};

/// What openBackend takes of them.
[[nodiscard]] gpu::RenderConfig renderConfigFor(const DeviceOptions &options);

/// How a scene is best rendered on the processors, by so many threads; 0: all.
[[nodiscard]] gpu::ProcessorUse processorsFor(int threadCount, const SceneOutline &outline);
[[nodiscard]] gpu::ProcessorUse processorsFor(int threadCount, const PreparedScene &scene);

/// Opens "cpu", "cpu-double", or a device by "auto", index or part of its name. What `processors` asks of lavapipe holds
/// where it is for the first device that is opened. Throws Error{NoDevice}, and Error{Usage} where the reference renderer
/// is asked for a kernel.
[[nodiscard]] std::unique_ptr<Backend> openBackend(const std::string &name,
                                                   const gpu::ProcessorUse &processors = {},
                                                   const gpu::RenderConfig &config = {});

/// The same, while the caller does something else. A render config's kernel must outlive the opening.
[[nodiscard]] std::future<std::unique_ptr<Backend>> beginOpeningBackend(const std::string &name,
                                                                        const gpu::ProcessorUse &processors,
                                                                        const gpu::RenderConfig &config = {});

} // namespace hyalite
