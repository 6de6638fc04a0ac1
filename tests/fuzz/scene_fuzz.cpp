// Scene files, with a mesh beside them that they can name.
#include "host/import/load.h"
#include "tests/fuzz/harness.h"

#include <cstdint>

namespace hyalite::core::fuzz {
namespace {

void run(std::string_view text) {
    static const TemporaryFolder folder;
    static const std::filesystem::path mesh =
        folder.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::filesystem::path file = folder.write("input.json", text);
    (void)refusalOf([&] { (void)loadScene(file.string()); });
}

} // namespace
} // namespace hyalite::core::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t sizeBytes) {
    hyalite::core::fuzz::run(hyalite::core::fuzz::textOf(data, sizeBytes));
    return 0;
}
