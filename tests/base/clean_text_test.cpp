#include "host/base/clean_text.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

using namespace std::string_literals;

const std::string instead = "\xEF\xBF\xBD"; // U+FFFD

TEST(CleanText, KeepsWhatIsText) {
    for (const char *text :
         {"", "plain", "two\nlines", "ü \u00A0 \u00FF \u0100 🐈", "quotes ' \" \\ / \\u0041"})
        EXPECT_EQ(cleanText(text), text);
}

TEST(CleanText, HasNoControlCharacters) {
    EXPECT_EQ(cleanText("\x1b[31m\r\t\x7f\0"s), instead + "[31m" + instead + instead + instead + instead);
    EXPECT_EQ(cleanText("\u0080\u009F"), instead + instead);
    EXPECT_EQ(cleanText("\uFFFE\uFFFF\uFFBE"), instead + instead + "\uFFBE");
}

TEST(CleanText, DoesNotTurnOrBreakLines) {
    for (const char *character :
         {"\u061C", "\u200E", "\u200F", "\u2028", "\u2029", "\u202A", "\u202E", "\u2066", "\u2069"})
        EXPECT_EQ(cleanText(std::string("a") + character + "gnp.exe"), "a" + instead + "gnp.exe");
    for (const char *text : {"\u061B", "\u061D", "\u200D", "\u2010", "\u2027", "\u202F", "\u2065", "\u206A"})
        EXPECT_EQ(cleanText(text), text);
}

TEST(CleanText, IsUtf8) {
    EXPECT_EQ(cleanText("a\xff"), "a" + instead);
    EXPECT_EQ(cleanText("\xC2"), instead);
    EXPECT_EQ(cleanText("\x85"), instead);
    EXPECT_EQ(cleanText("\xED\xA0\x80").find('\xED'), std::string::npos) << "half of a pair of UTF-16";
    for (int byte = 1; byte < 256; ++byte)
        EXPECT_EQ(cleanText(cleanText(std::string(3, static_cast<char>(byte)))),
                  cleanText(std::string(3, static_cast<char>(byte))));
}

TEST(Excerpt, IsOneCleanLine) {
    EXPECT_EQ(excerpt("plain \u00A0 text"), "plain \u00A0 text");
    EXPECT_EQ(excerpt("a\nb\x1b[31m\xff"), "a" + instead + "b" + instead + "[31m" + instead);
}

TEST(Excerpt, IsCutBetweenCharacters) {
    EXPECT_EQ(excerpt("abcdef", 6), "abcdef");
    EXPECT_EQ(excerpt("abcdefg", 6), "abcdef...");
    EXPECT_EQ(excerpt("abcde\u00FC", 6), "abcde...");
    EXPECT_EQ(excerpt("abcde\u00FCx", 7), "abcde\u00FC...");
    EXPECT_EQ(excerpt(std::string(1000, '\x80'), 6), "...");
}

} // namespace
} // namespace hyalite::core
