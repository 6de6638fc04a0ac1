// Parts as `hyalite merge` reads them.
#include "host/cli/part_command.h"
#include "host/farm/merge.h"
#include "tests/fuzz/checkpoint_bytes.h"
#include "tests/fuzz/harness.h"

#include <algorithm>
#include <cstdint>

namespace hyalite::core::fuzz {
namespace {

// A picture takes memory, and may, where its parts are small.
constexpr std::size_t maxPixels = std::size_t{1} << 20;

bool isSmall(const std::filesystem::path &file) {
    bool isSmall = false;
    const auto refused = refusalOf([&] {
        const Crop crop = readCheckpointFile(file, nullptr).crop;
        isSmall = crop.pixelCount() <= maxPixels;
    });
    return refused || isSmall;
}

void read(const TemporaryFolder &folder, std::string_view content) {
    const std::filesystem::path file = folder.write("1.part", content);
    if (!isSmall(file))
        return;
    Merger merger;
    merger.add(file);
    for (const auto &lines : {merger.faults().unusable, merger.faults().foreign, merger.faults().differences})
        std::ranges::for_each(lines, requirePlain);
    require(merger.hasParts() == merger.faults().unusable.empty(), "a part is neither taken nor refused");
    if (!merger.hasParts())
        return;
    require(merger.partCount() == 1 && merger.faults().foreign.empty() && merger.faults().differences.empty(),
            "one part differs from itself");
    merger.add(file);
    require(merger.partCount() == 1 && merger.faults().differences.empty(), "a part differs from its copy");
    const std::vector<std::uint32_t> missing = merger.missing();
    require(missing.size() + 1 == merger.partition().partCount(), "parts are lost");
    if (!missing.empty())
        requirePlain(
            commandFor(merger.origin(), merger.firstPart(), {missing.front(), merger.firstPart().count}));
    for (const auto &[maker, count] : merger.makers())
        requirePlain(maker);
    const Film &film = merger.film();
    require(film.pixels.size() == film.crop.pixelCount(), "the picture has another size than its crop");
    require(merger.layers().size() == merger.origin().layers.size(), "layers are lost");
}

} // namespace
} // namespace hyalite::core::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t sizeBytes) {
    using namespace hyalite::core::fuzz;
    readAlsoRepaired(textOf(data, sizeBytes), read);
    return 0;
}
