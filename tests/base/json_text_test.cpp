// JSON text is UTF-8 whatever it is made of.
#include "host/base/json_text.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

TEST(JsonText, IsUtf8WhateverFileNamesAre) {
    EXPECT_EQ(jsonText({{"output", "a\xff.png"}}), "{\n  \"output\": \"a\xEF\xBF\xBD.png\"\n}\n");
}

} // namespace
} // namespace hyalite::core
