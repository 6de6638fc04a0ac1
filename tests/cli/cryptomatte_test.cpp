// Cryptomattes and layers of numbers, as who opens an EXR finds them.
#include "tests/cli/command_line.h"
#include "tests/cli/exr_channels.h"

#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>

namespace hyalite::core::testing {
namespace {

using Channels = std::map<std::string, std::vector<float>>;

/// What a compositor has of a Cryptomatte.
struct Cryptomatte {
    std::map<std::string, float> ids; ///< by names

    /// Reads the manifest of the Cryptomatte of this name.
    Cryptomatte(const std::map<std::string, std::string> &attributes, const std::string &name) {
        for (const auto &[key, value] : attributes) {
            if (!key.ends_with("/name") || value != name)
                continue;
            const std::string prefix = key.substr(0, key.size() - 4);
            EXPECT_EQ(attributes.at(prefix + "hash"), "MurmurHash3_32");
            EXPECT_EQ(attributes.at(prefix + "conversion"), "uint32_to_float32");
            const nlohmann::json manifest = nlohmann::json::parse(attributes.at(prefix + "manifest"));
            for (const auto &[thing, id] : manifest.items())
                ids[thing] = std::bit_cast<float>(
                    static_cast<std::uint32_t>(std::stoul(id.get<std::string>(), nullptr, 16)));
        }
    }
};

/// The coverage of a thing in each pixel: what a compositor picks.
std::vector<float> matteOf(const Channels &channels, const std::string &name, float id) {
    std::vector<float> matte(channels.at("R").size());
    for (const std::string layer : {"00", "01", "02"})
        for (const auto &[idChannel, coverage] : {std::pair{".r", ".g"}, std::pair{".b", ".a"}})
            for (std::size_t i = 0; i < matte.size(); ++i)
                if (channels.at(name + layer + idChannel)[i] == id)
                    matte[i] += channels.at(name + layer + coverage)[i];
    return matte;
}

struct Cryptomattes : CommandLine {
    void SetUp() override {
        CommandLine::SetUp();
        store("sheet.obj", wavySheetObj(6));
        store("sheet.json", wavySheetScene());
    }
};

TEST_F(Cryptomattes, HaveTheNamesAndTheShareOfEachThing) {
    ASSERT_EQ(run("render sheet.json -o a.exr --quiet --device cpu --width 40 --height 30 --spp 8 "
                  "--layers crypto-object,crypto-material,crypto-asset,albedo")
                  .exitCode,
              0);
    const Channels channels = channelsOf(folder / "a.exr");
    const auto attributes = layerAttributesOf(folder / "a.exr");
    EXPECT_EQ(attributes.size(), 12u);
    for (const auto &[layer, things] : std::map<std::string, std::vector<std::string>>{
             {"CryptoObject", {"sphere 0", "sphere 1", "sheet.obj"}},
             {"CryptoAsset", {"sphere 0", "sphere 1", "sheet.obj"}},
             {"CryptoMaterial", {"mirror", "glass", "sheet"}}}) {
        const Cryptomatte crypto(attributes, layer);
        std::vector<float> all(channels.at("R").size());
        EXPECT_EQ(crypto.ids.size(), 3u);
        for (const std::string &thing : things) {
            const std::vector<float> matte = matteOf(channels, layer, crypto.ids.at(thing));
            for (std::size_t i = 0; i < all.size(); ++i)
                all[i] += matte[i];
            if (thing == "sheet.obj") // the albedo of the others is 1, of this one's red 0.8
                for (std::size_t i = 0; i < all.size(); ++i)
                    if (all[i] == matte[i]) {
                        EXPECT_NEAR(channels.at("albedo.R")[i], 0.8f * matte[i], 1e-6f);
                    }
        }
        EXPECT_EQ(*std::ranges::max_element(all), 1.0f);
        EXPECT_EQ(*std::ranges::min_element(all), 0.0f);
    }
}

TEST_F(Cryptomattes, AgreeWithLayersOfNumbers) {
    ASSERT_EQ(run("render sheet.json -o a.exr --quiet --device cpu --width 40 --height 30 --spp 1 "
                  "--sampler centre --layers crypto-object,object-id,material-id,instance-id --report a.json")
                  .exitCode,
              0);
    const Channels channels = channelsOf(folder / "a.exr");
    const auto attributes = layerAttributesOf(folder / "a.exr");
    const nlohmann::json report = nlohmann::json::parse(load("a.json")).at("numbers");
    const nlohmann::json names = nlohmann::json::parse(attributes.at("object-id.names"));
    EXPECT_EQ(report.at("object-id"), names);
    EXPECT_EQ(report.at("material-id").size(), 3u);
    EXPECT_EQ(report.at("instance-id").at("3"), "sheet.obj");
    EXPECT_FALSE(report.contains("crypto-object")) << "its numbers are not in the file";
    const Cryptomatte crypto(attributes, "CryptoObject");
    std::size_t thingCount = 0;
    for (std::size_t i = 0; i < channels.at("R").size(); ++i) {
        const float number = channels.at("object-id.Y")[i];
        EXPECT_EQ(number, std::floor(number));
        EXPECT_EQ(channels.at("CryptoObject00.g")[i], number == 0.0f ? 0.0f : 1.0f);
        EXPECT_EQ(channels.at("instance-id.Y")[i], number) << "each thing is there once";
        if (number == 0.0f)
            continue;
        ++thingCount;
        const std::string name = names.at(std::to_string(static_cast<int>(number)));
        EXPECT_EQ(channels.at("CryptoObject00.r")[i], crypto.ids.at(name));
    }
    EXPECT_GT(thingCount, 100u);
    EXPECT_LT(thingCount, channels.at("R").size());
}

TEST_F(Cryptomattes, AreLayersOnly) {
    for (const std::string view : {"crypto-object", "object-id"})
        expectFailure("render sheet.json -o a.exr --integrator " + view, 2, {"--integrator", view, "path"});
}

} // namespace
} // namespace hyalite::core::testing
