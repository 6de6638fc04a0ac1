// Sequences: frames of one scene by a moving camera, or in time.
#pragma once

#include "host/jobs/render_session.h"
#include "host/scene/camera_path.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

/// Both included.
struct FrameRange {
    int first = 0;
    int last = 0;
};

/// Frames, and how the camera moves.
struct SequenceOptions {
    std::optional<FrameRange> frames; ///< default: those of the turntable
    std::optional<int> turntable;     ///< frames of a full turn; empty: the scene says how its camera moves
    std::optional<double> framesPerSecond; ///< of animations and clips; default: defaultFramesPerSecond
    bool hasMotion = false;                ///< pictures have the layer of motion vectors

    [[nodiscard]] bool areGiven() const { return frames || turntable; }
};

/// Whether an output of this name is a clip, which has all frames: of such a format (clip.h), and without #.
[[nodiscard]] bool isNameOfClip(const std::string &output);

/// "frame.####.exr" in frame 7 is "frame.0007.exr". Throws Error{Usage} unless the name of the file has exactly one run
/// of #; `option` is for the message.
[[nodiscard]] std::string nameOfFrame(const std::string &pattern, int frame, const std::string &option);

class Sequence {
  public:
    /// The file names of the request have #, which the numbers of frames replace, except that of a clip. Throws
    /// Error{Usage} if one has none, or if two files would have the same name.
    Sequence(RenderRequest request, const SequenceOptions &options);

    /// The frames to render: those of the part, if one is asked for; they are dealt in turn.
    [[nodiscard]] const std::vector<int> &frames() const { return frames_; }

    /// The request for one of them.
    [[nodiscard]] RenderRequest requestOf(int frame) const;

    /// Prepares the session, and finds the path of the camera. Throws Error{Usage} if nothing moves, and
    /// Error{BadInput} for a pose that is not valid, with its frame.
    void prepare(RenderSession &session);

    /// Moves the session's camera, or loads the scene as it is then.
    void moveTo(int frame, RenderSession &session);

  private:
    /// The scene in time, in this frame.
    [[nodiscard]] SceneOptions optionsOf(int frame) const;
    /// The camera on its path; before and after the path it stands still.
    [[nodiscard]] Camera cameraOf(int frame, const Camera &camera) const;
    /// Of a scene that moves by time, what motion vectors need of a frame, which is loaded once.
    [[nodiscard]] const MotionFrame &motionFrameOf(int frame);
    [[nodiscard]] NeighbourFrames neighboursOf(int frame, const Camera &camera);

    const RenderRequest request_;
    const std::optional<int> turntable_;
    const bool hasMotion_;
    const SequenceTimes times_;
    std::vector<int> frames_;
    CameraPath path_;
    bool movesByTime_ = false;
    std::optional<Camera> framing_; ///< of a moving scene without a camera: that of the first frame
    std::map<int, MotionFrame> loaded_;
};

} // namespace hyalite::core
