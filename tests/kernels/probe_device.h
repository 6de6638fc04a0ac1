// Runs the probe kernel on the software device of the machine, which every test run must have.
#pragma once

#include "host/gpu/arithmetic.h"
#include "host/gpu/kernel.h"
#include "host/gpu/vk/buffer.h"
#include "host/gpu/vk/device.h"
#include "host/reference/scene_view.h"
#include "tests/kernels/probe_layout.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace hyalite::core::testing {

/// lavapipe, opened once, with vectors as wide as the processor's.
[[nodiscard]] gpu::Device &probeDevice();

constexpr std::size_t probeInputCount = 65536; // of one dispatch

/// One function of the probe kernel, ready to run.
class Probe {
  public:
    /// `function` is the number of a leaf, or one of probed... Without a scene its buffers are not read. `inputCount` is a
    /// multiple of 64.
    Probe(std::uint32_t function, std::size_t inputWords, std::size_t outputWords, gpu::Arithmetic arithmetic,
          const leaves::SceneView<float> *scene = nullptr, std::size_t inputCount = probeInputCount);

    /// Calls the function for all inputs, one after the other in `inputs`.
    [[nodiscard]] std::vector<std::uint32_t> run(const std::vector<std::uint32_t> &inputs);

  private:
    std::size_t inputCount_;
    std::size_t outputWords_;
    gpu::Buffer inputs_;
    gpu::Buffer outputs_;
    std::unique_ptr<gpu::Kernel> kernel_;
};

/// Words with the floats that they are.
[[nodiscard]] std::string describeWords(const std::uint32_t *words, std::size_t count);

/// Whether renders may use the device's own / and sqrt, which are then correctly rounded.
[[nodiscard]] bool isDivisionNative();

} // namespace hyalite::core::testing
