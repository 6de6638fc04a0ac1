// All kernels that tests look at: the program's, and those of the tests.
#pragma once

#include "shaders/embedded_kernels.h"
#include "tests/fixtures/test_extent.h"

#include <vector>

namespace hyalite::core {

/// The kernels of the tests alone, in the order of tests/CMakeLists.txt.
[[nodiscard]] std::span<const EmbeddedKernel> testKernels();

namespace testing {

[[nodiscard]] inline std::vector<EmbeddedKernel> allKernels() {
    std::vector<EmbeddedKernel> kernels(embeddedKernels().begin(), embeddedKernels().end());
    kernels.insert(kernels.end(), testKernels().begin(), testKernels().end());
    return kernels;
}

/// All of them if everything is tested; else each third from `first` on, so that three tests of different passes look
/// at each kernel once.
[[nodiscard]] inline std::vector<EmbeddedKernel> kernelsInTurn(std::size_t first) {
    std::vector<EmbeddedKernel> kernels = allKernels();
    if (!isTestingAll())
        std::erase_if(kernels,
                      [&, i = std::size_t{0}](const EmbeddedKernel &) mutable { return i++ % 3 != first; });
    return kernels;
}

} // namespace testing
} // namespace hyalite::core
