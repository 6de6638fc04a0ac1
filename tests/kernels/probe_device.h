// Runs the probe kernel on the software device of the machine, which every test run must have.
#pragma once

#include "host/gpu/arithmetic.h"
#include "host/gpu/kernel.h"
#include "host/gpu/vk/device.h"
#include "shaders/layout/layout.h"
#include "tests/kernels/draw.h"
#include "tests/kernels/probe.h"
#include "tests/kernels/words.h"

#include <functional>
#include <memory>
#include <vector>

namespace hyalite::core::testing {

/// lavapipe, opened once, with vectors as wide as the processor's.
[[nodiscard]] gpu::Device &probeDevice();

/// What a probed function reads beside its parameters.
struct ProbeScene {
    layout::FrameRecord frame{};
    std::uint32_t samplerKind = layout::samplerSobol;
    std::vector<layout::LookupRow> lookups{};
    std::span<const layout::TextureRow> textures{}; ///< outlives it
    std::uint32_t scattering = 0;
    std::uint32_t texturing = 0;
    std::uint32_t camera = layout::cameraPinhole;
};

constexpr std::size_t probeInputCount = 65536; // of one dispatch

/// One function of the probe kernel, ready to run.
class Probe {
  public:
    Probe(std::uint32_t function, std::size_t inputWords, std::size_t outputWords, gpu::Arithmetic arithmetic,
          const ProbeScene &scene = {});

    /// Calls the function for probeInputCount inputs, one after the other in `inputs`.
    [[nodiscard]] std::vector<std::uint32_t> run(const std::vector<std::uint32_t> &inputs);

  private:
    std::vector<std::unique_ptr<gpu::Buffer>> buffers_; ///< by their bindings
    std::size_t outputWords_;
    std::unique_ptr<gpu::Kernel> kernel_;
};

/// Draws an input, writes it as the probe takes it, and writes what the host twin makes of it.
using TwinCall = std::function<void(Draw &draw, Words &input, Words &expected)>;

/// Whether renders may use the device's own / and sqrt, which are then correctly rounded.
[[nodiscard]] bool isDivisionNative();

/// Expects the function's results for probeInputCount inputs to be the twin's to the bit, with our / and sqrt and,
/// where renders may use them, with the device's own.
void expectTwin(std::uint32_t function, const TwinCall &call, const ProbeScene &scene = {});

} // namespace hyalite::core::testing
