// Material libraries as `hyalite render MESH.obj` reads them, beside a mesh that names them.
#include "host/import/load.h"
#include "host/import/mtl.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/heap_peak.h"

#include <cmath>
#include <cstdint>

namespace hyalite::core::fuzz {
namespace {

bool isFraction(const glm::vec3 &colour) {
    for (glm::length_t channel = 0; channel < 3; ++channel)
        if (!(colour[channel] >= 0.0f && colour[channel] <= 1.0f))
            return false;
    return true;
}

void requireSound(const Material &material) {
    require(isFraction(material.albedo), "a colour beyond [0, 1]");
    require(isFraction({material.roughness, material.metallic, material.transmission}),
            "a fraction beyond [0, 1]");
    require(material.refractiveIndex >= 1.0f && material.refractiveIndex <= 10.0f, "an index beyond [1, 10]");
    for (glm::length_t channel = 0; channel < 3; ++channel)
        require(material.emission[channel] >= 0.0f && std::isfinite(material.emission[channel]),
                "an emission that is no number from 0 on");
}

void run(std::string_view text) {
    static const TemporaryFolder folder;
    static const std::filesystem::path mesh = folder.write(
        "mesh.obj", "mtllib input.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n");
    const std::filesystem::path file = folder.write("input.mtl", text);
    static const std::filesystem::path image = folder.write(
        "a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n" + std::string("\x80\x40\0\x88", 4));
    constexpr std::size_t anyFileBytes = std::size_t{1} << 20;
    {
        const HeapPeak peak;
        (void)refusalOf([&] {
            TextureLibrary textures;
            Losses losses;
            FileFinder files(std::filesystem::canonical(file.parent_path()));
            for (const Material &material : loadMtl(file, {files, textures, losses}))
                requireSound(material);
        });
        require(peak.bytes() <= anyFileBytes + 64 * text.size(),
                "more memory than may be taken for such a file");
    }
    (void)refusalOf([&] { (void)loadScene(mesh.string()); });
}

} // namespace
} // namespace hyalite::core::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t sizeBytes) {
    hyalite::core::fuzz::run(hyalite::core::fuzz::textOf(data, sizeBytes));
    return 0;
}
