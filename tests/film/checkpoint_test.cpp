// Checkpoints come back as they were written, or are refused; and a generation is always there.
#include "host/film/checkpoint.h"

#include "host/base/error.h"
#include "host/base/hash.h"
#include "tests/fixtures/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <fstream>
#include <set>

#include <sys/resource.h>

namespace hyalite::core {
namespace {

namespace fs = std::filesystem;

const RenderIdentity identity{{"seed", "7"}, {"sampler", "sobol"}};
const CheckpointSubject subject{{2, 5, 1, 3}, {}, 100, {}};

struct CheckpointTest : ::testing::Test {
    /// The message of the refusal, or nothing if there was none.
    [[nodiscard]] std::string refusal(const RenderIdentity &wanted = identity,
                                      const Crop &crop = {2, 5, 1, 3}, std::uint32_t samples = 100) const {
        try {
            (void)resumeCheckpoint(path, wanted, {crop, {}, samples, {}});
            return {};
        } catch (const Error &error) {
            EXPECT_EQ(error.kind, ErrorKind::BadInput);
            return error.what();
        }
    }
    [[nodiscard]] std::set<std::string> entries() const {
        std::set<std::string> names;
        for (const fs::directory_entry &entry : fs::directory_iterator(folder))
            names.insert(entry.path().filename().string());
        return names;
    }

    const testing::TemporaryFolder temporary_;
    const fs::path &folder = temporary_.path;
    const fs::path path = folder / "c";
};

/// Three pixels by two, with `sampleCount` samples each.
Film filmOf(std::uint32_t sampleCount) {
    Film film({2, 5, 1, 3});
    float value = 0.1f;
    for (layout::FilmPixel &pixel : film.pixels) {
        pixel = {};
        pixel.sum = {value, -value, 1e-40f * value};
        pixel.sumRest = glm::vec3(1e-9f * value);
        pixel.sumOfSquares = {value * value, 1e30f, 0.0f};
        pixel.squaresRest = {0.0f, 1e20f, 0.0f};
        pixel.sampleCount = sampleCount;
        value *= 1.7f;
    }
    return film;
}

std::string load(const fs::path &path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void store(const fs::path &path, const std::string &bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

bool hasSamples(const std::optional<ResumedCheckpoint> &resumed, std::uint32_t sampleCount) {
    const Film wanted = filmOf(sampleCount);
    return resumed && std::memcmp(resumed->checkpoint.film.pixels.data(), wanted.pixels.data(),
                                  wanted.pixels.size() * sizeof(layout::FilmPixel)) == 0;
}

std::optional<ResumedCheckpoint> resume(const fs::path &path) {
    return resumeCheckpoint(path, identity, subject);
}

TEST(Hash64, ChangesWithEveryBitAndLength) {
    std::array<std::byte, 100> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<std::byte>(i * 37);
    std::set<std::uint64_t> hashes;
    for (std::size_t length = 0; length <= bytes.size(); ++length)
        hashes.insert(hashBytes(std::span(bytes).first(length)));
    const std::uint64_t whole = hashBytes(bytes);
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        bytes[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
        hashes.insert(hashBytes(bytes));
        bytes[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
    }
    EXPECT_EQ(hashes.size(), bytes.size() + 1 + 8 * bytes.size());
    EXPECT_EQ(hashBytes(bytes), whole);
    EXPECT_NE(hashBytes(bytes, 1), whole);
    EXPECT_NE(hashBytes(std::span(bytes).subspan(50), hashBytes(std::span(bytes).first(50))),
              hashBytes(std::span(bytes).first(50), hashBytes(std::span(bytes).subspan(50))));
}

TEST_F(CheckpointTest, ComesBackAsItWasWritten) {
    EXPECT_FALSE(resume(path));
    const RayCounts rays{1, 2, 3, 1ull << 60, 5};
    CheckpointWriter(path, identity, subject, false).write(filmOf(4), rays);
    const std::optional<ResumedCheckpoint> resumed = resume(path);
    EXPECT_TRUE(hasSamples(resumed, 4));
    EXPECT_EQ(resumed->checkpoint.rays, rays);
    EXPECT_EQ(resumed->checkpoint.film.crop.x1, 5);
    EXPECT_EQ(resumed->path, path);
    EXPECT_EQ(resumed->damage, "");
    EXPECT_EQ(entries(), std::set<std::string>{"c"});
}

TEST_F(CheckpointTest, TwoGenerationsAreKept) {
    CheckpointWriter writer(path, identity, subject, false);
    for (const std::uint32_t samples : {1u, 2u, 3u})
        writer.write(filmOf(samples), {});
    EXPECT_EQ(entries(), (std::set<std::string>{"c", "c.1"}));
    EXPECT_TRUE(hasSamples(resume(path), 3));
    fs::remove(path); // as between the two renamings
    const std::optional<ResumedCheckpoint> older = resume(path);
    EXPECT_TRUE(hasSamples(older, 2));
    EXPECT_EQ(older->path, path.string() + ".1");
    EXPECT_NE(older->damage.find("missing"), std::string::npos) << older->damage;
}

TEST_F(CheckpointTest, AnyDamageToTheNewerGenerationFallsBackToTheOlderOne) {
    CheckpointWriter writer(path, identity, subject, false);
    writer.write(filmOf(1), {});
    writer.write(filmOf(2), {});
    const std::string whole = load(path);
    const auto expectOlder = [&](const std::string &bytes, std::size_t where) {
        store(path, bytes);
        const std::optional<ResumedCheckpoint> resumed = resume(path);
        EXPECT_TRUE(hasSamples(resumed, 1)) << where;
        EXPECT_NE(resumed->damage.find(path.string()), std::string::npos) << resumed->damage;
    };
    constexpr std::size_t versionBegin = 19; // after the magic: another version is no damage
    for (std::size_t i = 0; i < whole.size(); ++i) {
        if (i >= versionBegin && i < versionBegin + 4)
            continue;
        for (const int bit : {0, 3, 7}) {
            std::string damaged = whole;
            damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
            expectOlder(damaged, i);
        }
    }
    for (std::size_t length = 0; length < whole.size(); ++length)
        expectOlder(whole.substr(0, length), length);
    expectOlder(whole + '\0', whole.size());
}

TEST_F(CheckpointTest, ADamagedGenerationNeverReplacesAWholeOne) {
    CheckpointWriter(path, identity, subject, false).write(filmOf(1), {});
    fs::rename(path, path.string() + ".1");
    store(path, "damaged");
    CheckpointWriter writer(path, identity, subject, resume(path)->damage.empty());
    writer.write(filmOf(2), {});
    EXPECT_TRUE(hasSamples(resume(path), 2));
    fs::remove(path);
    EXPECT_TRUE(hasSamples(resume(path), 1));
}

TEST_F(CheckpointTest, WhereBothAreDamagedBothReasonsAreTold) {
    store(path, "damaged");
    store(path.string() + ".1", "");
    const std::string message = refusal();
    for (const std::string &part : {path.string() + ": ", path.string() + ".1: ",
                                    std::string("not a checkpoint"), std::string("empty")})
        EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST_F(CheckpointTest, HugeSizesAreRefusedByTheSizeOfTheFile) {
    CheckpointWriter(path, identity, subject, false).write(filmOf(1), {});
    const std::string whole = load(path);
    const auto refusalWith = [&](std::size_t offset, std::uint32_t word) {
        std::string bytes = whole;
        std::memcpy(bytes.data() + 19 + offset, &word, sizeof word);
        store(path, bytes);
        return refusal();
    };
    EXPECT_NE(refusalWith(0, 2).find("version 2"), std::string::npos);
    for (const std::uint32_t word : {0u, 1u << 17, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu})
        for (const std::size_t offset : {4u, 8u, 12u, 16u, 20u})
            EXPECT_NE(refusalWith(offset, word).find("damaged"), std::string::npos) << word << ' ' << offset;
    // The part, the samples that are wanted, layers, and bytes of the origin.
    for (const std::uint32_t word : {2u, 1u << 17, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu})
        for (const std::size_t offset : {64u, 68u, 72u, 76u, 80u, 84u, 88u, 92u, 100u})
            EXPECT_NE(refusalWith(offset, word).find("damaged"), std::string::npos) << word << ' ' << offset;
}

TEST_F(CheckpointTest, KeepsFirstSamplesOfAllAndOfParts) {
    Film film = filmOf(16);
    film.first.resize(film.pixels.size());
    for (std::size_t i = 0; i < film.first.size(); ++i)
        film.first[i] = {glm::vec3(0.25f * static_cast<float>(i)), 8};
    CheckpointWriter(path, identity, subject, false).write(film, {});
    EXPECT_EQ(differingPixelCount(readCheckpoint(path, identity, subject).film, film), 0u);
    EXPECT_EQ(readCheckpointFile(path).film.first.size(), 6u);
    const CheckpointSubject part{{2, 5, 1, 3}, {1, 1}, 16, "made here"};
    CheckpointWriter(path, identity, part, false).write(film, {});
    const Checkpoint resumed = readCheckpoint(path, identity, part);
    EXPECT_EQ(resumed.film.first[5].sampleCount, 8u);
    film.first[5].mean.y = 7.0f;
    EXPECT_EQ(firstDifference(resumed.film, film), 5u);
    film.first.clear();
    CheckpointWriter(path, identity, subject, false).write(film, {});
    EXPECT_TRUE(readCheckpoint(path, identity, subject).film.first.empty());
}

TEST_F(CheckpointTest, APartHasItsOwnPixelsAndLayersOnly) {
    const Crop crop{10, 60, 5, 45};
    Film film(crop);
    Film layer(crop);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        film.pixels[i].sum = glm::vec3(static_cast<float>(i));
        film.pixels[i].sampleCount = 3;
        film.pixels[i].sumOfSquares = glm::vec3(0.5f);
        layer.pixels[i].sum = glm::vec3(-static_cast<float>(i));
        layer.pixels[i].sampleCount = 1;
    }
    const Partition partition(crop, 3);
    for (std::uint32_t index = 1; index <= 3; ++index) {
        const CheckpointSubject part{crop, {index, 3}, 4, "made here"};
        const RayCounts rays{index, 2, 3, 4, 5};
        fs::remove(path);
        CheckpointWriter(path, identity, part, false).write(film, rays, std::array<const Film *, 1>{&layer});
        const CheckpointFile file = readCheckpointFile(path);
        EXPECT_EQ(file.part, part.part);
        EXPECT_EQ(file.identity, "seed: 7\nsampler: sobol\n");
        EXPECT_EQ(file.origin, "made here");
        EXPECT_EQ(file.samplesPerPixel, 4u);
        EXPECT_EQ(file.rays, rays);
        EXPECT_EQ(file.film.pixels.size(), partition.pixelCountOf(index));
        ASSERT_EQ(file.layers.size(), 1u);
        EXPECT_EQ(file.layers[0].pixels[7].sum, -file.film.pixels[7].sum);
        // What goes on has the pixels of others as finished.
        const Checkpoint resumed = readCheckpoint(path, identity, part);
        const FilmRecords own = recordsIn(film, partition.squaresOf(index));
        const FilmRecords there = recordsIn(resumed.film, partition.squaresOf(index));
        EXPECT_EQ(firstDifference(own, there), own.pixels.size());
        EXPECT_EQ(std::ranges::count(resumed.film.pixels, 4u, &layout::FilmPixel::sampleCount),
                  std::ssize(film.pixels) - std::ssize(own.pixels));
    }
    EXPECT_THROW((void)readCheckpoint(path, identity, {crop, {2, 3}, 4, {}}), Error);
}

TEST_F(CheckpointTest, AnotherRendersIsRefusedWithBothValues) {
    CheckpointWriter(path, identity, subject, false).write(filmOf(3), {});
    CheckpointWriter(path.string() + ".1", {{"seed", "8"}, {"sampler", "sobol"}}, subject, false)
        .write(filmOf(3), {});
    EXPECT_NE(refusal({{"seed", "8"}, {"sampler", "sobol"}}).find("seed: 7 there, 8 here"), std::string::npos)
        << "and what fits is not looked for in the older one";
    EXPECT_NE(
        refusal({{"seed", "7"}, {"sampler", "sobol"}, {"more", "x"}}).find("more: nothing there, x here"),
        std::string::npos);
    EXPECT_NE(refusal({{"seed", "7"}}).find("does not know"), std::string::npos);
    EXPECT_NE(refusal(identity, {2, 5, 2, 4}).find("2,5,1,3 there, 2,5,2,4 here"), std::string::npos);
    EXPECT_NE(refusal(identity, {2, 5, 1, 3}, 2).find("up to 3 there, 2 here"), std::string::npos);
    EXPECT_EQ(refusal(identity, {2, 5, 1, 3}, 3), "");
}

TEST_F(CheckpointTest, WhereThereIsNoRoomThoseThatWereThereStay) {
    CheckpointWriter writer(path, identity, subject, false);
    writer.write(filmOf(1), {});
    writer.write(filmOf(2), {});
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto signalBefore = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit = before;
    limit.rlim_cur = 100;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
    EXPECT_THROW(writer.write(filmOf(3), {}), Error);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, signalBefore);
    EXPECT_TRUE(hasSamples(resume(path), 2));
    EXPECT_EQ(entries(), (std::set<std::string>{"c", "c.1"}));
    fs::remove(path);
    EXPECT_TRUE(hasSamples(resume(path), 1));
}

TEST_F(CheckpointTest, ALinkKeepsBothGenerationsBesideTheFileItself) {
    fs::create_directory(folder / "far");
    fs::create_symlink("far/real", path);
    CheckpointWriter writer(path, identity, subject, false);
    writer.write(filmOf(1), {});
    writer.write(filmOf(2), {});
    EXPECT_TRUE(fs::is_symlink(path));
    EXPECT_TRUE(fs::exists(folder / "far/real.1"));
    store(path, "damaged");
    EXPECT_TRUE(hasSamples(resume(path), 1));
}

} // namespace
} // namespace hyalite::core
