#include "host/view/access.h"

#include "host/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include <arpa/inet.h>
#include <sys/random.h>
#include <unistd.h>

namespace hyalite::core {

namespace {

std::string lowered(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(),
                           [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return lower;
}

/// The name of HOST, HOST:PORT or [HOST]:PORT, without brackets.
std::string nameOfHost(std::string_view host) {
    if (host.starts_with('['))
        return lowered(host.substr(1, host.find(']') - 1));
    return lowered(host.substr(0, host.find(':')));
}

bool isNumber(const std::string &host) {
    std::array<unsigned char, sizeof(in6_addr)> address{};
    return inet_pton(AF_INET, host.c_str(), address.data()) == 1 ||
           inet_pton(AF_INET6, host.c_str(), address.data()) == 1;
}

bool isLoopback(const std::string &host) {
    return host == "localhost" || host == "::1" || (host.starts_with("127.") && isNumber(host));
}

std::string nameOfMachine() {
    std::array<char, 256> name{};
    return gethostname(name.data(), name.size() - 1) == 0 ? lowered(name.data()) : std::string();
}

/// The value of a cookie; empty without it.
std::string_view cookieIn(std::string_view cookies, std::string_view name) {
    while (!cookies.empty()) {
        const std::size_t end = std::min(cookies.find(';'), cookies.size());
        std::string_view cookie = cookies.substr(0, end);
        cookies.remove_prefix(std::min(end + 1, cookies.size()));
        cookie.remove_prefix(std::min(cookie.find_first_not_of(' '), cookie.size()));
        if (cookie.starts_with(name) && cookie.substr(name.size()).starts_with('='))
            return cookie.substr(name.size() + 1);
    }
    return {};
}

} // namespace

std::string randomToken() {
    std::array<unsigned char, 32> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
        throw Error(ErrorKind::Internal, "the system has no random numbers");
    std::string token;
    for (const unsigned char byte : bytes)
        token += fmt::format("{:02x}", byte);
    return token;
}

bool isEqualInConstantTime(std::string_view a, std::string_view b) {
    if (a.size() != b.size())
        return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
    return difference == 0;
}

Access::Access(const std::string &address, int port)
    : isLoopback_(isLoopback(address)), machine_(nameOfMachine()), token_(randomToken()),
      cookieName_(fmt::format("hyalite-{}", port)), cookie_(randomToken()) {}

std::string Access::cookieHeader() const {
    return fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict", cookieName_, cookie_);
}

bool Access::isOwnHost(std::string_view host) const {
    const std::string name = nameOfHost(host);
    return isLoopback(name) || (!isLoopback_ && (isNumber(name) || (!machine_.empty() && name == machine_)));
}

std::string Access::refusal(const RequestOrigin &request) const {
    if (!isOwnHost(request.host))
        return "the host of the address is not this machine";
    const bool isForeign = !request.origin.empty() && request.origin != "http://" + request.host;
    const bool isFromOtherSite =
        !request.fetchSite.empty() && request.fetchSite != "same-origin" && request.fetchSite != "none";
    if (isForeign || isFromOtherSite)
        return "another site asks for it";
    if (request.changesState && request.origin.empty())
        return "a change says where it comes from: the header Origin is missing";
    return {};
}

bool Access::isKnown(const RequestOrigin &request) const {
    return isEqualInConstantTime(cookieIn(request.cookies, cookieName_), cookie_);
}

} // namespace hyalite::core
