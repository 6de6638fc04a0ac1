// Profile reports as baselines: read, and held against themselves as against a newer one.
#include "host/report/baseline.h"
#include "tests/fuzz/harness.h"

#include <cstdint>

namespace hyalite::core::fuzz {
namespace {

void run(std::string_view text) {
    static const TemporaryFolder folder;
    const std::filesystem::path file = folder.write("input.json", text);
    ProfileFigures figures;
    if (refusalOf([&] { figures = readFigures(file); }))
        return;
    const BaselineComparison comparison = compareWithBaseline(figures, figures, 0.05, Gate::All);
    (void)comparisonTable(comparison, 0.05, Gate::All);
}

} // namespace
} // namespace hyalite::core::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t sizeBytes) {
    hyalite::core::fuzz::run(hyalite::core::fuzz::textOf(data, sizeBytes));
    return 0;
}
