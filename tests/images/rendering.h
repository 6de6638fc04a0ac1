// What the image tests share: scenes made ready, both renderers, and comparison to the bit.
#pragma once

#include "host/bvh/bvh.h"
#include "host/gpu/renderer.h"
#include "host/packing/packed_scene.h"
#include "host/reference/renderer.h"
#include "host/scene/scene.h"
#include "tests/fixtures/test_device.h"
#include "tests/fixtures/test_scene.h"

#include <span>
#include <string>

namespace hyalite::core::testing {

/// A shipped scene by its name, at another size and sample count.
[[nodiscard]] TestScene shippedScene(const std::string &name, int width, int height, int samplesPerPixel);

/// Validates, builds the tree that the settings ask for, and packs.
[[nodiscard]] PackedScene pack(const TestScene &scene, std::size_t maxDecoded = maxDecodedBytes);

/// The renderer of all tests of a process, on the device of test_device.h, by this configuration until the next call:
/// drivers take longer to compile a kernel than to run it, and tests share what they have in common. `config` is
/// neither staged nor has a kernel of its own.
[[nodiscard]] gpu::Renderer &rendererBy(const gpu::RenderConfig &config);

/// All kernels, in the order of their table.
[[nodiscard]] std::span<const gpu::RenderConfig> allKernels();

/// One of them, the next one for the next `turn`: scenes in turn meet all kernels. All of them for every turn if
/// everything is tested.
[[nodiscard]] std::span<const gpu::RenderConfig> kernelsInTurn(std::size_t turn);

/// A skip list whose dispatches end early: with samples that wait for earlier ones, and such as none has the time for.
[[nodiscard]] gpu::RenderConfig cutShortKernel();

/// Renders all of the image on the device of test_device.h.
[[nodiscard]] gpu::Result renderOnDevice(const TestScene &scene, const gpu::RenderConfig &config = {},
                                         std::size_t maxDecoded = maxDecodedBytes);

/// The same of a scene that is packed already.
[[nodiscard]] gpu::Result renderOnDevice(const TestScene &scene, const PackedScene &packed,
                                         const gpu::RenderConfig &config);
[[nodiscard]] reference::Result renderOnCpu(const TestScene &scene, const PackedScene &packed,
                                            reference::Precision precision = reference::Precision::Float32);

[[nodiscard]] reference::Result renderOnCpu(const TestScene &scene,
                                            reference::Precision precision = reference::Precision::Float32,
                                            std::size_t maxDecoded = maxDecodedBytes);

/// How many film pixels differ in any bit of their sums, layers of light included, or in their counts.
[[nodiscard]] std::size_t differingPixels(const Film &a, const Film &b);

} // namespace hyalite::core::testing
