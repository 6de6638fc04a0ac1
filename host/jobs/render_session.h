// A session: a scene and the renderers that are opened for it, for one picture or for many.
#pragma once

#include "host/engine/open_backends.h"
#include "host/engine/prepare.h"
#include "host/farm/rank_backend.h"
#include "host/film/partition.h"
#include "host/image/file_options.h"
#include "host/image/image_file.h"
#include "host/jobs/motion.h"
#include "host/scene/integrators.h"

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

/// A request: what to render, on which device, into which files. The path of a file that is not wanted is empty.
struct RenderRequest {
    SceneOptions scene;
    std::string output;
    FileRequest file;
    RendererNames devices{"auto"}; ///< several share the picture
    int threadCount = 0;           ///< 0: all
    DeviceOptions deviceOptions;
    std::string report;
    std::optional<double> timeLimitSeconds;
    std::string checkpoint;
    std::optional<double> checkpointSeconds; ///< interval; default: 10
    bool isResuming = false;
    /// Only this part of the picture, into the checkpoint `output` instead of a picture; it goes on from what is there.
    std::optional<Part> part;
    /// A frame of a sequence: its picture is written only when it is finished, and says which one it is. A render that
    /// is resuming leaves a picture alone that it would make once more.
    std::optional<int> frame;
    bool isInClip = false;                ///< of a frame: it goes into `output` with the others
    bool hasMotion = false;               ///< of a frame: its picture has the layer of motion vectors
    std::string view{};                   ///< one of several: its picture says which
    std::vector<std::string> words;       ///< of the command line, for who has to make a part again
    std::optional<double> partialSeconds; ///< interval of partial pictures; default: none
    std::string display{}; ///< address of a viewer (display.h) that shows the picture; empty: none
};

/// Of the request's picture. Frames of a clip have the levels of a PNG; a part keeps what an EXR has. Throws as
/// imageFormatOf() does.
[[nodiscard]] ImageFormat formatOf(const RenderRequest &request);

class RenderSession {
  public:
    /// With a pool, the other ranks share the pictures. Both must outlive this.
    explicit RenderSession(Observer &observer, RankPool *pool = nullptr) : observer_(observer), pool_(pool) {}

    /// Loads and builds the scene, and opens the renderers at the same time, as soon as the outline is known. Throws as
    /// prepareScene() does.
    void prepare(const RenderRequest &request, Source source = Source::Dropped);
    /// Another scene for the same renderers. The observer gets nothing: the first scene's messages cover it.
    void replaceScene(const SceneOptions &options);
    [[nodiscard]] Observer &observer() const { return observer_; }
    /// Waits for the renderers, for each picture anew. Throws as openRenderers() does.
    void open();
    /// Whether this is the session's first picture, which has the time of loading and opening.
    [[nodiscard]] bool isFirstPicture() const { return isFirstPicture_; }

    [[nodiscard]] bool isPrepared() const { return scene_.has_value(); }
    [[nodiscard]] bool isOpen() const { return opened_.backend != nullptr; }
    [[nodiscard]] PreparedScene &scene() { return *scene_; }
    [[nodiscard]] const PreparedScene &scene() const { return *scene_; }
    [[nodiscard]] Backend &backend() const { return *opened_.backend; }
    /// Loads the frames beside that of the scene, where a picture has motion vectors.
    std::function<NeighbourFrames()> loadNeighbours{};
    /// Renderers that are left out, each with the reason.
    [[nodiscard]] const std::vector<std::string> &notes() const { return opened_.notes; }

  private:
    Observer &observer_;
    RankPool *pool_;
    std::optional<PreparedScene> scene_;
    std::future<OpenedRenderers> opening_;
    OpenedRenderers opened_;
    bool isFirstPicture_ = false;
};

/// The attributes of a file with several pictures of the session's scene. Its hash would be that of the last camera.
[[nodiscard]] std::vector<Attribute> attributesOfSeveral(const RenderSession &session,
                                                         const std::string &commandLine);

} // namespace hyalite::core
