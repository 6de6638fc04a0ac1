// The site of a viewer: its page, its pictures and its wishes, over HTTP.
#pragma once

#include "host/view/access.h"
#include "host/view/bounded_server.h"
#include "host/view/viewer.h"

#include <atomic>
#include <string>
#include <thread>

namespace hyalite::core {

/// Answers from when it is made until stop(). What a request says is never the name of a file.
class ViewSite {
  public:
    /// `address`: that it listens at; `port` 0: any free one. Throws Error{Usage} if it cannot listen there.
    ViewSite(Viewer &viewer, const std::string &address, int port);
    ~ViewSite();
    ViewSite(const ViewSite &) = delete;
    ViewSite &operator=(const ViewSite &) = delete;

    /// The address to open, with the token.
    [[nodiscard]] std::string url() const;
    [[nodiscard]] int port() const { return port_; }
    void stop();

  private:
    void addRoutes();
    [[nodiscard]] bool isAllowed(const httplib::Request &request, httplib::Response &response) const;
    void sendFront(const httplib::Request &request, httplib::Response &response) const;
    void sendEvents(httplib::Response &response);
    void sendFrame(std::size_t renderer, const httplib::Request &request, httplib::Response &response) const;
    void sendPick(const httplib::Request &request, httplib::Response &response) const;
    void sendPicture(ImageFormat format, const httplib::Request &request, httplib::Response &response) const;
    void takeChange(const httplib::Request &request, httplib::Response &response);

    Viewer &viewer_;
    std::string address_;
    BoundedServer server_;
    int port_;
    Access access_;
    std::atomic<int> listeners_ = 0;
    std::atomic<bool> hasEnded_ = false;
    std::thread thread_;
};

} // namespace hyalite::core
