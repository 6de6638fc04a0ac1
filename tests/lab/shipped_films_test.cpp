// The shipped films: their hashes, and that they reach what they are to reach.
#include "host/lab/shipped_films.h"

#include "host/base/hash.h"
#include "host/lab/verify.h"
#include "host/scene/names.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <string_view>

namespace hyalite::core {
namespace {

class Shipped : public ::testing::Test {
  protected:
    void SetUp() override { setenv("HYALITE_ASSETS", HYALITE_ASSET_DIR, 1); }

    [[nodiscard]] static std::vector<PreparedScene> prepareAll(const ShippedFilms &shipped) {
        std::vector<PreparedScene> scenes;
        for (const std::string &name : shipped.sceneNames()) {
            SceneOptions options;
            options.scene = (shipped.folder / (name + ".json")).string();
            scenes.push_back(prepareScene(options, Source::Kept, nobody()));
        }
        return scenes;
    }
};

/// Writes the hashes into assets/verify/films.json, and the next version if one is new.
void writeHashes(const DeviceVerdict &verdict, const ShippedFilms &shipped) {
    const std::string file = HYALITE_SOURCE_DIR "/assets/verify/films.json";
    std::ifstream input(file);
    std::string text(std::istreambuf_iterator<char>(input), {});
    bool hasChanged = false;
    std::size_t at = 0;
    for (const ShippedFilm &film : shipped.films) {
        constexpr std::string_view key = "\"hash\": \"";
        at = text.find(key, at) + key.size();
        const auto found = std::ranges::find_if(verdict.films, [&](const FilmVerdict &other) {
            return other.film.scene == film.scene && other.film.integrator == film.integrator;
        });
        const std::string hash = hashText(found->hash);
        hasChanged = hasChanged || text.compare(at, hash.size(), hash) != 0;
        text.replace(at, hash.size(), hash);
    }
    if (hasChanged) {
        const std::string before = fmt::format("\"version\": {}", shipped.version);
        text.replace(text.find(before), before.size(), fmt::format("\"version\": {}", shipped.version + 1));
    }
    std::ofstream(file) << text;
}

TEST_F(Shipped, HashesAreThoseOfTheReferenceRenderer) {
    const ShippedFilms shipped = readShippedFilms();
    ASSERT_GE(shipped.films.size(), 10u);
    const DeviceVerdict verdict = verifyDevice("cpu", shipped, nobody());
    ASSERT_EQ(verdict.films.size(), shipped.films.size());
    if (std::getenv("HYALITE_WRITE_FILMS") != nullptr)
        writeHashes(verdict, shipped);
    for (const FilmVerdict &film : verdict.films)
        EXPECT_EQ(hashText(film.hash), hashText(film.film.hash))
            << film.film.scene << ", " << nameOf(film.film.integrator) << ": " << film.failure;
    EXPECT_TRUE(verdict.isPassed());
}

TEST_F(Shipped, FilmsReachEveryKernel) {
    std::set<std::string_view> missing;
    for (const IntegratorRow &row : integratorTable)
        missing.insert(row.kernel);
    std::set<std::string_view> missingOfTwoSlots = missing;
    for (const ShippedFilm &film : readShippedFilms().films) {
        missing.erase(rowOf(film.integrator).kernel);
        if (film.maxSlots == 2)
            missingOfTwoSlots.erase(rowOf(film.integrator).kernel);
    }
    EXPECT_TRUE(missing.empty()) << *missing.begin();
    EXPECT_TRUE(missingOfTwoSlots.empty()) << *missingOfTwoSlots.begin();
}

TEST_F(Shipped, ScenesReachEveryMaterialLightAndCamera) {
    std::set<MaterialKind> materials;
    std::set<LightKind> lights;
    std::set<CameraKind> cameras;
    std::set<FilterKind> filters;
    std::set<std::size_t> slots;
    std::uint32_t lighting = 0;
    bool hasLens = false;
    bool hasTreeBehindThin = false; // light from behind, chosen by a tree, where thin glass is the only glass
    for (const PreparedScene &prepared : prepareAll(readShippedFilms())) {
        const Scene &scene = prepared.loaded.scene;
        for (const Material &material : scene.materials) {
            materials.insert(material.kind);
            for (std::size_t slot = 0; slot < material.textures.size(); ++slot)
                if (material.textures[slot])
                    slots.insert(slot);
        }
        for (const Light &light : scene.lights)
            lights.insert(light.kind);
        cameras.insert(scene.camera.kind);
        filters.insert(prepared.loaded.settings.filter);
        hasLens = hasLens || scene.camera.aperture > 0.0;
        lighting |= prepared.packed.lighting;
        hasTreeBehindThin =
            hasTreeBehindThin || (!prepared.packed.lightNodes.empty() && !prepared.packed.hasDielectric &&
                                  (prepared.packed.scattering & layout::scattersAtThin) != 0);
    }
    EXPECT_EQ(materials.size(), materialNames.size());
    EXPECT_EQ(lights.size(), lightNames.size());
    EXPECT_EQ(cameras.size(), cameraNames.size());
    EXPECT_EQ(filters.size(), filterNames.size());
    EXPECT_EQ(slots.size(), std::size_t{layout::textureSlotCount});
    EXPECT_TRUE(hasLens);
    EXPECT_TRUE(hasTreeBehindThin);
    for (const std::uint32_t kind : {layout::lightsByEnvironment, layout::lightsByDirections,
                                     layout::lightsBySpots, layout::lightsByProfiles})
        EXPECT_NE(lighting & kind, 0u) << kind;
}

TEST(FilmHash, IsOfAllThatAFilmHolds) {
    Film film({0, 2, 0, 1});
    film.pixels[0].sum = {1.0f, 2.0f, 3.0f};
    film.pixels[0].sumOfSquares = {1.0f, 4.0f, 9.0f};
    film.pixels[0].sampleCount = 1;
    std::set<std::uint64_t> hashes{filmHash(film)};
    film.pixels[0].pad0 = 5.0f;
    EXPECT_EQ(filmHash(film), *hashes.begin()) << "padding is nothing that it holds";
    for (float *value : {&film.pixels[0].sum.z, &film.pixels[1].sum.x, &film.pixels[0].sumRest.y,
                         &film.pixels[1].sumOfSquares.y, &film.pixels[1].squaresRest.z}) {
        *value = -0.0f;
        EXPECT_TRUE(hashes.insert(filmHash(film)).second);
    }
    for (float *value : {&film.pixels[1].transparency, &film.pixels[0].transparencyRest}) {
        *value = 0.5f;
        EXPECT_TRUE(hashes.insert(filmHash(film)).second);
    }
    film.pixels[1].sampleCount = 1;
    EXPECT_TRUE(hashes.insert(filmHash(film)).second);
    std::swap(film.pixels[0], film.pixels[1]);
    EXPECT_TRUE(hashes.insert(filmHash(film)).second);
}

} // namespace
} // namespace hyalite::core
