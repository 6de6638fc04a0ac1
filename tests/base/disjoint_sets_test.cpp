#include "host/base/disjoint_sets.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

TEST(DisjointSets, AreOneWhereAChainJoinsThem) {
    DisjointSets sets(6);
    sets.join(0, 1);
    sets.join(2, 3);
    EXPECT_NE(sets.rootOf(1), sets.rootOf(3));
    sets.join(3, 0);
    EXPECT_EQ(sets.rootOf(1), sets.rootOf(2));
    EXPECT_EQ(sets.rootOf(1), 2u);
    EXPECT_EQ(sets.rootOf(5), 5u);
}

} // namespace
} // namespace hyalite::core
