// Renderer: a Vulkan device, or the CPU twin, that is opened once and renders many images.
#pragma once

#include "hyalite/image.h"
#include "hyalite/scene.h"
#include "hyalite/settings.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyalite {

enum class MessageKind {
    Warning, ///< something in the input is lost, or damages the picture
    Note,    ///< something goes on otherwise than it was asked for
    Advice   ///< the picture may be other than people expect, for a reason that is in the scene
};

/// Callbacks while something is loaded or rendered; empty ones are not called. What one throws ends the work when the
/// running dispatch ends, and then passes through; the renderer can be used again. None may use the renderer.
struct Watch {
    /// The share of a task ("load", "render", "albedo", ...) that is finished, in [0, 1]. By one thread at a time.
    std::function<void(const std::string &task, double share)> progress{};
    /// By any thread.
    std::function<void(MessageKind kind, const std::string &text)> message{};
    /// Asked several times a second, by any thread: true ends the work with what is finished.
    std::function<bool()> shouldStop{};
};

struct RendererOptions {
    int threads = 0;             ///< of the CPU twin; 0: all
    std::string kernel{};        ///< of a device, for experiments; empty: the best for the scene
    double dispatchMillis = 0.0; ///< the longest dispatch that is aimed at; 0: the default
};

/// What a render is asked for beside the settings.
struct RenderOptions {
    std::vector<std::string> layers{}; ///< views beside the colours: "albedo", "normal", "depth", "id", ...
    std::optional<double> timeLimitSeconds{}; ///< then it ends with what is finished
    Watch watch{};
};

/// May be used by several threads, whose renders take turns; several renderers render at once. It keeps the last scene,
/// so that other views of it, with other cameras, sizes and samples, begin at once.
///
/// The library leaves the process alone: environment, allocator, signals. prepareProcess() is for programs that want
/// what the command line does. After a fork, a renderer of the parent throws Error{Usage} in the child.
class HYALITE_API Renderer {
  public:
    /// Opens "auto", "cpu" (the twin of the kernels), "cpu-double", or a device by index or part of its name. Throws
    /// Error{NoDevice}, and Error{Usage}.
    explicit Renderer(const std::string &device = "auto", const RendererOptions &options = {});
    ~Renderer();
    Renderer(Renderer &&) noexcept;
    Renderer &operator=(Renderer &&) noexcept;

    [[nodiscard]] std::string name() const;        ///< "cpu", or the name of the device
    [[nodiscard]] std::string description() const; ///< for people: with driver and type
    /// How sure it is that images have the bits of the CPU twin's: "promised", or "measured" with the reason.
    [[nodiscard]] std::string equalBits() const;

    /// The image of the scene, of which these settings override its own. The same on every device and machine, bit for
    /// bit. Throws Error, and what callbacks throw.
    [[nodiscard]] Image render(const Scene &scene, const Settings &settings = {},
                               const RenderOptions &options = {});

    struct Content; ///< of the library alone
    [[nodiscard]] Content &content() noexcept { return *content_; }

  private:
    std::unique_ptr<Content> content_;
};

/// Prepares the process as the command line does its own: the settings of the allocator and, from then on when a
/// renderer is opened, lavapipe's environment variables, which make its renders faster. Call it first in main, before
/// there are other threads.
HYALITE_API void prepareProcess();

} // namespace hyalite
