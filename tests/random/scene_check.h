// What a random scene is checked for: both renderers, bit for bit, whether subnormal numbers are flushed or not, and
// radiances that can be.
#pragma once

#include "host/gpu/renderer.h"
#include "tests/random/random_scene.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core::testing {

enum class FaultKind { Refused, Differs, Negative, NotFinite, Gains };

struct Fault {
    FaultKind kind;
    std::string text;
};

/// In place of a kernel: the CPU alone, which is checked sooner than any driver compiles.
inline constexpr std::string_view noKernel = "cpu";

/// One way to render: none changes the picture.
struct Way {
    std::string_view kernel;  ///< of gpu::kernelTable, or noKernel
    bool isHurried = false;   ///< dispatches end after few steps, so that samples wait in between
    bool isEncoded = false;   ///< textures keep their 8-bit levels
    bool isFlattened = false; ///< instances become meshes
};

/// Checks scenes on the device of test_device.h, which is opened once for each kernel.
class SceneCheck {
  public:
    /// `kernels` are those that may be chosen; all that the device has, if there is none. Throws Error{Usage} for a
    /// name that is neither a kernel nor noKernel.
    explicit SceneCheck(const std::vector<std::string> &kernels);

    /// The ways in turn, by the seed.
    [[nodiscard]] Way wayOf(std::uint64_t seed, const std::string &integrator) const;

    /// The first fault, or none. `folder` gets the scene's files.
    [[nodiscard]] std::optional<Fault> faultOf(const RandomScene &scene, const Way &way,
                                               const std::filesystem::path &folder);

  private:
    std::optional<Fault> faultOfFile(const RandomScene &scene, const Way &way,
                                     const std::filesystem::path &file);
    gpu::Renderer &rendererOf(const Way &way);

    std::vector<std::string_view> kernels_;
    std::map<std::pair<std::string_view, bool>, gpu::Renderer> renderers_;
};

} // namespace hyalite::core::testing
