// Who may ask the viewer for anything.
#include "host/view/access.h"

#include <gtest/gtest.h>

#include <set>

namespace hyalite::core {
namespace {

RequestOrigin fromPage(const std::string &host) {
    return {.host = host, .origin = "http://" + host, .fetchSite = "same-origin", .cookies = {}};
}

TEST(Access, TokensAreOfTheirOwn) {
    std::set<std::string> tokens;
    for (int i = 0; i < 100; ++i) {
        const std::string token = randomToken();
        EXPECT_EQ(token.size(), 64u);
        EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
        tokens.insert(token);
    }
    EXPECT_EQ(tokens.size(), 100u);
}

TEST(Access, ComparesWholeTexts) {
    EXPECT_TRUE(isEqualInConstantTime("", ""));
    EXPECT_TRUE(isEqualInConstantTime("abc", "abc"));
    for (const char *other : {"", "ab", "abcd", "abd", "xbc"})
        EXPECT_FALSE(isEqualInConstantTime("abc", other)) << other;
}

TEST(Access, IsByTheCookieOfThisRun) {
    const Access access("127.0.0.1", 8000);
    const Access next("127.0.0.1", 8000);
    const std::string header = access.cookieHeader();
    for (const char *part : {"HttpOnly", "SameSite=Strict", "Path=/"})
        EXPECT_NE(header.find(part), std::string::npos) << part;
    const std::string cookie = header.substr(0, header.find(';'));
    RequestOrigin request = fromPage("127.0.0.1:8000");
    EXPECT_FALSE(access.isKnown(request));
    for (const std::string &cookies : {cookie, "a=b; " + cookie, cookie + "; c=d", "a; " + cookie}) {
        request.cookies = cookies;
        EXPECT_TRUE(access.isKnown(request)) << cookies;
        EXPECT_FALSE(next.isKnown(request)) << "another run has another one";
    }
    for (const std::string &cookies :
         {std::string("hyalite-8000="), "x" + cookie, cookie + "0", cookie.substr(1)}) {
        request.cookies = cookies;
        EXPECT_FALSE(access.isKnown(request)) << cookies;
    }
    EXPECT_TRUE(access.isToken(access.token()));
    EXPECT_FALSE(access.isToken(""));
    EXPECT_FALSE(access.isToken(next.token()));
}

// Through a tunnel, the port is another one.
TEST(Access, KnowsTheNamesOfThisMachine) {
    const Access access("127.0.0.1", 8000);
    for (const char *host :
         {"127.0.0.1:8000", "localhost:8000", "LOCALHOST", "localhost:1234", "[::1]:8000", "127.1.2.3"})
        EXPECT_EQ(access.refusal(fromPage(host)), "") << host;
    for (const char *host :
         {"", "example.com", "example.com:8000", "127.0.0.1.example.com", "localhost.example.com",
          "192.168.1.2:8000", "[::2]:8000", "[", "127.evil", "::1"})
        EXPECT_NE(access.refusal(fromPage(host)), "") << host;
    // To whom others may come, a number is no trick: only names can be made to point elsewhere.
    const Access open("0.0.0.0", 8000);
    for (const char *host : {"192.168.1.2:8000", "[fe80::1]:8000", "localhost"})
        EXPECT_EQ(open.refusal(fromPage(host)), "") << host;
    EXPECT_NE(open.refusal(fromPage("example.com")), "");
}

TEST(Access, IsNotForOtherSites) {
    const Access access("127.0.0.1", 8000);
    const std::string host = "127.0.0.1:8000";
    RequestOrigin typed{.host = host, .origin = {}, .fetchSite = "none", .cookies = {}};
    EXPECT_EQ(access.refusal(typed), "");
    typed.changesState = true;
    EXPECT_NE(access.refusal(typed), "") << "a change without an origin";
    for (const char *origin : {"http://example.com", "null", "https://127.0.0.1:8000",
                               "http://127.0.0.1:8001", "http://localhost:8000"}) {
        RequestOrigin request = fromPage(host);
        request.origin = origin;
        EXPECT_NE(access.refusal(request), "") << origin;
    }
    for (const char *site : {"cross-site", "same-site"}) {
        RequestOrigin request = fromPage(host);
        request.fetchSite = site;
        EXPECT_NE(access.refusal(request), "") << site;
    }
}

} // namespace
} // namespace hyalite::core
