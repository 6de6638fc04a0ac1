#include "host/report/provenance.h"

#include "host/base/version.h"

#include <gtest/gtest.h>

#include <map>

namespace hyalite::core {
namespace {

Provenance exampleOrigin() {
    Provenance origin;
    origin.commandLine = "hyalite render a.json";
    origin.scene = "a.json";
    origin.sceneHash = 0x12;
    origin.triangleCount = 3;
    origin.width = 64;
    origin.height = 48;
    origin.settings.samplesPerPixel = 5;
    origin.settings.seed = 4'000'000'000;
    return origin;
}

TEST(Provenance, AKernelHasAHashAndTheReferenceRendererHasNone) {
    const nlohmann::ordered_json device =
        rendererToJson({"a GPU", "driver 1", "native", "promised", "stack", 0xabc});
    EXPECT_EQ(device["kernel"]["name"], "stack");
    EXPECT_EQ(device["kernel"]["spirvHash"], "0000000000000abc");
    EXPECT_FALSE(rendererToJson({"cpu", "", "", "", "", 0}).contains("kernel"));
}

TEST(Provenance, PicturesSayWhatReportsSay) {
    const nlohmann::ordered_json json =
        provenanceToJson(exampleOrigin(), {"a GPU", "driver 1", "native", "promised", "stack", 0xabc});
    std::map<std::string, std::string> texts;
    for (const Attribute &attribute : attributesOf(json))
        EXPECT_TRUE(texts.insert(attribute).second) << attribute.first;
    EXPECT_EQ(texts.at("software"), "hyalite " HYALITE_VERSION);
    EXPECT_EQ(texts.at("commandLine"), "hyalite render a.json");
    EXPECT_EQ(texts.at("scene"), "a.json");
    EXPECT_EQ(texts.at("sceneHash"), "0000000000000012");
    EXPECT_EQ(texts.at("image.width"), "64");
    EXPECT_EQ(texts.at("settings.spp"), "5");
    EXPECT_EQ(texts.at("settings.seed"), "4000000000");
    EXPECT_EQ(texts.at("device.name"), "a GPU");
    EXPECT_EQ(texts.at("device.driver"), "driver 1");
    EXPECT_EQ(texts.at("device.kernel.spirvHash"), "0000000000000abc");
    EXPECT_EQ(texts.size(), json.flatten().size());
}

} // namespace
} // namespace hyalite::core
