#include "host/view/view_site.h"

#include "host/base/json_document.h"
#include "host/engine/scene_options.h"
#include "host/image/tone_map.h"
#include "host/scene/settings_table.h"
#include "host/view/view_page.h"

#include <fmt/format.h>

#include <charconv>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

namespace hyalite::core {

namespace {

using std::chrono::milliseconds;

constexpr int maxListeners = 16;                         ///< pages that are open
constexpr milliseconds betweenStates{10};                ///< at least
constexpr milliseconds betweenSigns{5000};               ///< of life
constexpr std::size_t pieceBytes = std::size_t{1} << 18; ///< of a frame, between two looks at the connection

struct Asset {
    const char *path;
    const char *type;
    std::string_view text;
};
constexpr std::array assets{
    Asset{"/view.css", "text/css; charset=utf-8", view_page::viewCss},
    Asset{"/view.js", "text/javascript; charset=utf-8", view_page::viewJs},
    Asset{"/camera.js", "text/javascript; charset=utf-8", view_page::cameraJs},
    Asset{"/tone.js", "text/javascript; charset=utf-8", view_page::toneJs},
    Asset{"/icon.svg", "image/svg+xml", view_page::iconSvg},
};

/// Sent with every answer. The page runs its own scripts alone, in no other page's frame, and tells no other site of itself.
httplib::Headers safeHeaders() {
    return {{"Content-Security-Policy",
             "default-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"},
            {"Referrer-Policy", "no-referrer"},
            {"X-Content-Type-Options", "nosniff"},
            {"Cross-Origin-Opener-Policy", "same-origin"},
            {"Cross-Origin-Resource-Policy", "same-origin"},
            {"Cache-Control", "no-store"}};
}

void refuse(httplib::Response &response, int status, const std::string &why) {
    response.status = status;
    response.set_content(why + "\n", "text/plain; charset=utf-8");
}

void sendJson(httplib::Response &response, const nlohmann::ordered_json &json) {
    response.set_content(json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace),
                         "application/json");
}

/// Throws OverrideError.
double numberIn(const httplib::Request &request, const std::string &name, const Interval &allowed,
                double without) {
    if (!request.has_param(name))
        return without;
    const std::string text = request.get_param_value(name);
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || !allowed.contains(number))
        throw OverrideError(name, refusalText(text, "a number " + allowed.text()));
    return number;
}

bool isAskedFor(const httplib::Request &request, const std::string &name) {
    return request.get_param_value(name) == "1";
}

std::size_t rendererIn(const httplib::Request &request, const Viewer &viewer) {
    return static_cast<std::size_t>(
        numberIn(request, "renderer", {0.0, static_cast<double>(viewer.rendererCount() - 1)}, 0.0));
}

std::string hostText(const std::string &address) {
    return address.find(':') == std::string::npos ? address : "[" + address + "]";
}

} // namespace

ViewSite::ViewSite(Viewer &viewer, const std::string &address, int port)
    : viewer_(viewer), address_(address), port_([&] {
          const int bound = server_.bindTo(address, port);
          if (bound < 0)
              throw Error(ErrorKind::Usage,
                          fmt::format("cannot listen at {}:{}: another program may have this port; choose "
                                      "another one, or 0 for any that is free",
                                      hostText(address), port));
          return bound;
      }()),
      access_(address, port_) {
    addRoutes();
    thread_ = std::thread([this] {
        server_.listen_after_bind();
        hasEnded_ = true;
    });
}

ViewSite::~ViewSite() { stop(); }

void ViewSite::stop() {
    if (!thread_.joinable())
        return;
    while (!server_.is_running() && !hasEnded_) // else it would not notice
        std::this_thread::sleep_for(milliseconds(1));
    server_.stopAll();
    thread_.join();
}

std::string ViewSite::url() const {
    const bool isEverywhere = address_ == "0.0.0.0" || address_ == "::";
    return fmt::format("http://{}:{}/?token={}", isEverywhere ? "localhost" : hostText(address_), port_,
                       access_.token());
}

bool ViewSite::isAllowed(const httplib::Request &request, httplib::Response &response) const {
    const bool isChange = request.method == "POST";
    if (request.method != "GET" && !isChange) {
        refuse(response, 405, "only GET and POST are answered");
        return false;
    }
    if (request.has_header("Transfer-Encoding")) {
        refuse(response, 411, "a body has a Content-Length");
        return false;
    }
    const RequestOrigin origin{request.get_header_value("Host"), request.get_header_value("Origin"),
                               request.get_header_value("Sec-Fetch-Site"), request.get_header_value("Cookie"),
                               isChange};
    if (const std::string why = access_.refusal(origin); !why.empty()) {
        refuse(response, 403, why);
        return false;
    }
    const bool isFrontDoor = request.path == "/" && request.has_param("token");
    if (!isFrontDoor && !access_.isKnown(origin)) {
        refuse(response, 403, "open the address that `hyalite view` printed, with its token");
        return false;
    }
    return true;
}

void ViewSite::addRoutes() {
    using httplib::Request;
    using httplib::Response;
    server_.set_default_headers(safeHeaders());
    server_.set_pre_routing_handler([this](const Request &request, Response &response) {
        return isAllowed(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                            : httplib::Server::HandlerResponse::Handled;
    });
    server_.set_exception_handler([](const Request &, Response &response, std::exception_ptr failure) {
        try {
            std::rethrow_exception(std::move(failure));
        } catch (const OverrideError &error) {
            refuse(response, 400, fmt::format("{}: {}", error.name, error.what()));
        } catch (const Error &error) {
            refuse(response, error.kind == ErrorKind::BadInput ? 409 : 400, error.what());
        } catch (const std::exception &error) {
            refuse(response, 500, error.what());
        }
    });
    server_.set_error_handler([](const Request &, Response &response) {
        if (response.body.empty())
            response.set_content(fmt::format("{}\n", response.status), "text/plain; charset=utf-8");
    });
    server_.Get("/", [this](const Request &request, Response &response) { sendFront(request, response); });
    for (const Asset &asset : assets)
        server_.Get(asset.path, [asset](const Request &, Response &response) {
            response.set_content(asset.text.data(), asset.text.size(), asset.type);
        });
    server_.Get("/events", [this](const Request &, Response &response) { sendEvents(response); });
    server_.Get("/state",
                [this](const Request &, Response &response) { sendJson(response, viewer_.state()); });
    server_.Get("/frame", [this](const Request &request, Response &response) {
        sendFrame(rendererIn(request, viewer_), request, response);
    });
    server_.Get("/pick", [this](const Request &request, Response &response) { sendPick(request, response); });
    server_.Get("/picture.png", [this](const Request &request, Response &response) {
        sendPicture(ImageFormat::Png, request, response);
    });
    server_.Get("/picture.exr", [this](const Request &request, Response &response) {
        sendPicture(ImageFormat::Exr, request, response);
    });
    server_.Get("/scene.json", [this](const Request &, Response &response) {
        response.set_content(viewer_.sceneText(), "application/json");
    });
    server_.Post("/change",
                 [this](const Request &request, Response &response) { takeChange(request, response); });
}

void ViewSite::sendFront(const httplib::Request &request, httplib::Response &response) const {
    if (!request.has_param("token")) {
        response.set_content(view_page::viewHtml.data(), view_page::viewHtml.size(),
                             "text/html; charset=utf-8");
        return;
    }
    if (!access_.isToken(request.get_param_value("token"))) {
        refuse(response, 403,
               "this is not the token of this run: open the address that `hyalite view` printed");
        return;
    }
    response.set_header("Set-Cookie", access_.cookieHeader());
    response.set_redirect("/", 303); // without the token, which others may see in a history
}

void ViewSite::sendEvents(httplib::Response &response) {
    if (listeners_.fetch_add(1) >= maxListeners) {
        --listeners_;
        refuse(response, 503, fmt::format("{} pages are open already", maxListeners));
        return;
    }
    auto seen = std::make_shared<std::uint64_t>(0);
    response.set_chunked_content_provider(
        "text/event-stream",
        [this, seen](std::size_t, httplib::DataSink &sink) {
            if (server_.isStopping())
                return false;
            const std::uint64_t news = viewer_.waitForNews(*seen, betweenSigns);
            if (server_.isStopping())
                return false;
            const std::string text =
                news == *seen ? ": alive\n\n"
                              : fmt::format("data: {}\n\n",
                                            viewer_.state().dump(-1, ' ', false,
                                                                 nlohmann::json::error_handler_t::replace));
            *seen = news;
            if (!sink.write(text.data(), text.size()))
                return false;
            std::this_thread::sleep_for(betweenStates);
            return true;
        },
        [this](bool) { --listeners_; });
}

/// Three floats a pixel, little-endian, row by row from the top, behind a line of JSON that says what they are.
void ViewSite::sendFrame(std::size_t renderer, const httplib::Request &request,
                         httplib::Response &response) const {
    static_assert(std::endian::native == std::endian::little);
    const std::shared_ptr<const ViewFrame> frame = viewer_.frame(renderer, isAskedFor(request, "clean"));
    if (frame == nullptr) {
        refuse(response, 404, "there is no picture yet");
        return;
    }
    std::string head =
        nlohmann::ordered_json{{"view", frame->view},           {"number", frame->number},
                               {"width", frame->image.width()}, {"height", frame->image.height()},
                               {"samples", frame->samples},     {"isPreview", frame->isPreview},
                               {"isClean", frame->isClean}}
            .dump();
    head.resize((head.size() + 4) / 4 * 4, ' '); // floats begin at a multiple of their size
    head.back() = '\n';
    const auto pixels = std::as_bytes(std::span(frame->image.pixels()));
    response.set_content_provider(
        head.size() + pixels.size(), "application/octet-stream",
        [frame, head, pixels](std::size_t offset, std::size_t length, httplib::DataSink &sink) {
            if (offset < head.size())
                return sink.write(head.data() + offset, head.size() - offset);
            const auto rest = pixels.subspan(offset - head.size());
            const std::size_t size = std::min({rest.size(), length, pieceBytes});
            return sink.write(reinterpret_cast<const char *>(rest.data()), size);
        });
}

void ViewSite::sendPick(const httplib::Request &request, httplib::Response &response) const {
    const Interval share{0.0, 1.0};
    const std::optional<Pick> pick =
        viewer_.pick(numberIn(request, "x", share, 0.5), numberIn(request, "y", share, 0.5));
    if (!pick) {
        sendJson(response, nullptr);
        return;
    }
    const glm::dvec3 &p = pick->position;
    sendJson(response, {{"position", {p.x, p.y, p.z}},
                        {"distance", pick->distance},
                        {"depth", pick->depth},
                        {"object", pick->object},
                        {"material", pick->material}});
}

void ViewSite::sendPicture(ImageFormat format, const httplib::Request &request,
                           httplib::Response &response) const {
    PictureWish file{.format = format, .isClean = isAskedFor(request, "clean")};
    if (request.has_param("tone"))
        file.tone = chosenFrom(toneCurveNames, request.get_param_value("tone"), "tone");
    file.exposureStops = numberIn(request, "exposure", rangeOf(&RenderSettings::exposureStops), 0.0);
    auto bytes = std::make_shared<const std::vector<std::byte>>(
        viewer_.pictureFile(rendererIn(request, viewer_), file));
    response.set_header("Content-Disposition", "attachment");
    response.set_content_provider(bytes->size(), format == ImageFormat::Png ? "image/png" : "image/x-exr",
                                  [bytes](std::size_t offset, std::size_t length, httplib::DataSink &sink) {
                                      return sink.write(reinterpret_cast<const char *>(bytes->data()) +
                                                            offset,
                                                        std::min(length, pieceBytes));
                                  });
}

void ViewSite::takeChange(const httplib::Request &request, httplib::Response &response) {
    viewer_.change(parseJson(request.body, "the change"));
    sendJson(response, viewer_.state());
}

} // namespace hyalite::core
