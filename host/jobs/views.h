// Views: pictures of a scene from several sides, by cameras that frame it or one of its objects.
#pragma once

#include "host/base/atomic_file.h"
#include "host/jobs/render_session.h"
#include "host/scene/framing.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hyalite::core {

struct View {
    std::string name;
    ViewDirection from;
};

/// Views by name. Up is that of the scene; the front is +z where up is +y.
inline constexpr std::array<std::pair<std::string_view, ViewDirection>, 7> viewNames{
    {{"front", {0.0, 0.0}},
     {"back", {180.0, 0.0}},
     {"left", {-90.0, 0.0}},
     {"right", {90.0, 0.0}},
     {"top", {0.0, 90.0}},
     {"bottom", {0.0, -90.0}},
     {"iso", {45.0, 35.264389682754654}}}}; // a cube's corner is in the middle

/// So many views evenly around, the first one from the front, each further to the right and 20 degrees above the
/// horizon: "contact-1" and so on.
[[nodiscard]] std::vector<View> viewsAround(int count);

struct ViewOptions {
    std::vector<View> views;
    std::string object{}; ///< what the cameras frame: boundsNamed() in scene/scene_nodes.h; empty: all

    [[nodiscard]] bool areGiven() const { return !views.empty(); }
};

/// The part of a file name that the name of a view replaces.
inline constexpr std::string_view viewPlaceholder = "{view}";

class ViewSeries {
  public:
    /// Throws Error{Usage} for names of files that do not fit: those of several views have the placeholder, but for a
    /// PNG, which then is a sheet.
    ViewSeries(RenderRequest request, ViewOptions options);

    [[nodiscard]] const std::vector<View> &views() const { return options_.views; }
    /// Whether all views go into one file.
    [[nodiscard]] bool isSheet() const { return isSheet_; }
    /// The request for a view with a file of its own.
    [[nodiscard]] RenderRequest requestOf(const View &view) const;

    /// Prepares the session, and finds what is to be framed. Throws Error{Usage} for an object that is not there, and
    /// Error{BadInput} for one that is too small or too large.
    void prepare(RenderSession &session);

    /// Moves the session's camera, and the lights that follow it.
    void moveTo(const View &view, RenderSession &session) const;

  private:
    const RenderRequest request_;
    const ViewOptions options_;
    bool isSheet_ = false;
    Bounds all_ = noBounds;
    Bounds framed_ = noBounds;
    glm::dvec3 up_{0.0, 1.0, 0.0};
};

struct FinishedSheet {
    int width = 0; ///< pixels
    int height = 0;
    std::size_t viewCount = 0; ///< that have all their samples
    double renderSeconds = 0.0;
    std::uint64_t rayCount = 0;
};

/// Renders all views, and writes their sheet; the session is open. At the end of the request's time limit, the sheet
/// has what is finished. Throws Error for a stop: then nothing is written.
[[nodiscard]] FinishedSheet renderSheet(const ViewSeries &series, const RenderRequest &request,
                                        AtomicFile &file, const std::string &commandLine,
                                        RenderSession &session);

} // namespace hyalite::core
