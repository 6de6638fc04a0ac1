// STL meshes: the reader's promises, and a bare mesh's way into a scene.
#include "host/import/stl.h"
#include "host/scene/framing.h"
#include "host/scene/validate.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/mesh_promises.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace hyalite::core::fuzz {
namespace {

void run(std::string_view text) {
    static const TemporaryFolder folder;
    const std::filesystem::path file = folder.write("input.stl", text);
    std::optional<ObjMesh> loaded;
    {
        const HeapPeak peak;
        (void)refusalOf([&] { loaded = loadStl(file); });
        requireBoundedMemory(peak, text.size());
    }
    if (!loaded)
        return;
    requireSound(loaded->mesh);
    (void)refusalOf([&] { validateScene(frameMesh(std::move(loaded->mesh)), "input.stl"); });
}

} // namespace
} // namespace hyalite::core::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t sizeBytes) {
    hyalite::core::fuzz::run(hyalite::core::fuzz::textOf(data, sizeBytes));
    return 0;
}
