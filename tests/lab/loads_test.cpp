// The loads of long verifications: their hashes.
#include "host/lab/loads.h"

#include "host/base/hash.h"
#include "host/engine/open_backends.h"
#include "host/lab/shipped_films.h"
#include "tests/fixtures/test_extent.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace hyalite::core {
namespace {

std::uint64_t hashOnCpu(const Loads &loads, const Load &load, const LoadSize &size) {
    const PreparedScene scene = prepareLoad(loads, load, size);
    return filmHash(
        openBackend("cpu", nobody())->render(scene.packed, scene.loaded.settings, scene.crop).film);
}

/// Puts a hash into the file instead of another one, in the row of a load.
void replaceHash(const std::string &load, const char *size, std::uint64_t hash) {
    const std::string file = HYALITE_SOURCE_DIR "/assets/verify/loads.json";
    std::ifstream input(file);
    std::string text(std::istreambuf_iterator<char>(input), {});
    const std::string key = "\"hash\": \"";
    const std::size_t row =
        text.find(fmt::format("\"{}\"", size), text.find(fmt::format("\"name\": \"{}\"", load)));
    text.replace(text.find(key, row) + key.size(), 16, hashText(hash));
    std::ofstream(file) << text;
}

// The large ones take two minutes on two processors.
TEST(Loads, HashesAreThoseOfTheReferenceRenderer) {
    setenv("HYALITE_ASSETS", HYALITE_ASSET_DIR, 1);
    const Loads loads = readLoads();
    const bool isWriting = std::getenv("HYALITE_WRITE_FILMS") != nullptr;
    for (const Load &load : loads.loads)
        for (const auto &[name, size] : {std::pair{"small", &load.small}, std::pair{"large", &load.large}}) {
            if (size == &load.large && !testing::isTestingAll())
                continue;
            const std::uint64_t hash = hashOnCpu(loads, load, *size);
            if (isWriting)
                replaceHash(load.name, name, hash);
            EXPECT_EQ(hashText(hash), hashText(size->hash)) << load.name << ", " << name;
        }
}

} // namespace
} // namespace hyalite::core
