#include "host/jobs/sequence.h"

#include "host/base/error.h"
#include "host/film/checkpoint.h"
#include "host/film/checkpoint_lock.h"
#include "host/image/clip.h"
#include "host/scene/validate.h"

#include <fmt/format.h>

#include <glm/common.hpp>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>
#include <utility>

namespace hyalite::core {

namespace {

/// The box of the tree, and of the spheres beside it.
glm::dvec3 centreOf(const PackedScene &scene) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    const auto include = [&](const glm::dvec3 &from, const glm::dvec3 &to) {
        low = glm::min(low, from);
        high = glm::max(high, to);
    };
    if (scene.hasTriangles)
        include(scene.frame.boundsLower, scene.frame.boundsUpper);
    for (const layout::SphereRecord &sphere : scene.loopSpheres)
        include(glm::dvec3(sphere.centre) - static_cast<double>(sphere.radius),
                glm::dvec3(sphere.centre) + static_cast<double>(sphere.radius));
    return low.x <= high.x ? 0.5 * (low + high) : glm::dvec3(0.0);
}

/// With these overrides a camera would stand still.
void requireNoPlace(const SceneOptions &options) {
    for (const auto &[name, values] : {std::pair{"camera-position", &options.cameraPosition},
                                       {"look-at", &options.lookAt},
                                       {"up", &options.up}})
        if (!values->empty())
            throw OverrideError(name, "found beside a camera that moves by itself; allowed: for one picture",
                                Remedy::Turntable);
}

SequenceTimes timesOf(const SequenceOptions &options, bool isOfClip) {
    const FrameRange range = options.frames.value_or(FrameRange{0, options.turntable.value_or(1) - 1});
    return {options.framesPerSecond, range.first, range.last, isOfClip};
}

} // namespace

bool isNameOfClip(const std::string &output) {
    return clipFormatOf(output) &&
           std::filesystem::path(output).filename().string().find('#') == std::string::npos;
}

std::string nameOfFrame(const std::string &pattern, int frame, const std::string &option) {
    const std::filesystem::path path(pattern);
    const std::string name = path.filename().string();
    const std::size_t begin = name.find('#');
    const std::size_t end = begin == std::string::npos ? begin : name.find_first_not_of('#', begin);
    if (begin == std::string::npos || (end != std::string::npos && name.find('#', end) != std::string::npos))
        throw OverrideError(
            option,
            fmt::format("found {}; the file name of frames has one run of #, which their numbers "
                        "replace: frame.####.exr{}",
                        pattern, option == "output" ? "; .webp and .apng without # have all frames" : ""));
    const std::size_t width = (end == std::string::npos ? name.size() : end) - begin;
    const std::string numbered =
        name.substr(0, begin) + fmt::format("{:0{}}", frame, width) + name.substr(begin + width);
    return (path.parent_path() / numbered).string();
}

Sequence::Sequence(RenderRequest request, const SequenceOptions &options)
    : request_(std::move(request)), turntable_(options.turntable), hasMotion_(options.hasMotion),
      times_(timesOf(options, request_.isInClip)) {
    const Part part = request_.part.value_or(Part{});
    for (int frame = times_.firstFrame; frame <= times_.lastFrame; ++frame)
        if (static_cast<std::uint32_t>(frame - times_.firstFrame) % part.count == part.index - 1)
            frames_.push_back(frame);
    std::set<std::string> names;
    for (const int frame : frames_) {
        const RenderRequest ofFrame = requestOf(frame);
        std::vector<std::string> files = {ofFrame.report, ofFrame.checkpoint};
        if (!ofFrame.isInClip)
            files.push_back(ofFrame.output);
        if (!ofFrame.checkpoint.empty())
            files.insert(files.end(), {olderCheckpoint(ofFrame.checkpoint).string(),
                                       lockOfCheckpoint(ofFrame.checkpoint).string()});
        for (const std::string &name : files)
            if (!name.empty() && !names.insert(name).second)
                throw Error(
                    ErrorKind::Usage,
                    fmt::format("{} would be two files: those of frames need names of their own", name));
    }
}

RenderRequest Sequence::requestOf(int frame) const {
    RenderRequest request = request_;
    request.part.reset();
    request.frame = frame;
    request.hasMotion = hasMotion_;
    if (!request.isInClip)
        request.output = nameOfFrame(request.output, frame, "output");
    if (!request.report.empty())
        request.report = nameOfFrame(request.report, frame, "report");
    if (!request.checkpoint.empty())
        request.checkpoint = nameOfFrame(request.checkpoint, frame, "checkpoint");
    return request;
}

void Sequence::prepare(RenderSession &session) {
    RenderRequest request = request_;
    if (!turntable_) {
        request.scene.load.sequence = times_;
        const int beside = hasMotion_ ? 1 : 0;
        request.scene.load.sequence->firstFrame = std::max(times_.firstFrame - beside, 0);
        request.scene.load.sequence->lastFrame += beside;
    }
    session.prepare(request);
    PreparedScene &scene = session.scene();
    const Camera &camera = scene.loaded.scene.camera;
    if (turntable_) {
        const glm::dvec3 axis =
            request.scene.up.empty() ? scene.loaded.worldUp.value_or(camera.up) : camera.up;
        path_ = turntable(camera, pivotOf(camera, centreOf(scene.packed)), axis, *turntable_);
        return;
    }
    path_ = std::exchange(scene.loaded.cameraPath, {});
    movesByTime_ = scene.loaded.movesByTime;
    if (path_.empty() && !movesByTime_)
        throw OverrideError(
            "frames", fmt::format("nothing moves in {}; give its camera a path", scene.loaded.file.string()),
            Remedy::Turntable);
    if (!path_.empty())
        requireNoPlace(request.scene);
    // A field of view that the command line or the image's shape decides is that of all frames.
    if (request.scene.fovDegrees || scene.loaded.verticalFovDegrees)
        for (CameraPose &pose : path_)
            pose.horizontalFovDegrees = camera.horizontalFovDegrees;
    validateCameraPath(path_, camera, scene.loaded.file.string());
}

SceneOptions Sequence::optionsOf(int frame) const {
    SceneOptions options = request_.scene;
    options.load.timeSeconds = times_.timeOf(std::max(frame, 0)); // nothing moves before
    return options;
}

Camera Sequence::cameraOf(int frame, const Camera &camera) const {
    const int count = static_cast<int>(path_.size());
    const int index = turntable_ ? (frame + count) % count : std::clamp(frame, 0, count - 1);
    return posed(camera, path_[static_cast<std::size_t>(index)]);
}

const MotionFrame &Sequence::motionFrameOf(int frame) {
    const auto [entry, isNew] = loaded_.try_emplace(frame);
    if (isNew) {
        PreparedScene scene = prepareScene(optionsOf(frame), Source::Dropped, nobody());
        entry->second = {framing_.value_or(scene.loaded.scene.camera),
                         std::make_shared<FrameSurfaces>(std::move(scene.packed))};
    }
    return entry->second;
}

NeighbourFrames Sequence::neighboursOf(int frame, const Camera &camera) {
    if (!movesByTime_)
        return {{cameraOf(frame - 1, camera)}, {cameraOf(frame + 1, camera)}};
    std::erase_if(loaded_, [frame](const auto &entry) { return entry.first != frame - 1; });
    return {motionFrameOf(frame - 1), motionFrameOf(frame + 1)};
}

void Sequence::moveTo(int frame, RenderSession &session) {
    if (hasMotion_)
        session.loadNeighbours = [this, frame, &session] {
            return neighboursOf(frame, session.scene().loaded.scene.camera);
        };
    if (movesByTime_) {
        session.replaceScene(optionsOf(frame));
        PreparedScene &scene = session.scene();
        if (scene.loaded.autoFramed) { // else the view would jump with what it frames
            if (!framing_)
                framing_ = scene.loaded.scene.camera;
            scene.loaded.scene.camera = *framing_;
            packCamera(scene.loaded.scene, scene.packed);
        }
        return;
    }
    PreparedScene &scene = session.scene();
    Camera &camera = scene.loaded.scene.camera;
    camera = cameraOf(frame, camera);
    packCamera(scene.loaded.scene, scene.packed);
}

} // namespace hyalite::core
