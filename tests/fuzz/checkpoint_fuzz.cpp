// Checkpoints as `hyalite render --resume` reads them.
#include "host/film/checkpoint.h"
#include "tests/fuzz/checkpoint_bytes.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/heap_peak.h"

#include <cstdint>

namespace hyalite::core::fuzz {
namespace {

// Of the seeds in corpus/checkpoint.
const RenderIdentity identity{{"seed", "7"}, {"sampler", "sobol"}};
constexpr Crop crop{2, 5, 1, 3};
constexpr std::uint32_t samplesPerPixel = 100;

void read(const TemporaryFolder &folder, std::string_view content) {
    const std::filesystem::path file = folder.write("input", content);
    std::optional<ResumedCheckpoint> resumed;
    std::size_t peakBytes = 0;
    const bool isRefused = refusalOf([&] {
                               const HeapPeak peak;
                               resumed = resumeCheckpoint(file, identity, {crop, {}, samplesPerPixel, {}});
                               peakBytes = peak.bytes();
                           }).has_value();
    if (isRefused)
        return;
    require(resumed.has_value(), "a file that is there is not found");
    require(peakBytes <= (std::size_t{1} << 20) + 2 * content.size(), "it takes more memory than the file");
    const Film &film = resumed->checkpoint.film;
    require(film.crop.x0 == crop.x0 && film.crop.x1 == crop.x1 && film.crop.y0 == crop.y0 &&
                film.crop.y1 == crop.y1 && film.pixels.size() == 6,
            "a film of another size is taken");
    for (const layout::FilmPixel &pixel : film.pixels)
        require(pixel.sampleCount <= samplesPerPixel, "a pixel has more samples than are wanted");
}

} // namespace
} // namespace hyalite::core::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t sizeBytes) {
    using namespace hyalite::core::fuzz;
    readAlsoRepaired(textOf(data, sizeBytes), read);
    return 0;
}
