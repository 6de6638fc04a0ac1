// Work charges: rows by name, the dearest first, with a sum of those that are left out.
#include "host/report/work_charges.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

/// Objects: nothing, "cheap", "dear", "unmet", "glowing".
WorkLedger handMadeLedger() {
    WorkLedger ledger;
    ledger.charge(PathStage::Primary, 0, 0, {2, 10, 0});
    ledger.charge(PathStage::Primary, 1, 1, {5, 20, 0});
    ledger.charge(PathStage::Further, 2, 1, {1, 30, 30});
    ledger.charge(PathStage::Shadow, 4, 2, {7, 5, 5});
    ledger.shading.lobes[static_cast<std::size_t>(Lobe::Diffuse)] = 30;
    ledger.shading.lobes[static_cast<std::size_t>(Lobe::Glossy)] = 10;
    ledger.shading.lightSamples = 41;
    ledger.shading.textureReads = 9000;
    ledger.shading.filmSamples = 8;
    return ledger;
}

WorkCharges handMadeCharges() {
    return chargesOf(handMadeLedger(), 4, {"cheap", "dear", "unmet", "glowing"}, {"red", "blue"});
}

TEST(WorkCharges, AreInTheOrderOfTheirTests) {
    const WorkCharges charges = handMadeCharges();
    ASSERT_EQ(charges.objects.size(), 4u);
    EXPECT_EQ(charges.objects[0].name, "dear");
    EXPECT_EQ(charges.objects[1].name, "cheap");
    EXPECT_EQ(charges.objects[2].name, "glowing") << "of equal tests, with more rays";
    EXPECT_EQ(charges.objects[3].name, "");
    EXPECT_EQ(charges.materials[0].name, "red");
    EXPECT_EQ(sumOf(charges.totals), (ChargedWork{15, 65, 35}));
    EXPECT_EQ(dearestText(charges),
              "dear 60.0 %, cheap 20.0 %, glowing 10.0 % of the box and triangle tests");
}

TEST(WorkCharges, AreRaysWhereNothingIsTested) {
    WorkLedger ledger;
    ledger.charge(PathStage::Primary, 1, 1, {3, 0, 0});
    ledger.charge(PathStage::Primary, 0, 0, {1, 0, 0});
    EXPECT_EQ(dearestText(chargesOf(ledger, 1, {"sphere 0"}, {"red"})), "sphere 0 75.0 % of the rays");
    EXPECT_EQ(dearestText(chargesOf({}, 1, {}, {})), "no object is met");
}

TEST(WorkCharges, TellWhatWasShaded) {
    const ShadingCounts shading = handMadeCharges().shading;
    EXPECT_EQ(shadingText(shading),
              "40 surfaces: diffuse 75.0 %, glossy 25.0 %; 41 light samples, 9.00 k texture reads");
    EXPECT_EQ(shadingText({}), "0 surfaces; 0 light samples");
    ShadingCounts twice = shading;
    twice += shading;
    const nlohmann::json json = chargesToJson(handMadeCharges()).at("shading");
    EXPECT_EQ(json.at("lobes").at("diffuse"), 30);
    EXPECT_EQ(json.at("lobes").size(), lobeNames.size());
    EXPECT_EQ(twice.textureReads, 2 * json.at("textureReads").get<std::uint64_t>());
    EXPECT_EQ(twice.lobes[0], 60u);
    EXPECT_EQ(json.at("filmSamples"), 8);
}

TEST(WorkCharges, AsJsonSumUpWhatIsLeftOut) {
    const nlohmann::json json = chargesToJson(handMadeCharges(), 2);
    EXPECT_EQ(json.at("samplesPerPixel"), 4);
    EXPECT_EQ(json.at("objects").at("rows").size(), 2u);
    EXPECT_EQ(json.at("objects").at("otherCount"), 2);
    EXPECT_EQ(json.at("objects").at("others").at("shadow"),
              (nlohmann::json{{"rays", 7}, {"boxesTested", 5}, {"trianglesTested", 5}}));
    EXPECT_EQ(json.at("objects").at("others").at("primary").at("rays"), 2);
    EXPECT_EQ(json.at("stages").at("further").at("boxesTested"), 30);
    EXPECT_FALSE(chargesToJson(handMadeCharges()).at("objects").contains("others"));
}

} // namespace
} // namespace hyalite::core
