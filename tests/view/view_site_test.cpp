// The viewer's port: what it answers, and whom not.
#include "host/view/view_site.h"
#include "tests/view/viewer_fixture.h"

#include <fmt/format.h>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

namespace hyalite::core::testing {
namespace {

using httplib::Headers;

struct ViewSites : ViewerFolder {
    std::unique_ptr<Viewer> viewer;
    std::unique_ptr<ViewSite> site;
    std::string token;
    Headers known;

    void SetUp() override {
        ViewerFolder::SetUp();
        viewer = std::make_unique<Viewer>(requestOf(store("ball.json", ballScene(0.5))), nobody());
        waitForAll(*viewer);
        site = std::make_unique<ViewSite>(*viewer, "127.0.0.1", 0);
        token = site->url().substr(site->url().find('=') + 1);
        known = {{"Cookie", cookie()}, {"Origin", origin()}};
    }
    [[nodiscard]] std::string origin() const { return fmt::format("http://127.0.0.1:{}", site->port()); }
    [[nodiscard]] httplib::Client client() const { return httplib::Client(origin()); }
    [[nodiscard]] std::string cookie() const {
        const httplib::Result front = client().Get("/?token=" + token);
        const std::string header = front->get_header_value("Set-Cookie");
        return header.substr(0, header.find(';'));
    }
    [[nodiscard]] int statusOf(const std::string &path, const Headers &headers) const {
        const httplib::Result result = client().Get(path, headers);
        return result ? result->status : -1;
    }

    /// A socket that is connected to the site.
    [[nodiscard]] int connected(int flags = 0) const {
        const int socket = ::socket(AF_INET, SOCK_STREAM | flags, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(site->port()));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        if (socket >= 0 && ::connect(socket, reinterpret_cast<sockaddr *>(&address), sizeof address) != 0 &&
            errno != EINPROGRESS) {
            close(socket);
            return -1;
        }
        return socket;
    }
    /// What comes back for these bytes, until the site hangs up or nothing has come for a while.
    [[nodiscard]] std::string answerTo(const std::string &bytes) const {
        const int socket = connected();
        timeval patience{0, 300'000};
        setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
        static_cast<void>(::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL));
        std::string answer;
        char buffer[4096];
        for (ssize_t count = 0; (count = recv(socket, buffer, sizeof buffer, 0)) > 0;)
            answer.append(buffer, static_cast<std::size_t>(count));
        close(socket);
        return answer;
    }
};

TEST_F(ViewSites, ExchangeTheTokenForACookie) {
    EXPECT_EQ(statusOf("/", {}), 403);
    EXPECT_EQ(statusOf("/?token=" + std::string(64, '0'), {}), 403);
    EXPECT_EQ(statusOf("/?token=", {}), 403);
    const httplib::Result front = client().Get("/?token=" + token);
    EXPECT_EQ(front->status, 303);
    EXPECT_EQ(front->get_header_value("Location"), "/");
    for (const auto &[name, value] :
         Headers{{"Content-Security-Policy",
                  "default-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"},
                 {"Referrer-Policy", "no-referrer"},
                 {"X-Content-Type-Options", "nosniff"}})
        for (const char *path : {"/", "/frame", "/nothing"}) {
            const httplib::Result result = client().Get(path, known);
            EXPECT_EQ(result->get_header_value(name), value) << path;
        }
    for (const char *path : {"/", "/view.js", "/view.css", "/tone.js", "/camera.js", "/icon.svg", "/state",
                             "/frame", "/pick", "/picture.png", "/picture.exr", "/scene.json"}) {
        EXPECT_EQ(statusOf(path, known), 200) << path;
        EXPECT_EQ(statusOf(path, {}), 403) << path;
    }
    EXPECT_EQ(statusOf("/events", {}), 403);
}

TEST_F(ViewSites, AnswerNoOtherSite) {
    for (const auto &[name, value] : Headers{{"Host", "example.com"},
                                             {"Host", fmt::format("example.com:{}", site->port())},
                                             {"Origin", "http://example.com"},
                                             {"Origin", "null"},
                                             {"Sec-Fetch-Site", "cross-site"}}) {
        Headers headers{{"Cookie", known.find("Cookie")->second}, {name, value}};
        EXPECT_EQ(statusOf("/state", headers), 403) << name << ": " << value;
        EXPECT_EQ(statusOf("/?token=" + token, {{name, value}}), 403) << name << ": " << value;
        if (name != "Origin")
            headers.emplace("Origin", origin());
        EXPECT_EQ(client().Post("/change", headers, "{}", "application/json")->status, 403) << value;
    }
    Headers withoutOrigin = known;
    withoutOrigin.erase("Origin");
    EXPECT_EQ(client().Post("/change", withoutOrigin, "{}", "text/plain")->status, 403);
    EXPECT_EQ(client().Post("/change", {{"Origin", origin()}}, "{}", "text/plain")->status, 403);
    EXPECT_EQ(client().Post("/change", known, "{}", "application/json")->status, 200);
}

TEST_F(ViewSites, ChangeNothingByGet) {
    EXPECT_EQ(statusOf("/change", known), 404);
    for (const char *path : {"/../../etc/passwd", "/%2e%2e/etc/passwd", "//etc/passwd", "/view.js/../../x",
                             "/picture.png/x", "/frame/0", "/%00", "/page/view.js", "/.git"})
        EXPECT_NE(statusOf(path, known), 200) << path;
    EXPECT_EQ(client().Delete("/state", known)->status, 405);
    EXPECT_EQ(client().Put("/change", known, "{}", "text/plain")->status, 405);
}

TEST_F(ViewSites, RefuseWhatMeansNothing) {
    const auto post = [&](const std::string &body) {
        const httplib::Result result = client().Post("/change", known, body, "application/json");
        return std::pair(result ? result->status : -1, result ? result->body : "");
    };
    for (const char *body : {"", "{", "[]", "{\"fov\": 999}", "{\"fov\": \"\xff\"}",
                             "{\"environment\": \"/etc/passwd\"}", "{\"show\": {}}", "null"})
        EXPECT_GE(post(body).first, 400) << body;
    EXPECT_EQ(post("{\"fov\": 999}").second,
              "fov: found \"999\"; allowed: a number more than 0 and less than 180\n");
    EXPECT_NE(post(std::string(30'000, '[')).first, 200) << "deep nesting";
    for (const char *path :
         {"/frame?renderer=1", "/frame?renderer=-1", "/frame?renderer=x", "/frame?renderer=nan", "/pick?x=2",
          "/pick?x=1e", "/picture.png?tone=none", "/picture.png?exposure=1e9"})
        EXPECT_EQ(statusOf(path, known), 400) << path;
}

TEST_F(ViewSites, SendFramesToTheBit) {
    const httplib::Result result = client().Get("/frame", known);
    ASSERT_TRUE(result);
    const std::size_t head = result->body.find('\n') + 1;
    const auto json = nlohmann::json::parse(result->body.substr(0, head));
    const std::shared_ptr<const ViewFrame> frame = viewer->frame(0, false);
    EXPECT_EQ(json["width"], 24);
    EXPECT_EQ(json["height"], 16);
    EXPECT_EQ(json["samples"], 4);
    EXPECT_EQ(head % 4, 0u);
    const auto bytes = std::as_bytes(std::span(frame->image.pixels()));
    ASSERT_EQ(result->body.size() - head, bytes.size());
    EXPECT_EQ(std::memcmp(result->body.data() + head, bytes.data(), bytes.size()), 0);
}

TEST_F(ViewSites, TellTheirNews) {
    std::string text;
    httplib::Client listener = client();
    static_cast<void>(listener.Get("/events", known, [&](const char *data, std::size_t size) {
        text.append(data, size);
        if (std::ranges::count(text, '\n') == 2)
            viewer->change({{"fov", 33}});
        return text.find("\"fov\":33.0") == std::string::npos;
    }));
    EXPECT_TRUE(text.starts_with("data: {")) << text.substr(0, 100);
}

TEST_F(ViewSites, SurviveBrokenAndLongRequests) {
    for (const std::string &bytes : std::vector<std::string>{
             std::string("\r\n\r\n"), std::string("GET\r\n\r\n"), std::string("GET / HTTP/9.9\r\n\r\n"),
             std::string("GET / HTTP/1.1\r\nHost\r\n\r\n"),
             std::string("\x16\x03\x01\x02\x00\x01\x00\x01", 8), std::string(1000, '\0'),
             "GET /" + std::string(100'000, 'a') + " HTTP/1.1\r\n\r\n",
             "GET / HTTP/1.1\r\n" + std::string(200'000, 'b'),
             "POST /change HTTP/1.1\r\nHost: localhost\r\nContent-Length: 99999999999\r\n\r\n",
             "POST /change HTTP/1.1\r\nHost: localhost\r\nContent-Length: -1\r\n\r\nabc",
             "POST /change HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\nffffffff\r\n"}) {
        const std::string answer = answerTo(bytes);
        EXPECT_EQ(answer.find("HTTP/1.1 200"), std::string::npos) << bytes.substr(0, 60) << answer;
    }
    // Headers without end: the library has no bound on their number.
    std::string many = "GET / HTTP/1.1\r\nHost: localhost\r\n";
    for (int i = 0; i < 100'000; ++i)
        many += fmt::format("X-{}: y\r\n", i);
    EXPECT_EQ(answerTo(many).find("HTTP/1.1 200"), std::string::npos);
    EXPECT_EQ(statusOf("/state", known), 200);
}

TEST_F(ViewSites, SurviveTenThousandConnections) {
    rlimit limit{};
    getrlimit(RLIMIT_NOFILE, &limit);
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_NOFILE, &limit);
    std::vector<int> sockets;
    for (int i = 0; i < 10'000; ++i) {
        const int socket = connected(SOCK_NONBLOCK);
        if (socket < 0)
            break; // no more descriptors
        if (i % 2 == 0)
            static_cast<void>(::send(socket, "GET / HT", 8, MSG_NOSIGNAL));
        sockets.push_back(socket);
    }
    EXPECT_GT(sockets.size(), 1000u);
    std::ranges::for_each(sockets, close);
    EXPECT_EQ(statusOf("/state", known), 200);
}

TEST_F(ViewSites, EndAtOnceWithConnectionsOpen) {
    const std::vector<int> sockets{connected(), connected(), connected()};
    static_cast<void>(::send(sockets[0], "GET / HTTP/1.1\r\n", 16, MSG_NOSIGNAL));
    const std::string events = "GET /events HTTP/1.1\r\nHost: " + origin().substr(7) +
                               "\r\nCookie: " + known.find("Cookie")->second + "\r\n\r\n";
    static_cast<void>(::send(sockets[1], events.data(), events.size(), MSG_NOSIGNAL));
    char byte = 0;
    EXPECT_EQ(recv(sockets[1], &byte, 1, 0), 1);
    static_cast<void>(viewer->stop(std::chrono::milliseconds(0))); // wakes who waits for news
    site->stop();
    std::ranges::for_each(sockets, close);
    EXPECT_EQ(connected(), -1);
}

} // namespace
} // namespace hyalite::core::testing
