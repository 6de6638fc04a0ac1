// IES files: the reader's promises, and its profile as a light of a scene.
#include "host/import/ies.h"
#include "host/scene/validate.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/mesh_promises.h"

#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace hyalite::core::fuzz {
namespace {

void run(std::string_view text) {
    std::optional<IesFile> read;
    {
        const HeapPeak peak;
        (void)refusalOf([&] { read = readIes(InputFile("input.ies", std::as_bytes(std::span(text)))); });
        requireBoundedMemory(peak, text.size());
    }
    if (!read)
        return;
    require(meanShare(read->profile) > 0.0, "a profile without light");
    require(litAnglesOf(read->profile).high > litAnglesOf(read->profile).low, "a profile without lit angles");
    Scene scene;
    scene.profiles.push_back(std::move(read->profile));
    scene.lights.resize(1);
    scene.lights[0].profile = 0;
    (void)refusalOf([&] { validateScene(scene, "input.ies"); });
}

} // namespace
} // namespace hyalite::core::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t sizeBytes) {
    hyalite::core::fuzz::run(hyalite::core::fuzz::textOf(data, sizeBytes));
    return 0;
}
