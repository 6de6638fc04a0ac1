// All kernels that tests look at: the program's, and those of the tests.
#pragma once

#include "shaders/embedded_kernels.h"

#include <vector>

namespace hyalite {

/// The kernels of the tests alone, in the order of tests/CMakeLists.txt.
[[nodiscard]] std::span<const EmbeddedKernel> testKernels();

namespace testing {

[[nodiscard]] inline std::vector<EmbeddedKernel> allKernels() {
    std::vector<EmbeddedKernel> kernels(embeddedKernels().begin(), embeddedKernels().end());
    kernels.insert(kernels.end(), testKernels().begin(), testKernels().end());
    return kernels;
}

} // namespace testing
} // namespace hyalite
