// Access to the viewer: who may ask it for anything.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace hyalite::core {

/// What a request says of where it comes from. Empty: nothing.
struct RequestOrigin {
    std::string host;      ///< header Host
    std::string origin;    ///< header Origin
    std::string fetchSite; ///< header Sec-Fetch-Site
    std::string cookies;   ///< header Cookie
    bool changesState = false;
};

/// A text of 64 hexadecimal digits, from the system's random numbers. Throws Error{Internal} if there are none.
[[nodiscard]] std::string randomToken();

/// Whether the texts are equal, in a time that depends on their lengths alone.
[[nodiscard]] bool isEqualInConstantTime(std::string_view a, std::string_view b);

/// The keys of one run of the viewer. The token of the address that is printed is exchanged for a cookie, which a browser
/// sends to this port's pages alone.
class Access {
  public:
    /// `address`: where the viewer listens. Beyond loopback, the machine may be called by its number or its own name.
    Access(const std::string &address, int port);

    [[nodiscard]] const std::string &token() const { return token_; }
    [[nodiscard]] bool isToken(std::string_view text) const { return isEqualInConstantTime(text, token_); }
    /// The header Set-Cookie.
    [[nodiscard]] std::string cookieHeader() const;

    /// Why the request is refused, whoever sent it; empty: it is not. A name that is not the machine's own may be one that
    /// another site made point here (DNS rebinding); an origin that is not the page's own is another site's.
    [[nodiscard]] std::string refusal(const RequestOrigin &request) const;
    /// Whether its cookie is that of this run.
    [[nodiscard]] bool isKnown(const RequestOrigin &request) const;

  private:
    [[nodiscard]] bool isOwnHost(std::string_view host) const;

    bool isLoopback_;
    std::string machine_; ///< its name
    std::string token_;
    std::string cookieName_;
    std::string cookie_;
};

} // namespace hyalite::core
