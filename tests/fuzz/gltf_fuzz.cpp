// glTF files, .gltf or .glb by their first bytes, with a buffer beside them that they can name.
#include "host/import/load.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/heap_peak.h"

#include <cstdint>

namespace hyalite::core::fuzz {
namespace {

void run(std::string_view text) {
    static const TemporaryFolder folder;
    static const std::filesystem::path buffer = folder.write("buffer.bin", std::string(256, '\x3f'));
    const std::filesystem::path file = folder.write("input.gltf", text);
    // Of meshes, as gltf/memory_budget.h says, and of a texture, as readingBytesMax does.
    const std::size_t allowed = (std::size_t{800} << 20) + 128 * (text.size() + 256);
    const HeapPeak peak;
    const LoadOptions options{.timeSeconds = 0.5};
    (void)refusalOf([&] { (void)loadScene(file.string(), options); });
    require(peak.bytes() <= allowed, "more memory than may be taken for such a file");
}

} // namespace
} // namespace hyalite::core::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t sizeBytes) {
    hyalite::core::fuzz::run(hyalite::core::fuzz::textOf(data, sizeBytes));
    return 0;
}
