// Numbers as people read them.
#include "host/base/quantities.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

TEST(Quantities, DurationsHaveTwoUnitsAtMost) {
    EXPECT_EQ(durationText(0.4), "0 s");
    EXPECT_EQ(durationText(59.4), "59 s");
    EXPECT_EQ(durationText(59.6), "1 min 00 s");
    EXPECT_EQ(durationText(185), "3 min 05 s");
    EXPECT_EQ(durationText(7800), "2 h 10 min");
}

TEST(Quantities, LargeCountsAreRoundedToThreeDigits) {
    EXPECT_EQ(roundedText(0, "rays"), "0 rays");
    EXPECT_EQ(roundedText(999, "rays"), "999 rays");
    EXPECT_EQ(roundedText(1000, "rays"), "1.00 k rays");
    EXPECT_EQ(roundedText(12'345, "rays"), "12.3 k rays");
    EXPECT_EQ(roundedText(2'140'000, "rays"), "2.14 M rays");
    EXPECT_EQ(roundedText(123'456'789'012, "rays"), "123 G rays");
}

TEST(Quantities, SizesAreInPowersOf1024) {
    EXPECT_EQ(sizeText(512), "512 bytes");
    EXPECT_EQ(sizeText(1536), "1.5 KiB");
    EXPECT_EQ(sizeText(std::uint64_t{44} << 30), "44.0 GiB");
}

TEST(Quantities, OneIsSingular) {
    EXPECT_EQ(countText(0, "light"), "0 lights");
    EXPECT_EQ(countText(1, "light"), "1 light");
    EXPECT_EQ(countText(1, "mesh", "meshes"), "1 mesh");
    EXPECT_EQ(countText(2, "mesh", "meshes"), "2 meshes");
}

} // namespace
} // namespace hyalite::core
