#include "host/import/gltf/cameras.h"

#include "host/import/gltf/animation.h"
#include "host/scene/framing.h"
#include "host/scene/limits.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <numbers>
#include <string_view>

namespace hyalite::core::gltf {
namespace {

/// A camera, or a pose of one, at the origin of its node, along -z.
template <class Aimed> void aim(const glm::dmat4x3 &toWorld, Aimed &aimed) {
    aimed.position = toWorld[3];
    aimed.direction = -glm::normalize(toWorld[2]);
    aimed.up = glm::normalize(toWorld[1]);
}

/// Nothing for a shape that no image has. `node` says it.
std::optional<double> aspectRatio(const Document &document, const JsonNode &node, double ratio) {
    if (ratio > 0.0 && std::isfinite(ratio))
        return ratio;
    document.losses().add("aspect ratio", [&] {
        return fmt::format("{}: {}: {} is passed over, as no image has that shape", document.fileName(),
                           node.path.to_string(), node.value->get<double>());
    });
    return std::nullopt;
}

PlacedCamera placed(const Document &document, const JsonNode &node, const glm::dmat4x3 &toWorld) {
    const JsonObject object(node);
    PlacedCamera result;
    Camera &camera = result.camera;
    aim(toWorld, camera);
    const std::string type = object.text("type");
    if (type == "perspective") {
        const JsonObject perspective(object.at("perspective"));
        result.verticalFovDegrees =
            glm::degrees(perspective.number("yfov", {0.0, std::numbers::pi, false, false}));
        camera.horizontalFovDegrees =
            horizontalFovDegrees(*result.verticalFovDegrees, camera.width, camera.height);
        if (const std::optional<JsonNode> ratio = perspective.find("aspectRatio"))
            result.aspectRatio = aspectRatio(document, *ratio, ratio->number(anyNumber));
    } else if (type == "orthographic") {
        const JsonObject orthographic(object.at("orthographic"));
        camera.kind = CameraKind::Orthographic;
        camera.viewWidth = 2.0 * orthographic.number("xmag", {0.0, 0.5 * limits::viewWidth.high, false});
        if (const std::optional<JsonNode> height = orthographic.find("ymag"))
            result.aspectRatio =
                aspectRatio(document, *height, 0.5 * camera.viewWidth / height->number(anyNumber));
    } else {
        object.at("type").refuse("\"perspective\" or \"orthographic\"");
    }
    return result;
}

/// Whether a user's word names the camera of a node.
bool isCalled(const std::string &choice, const Document &document, std::size_t camera,
              const JsonObject &node) {
    return choice == nameOf(JsonObject(document.at("cameras", camera))) || choice == nameOf(node) ||
           choice == fmt::format("{}", camera);
}

} // namespace

std::optional<PlacedCamera> readCamera(const Document &document, const std::vector<std::size_t> &nodes,
                                       const std::vector<glm::dmat4x3> &toWorld, const std::string &choice) {
    std::vector<std::string> names;
    for (const std::size_t index : nodes) {
        const JsonObject node(document.at("nodes", index));
        const std::optional<std::size_t> camera = document.reference(node, "camera", "cameras");
        const glm::dmat4x3 &map = toWorld[index];
        if (!camera || !(glm::length(map[2]) > 0.0 && glm::length(map[1]) > 0.0))
            continue;
        if (choice.empty() || isCalled(choice, document, *camera, node)) {
            PlacedCamera result = placed(document, document.at("cameras", *camera), map);
            result.node = index;
            return result;
        }
        const std::string own = nameOf(JsonObject(document.at("cameras", *camera)));
        const std::string name = own.empty() ? nameOf(node) : own;
        names.push_back(name.empty() ? fmt::format("{}", *camera) : name);
    }
    if (choice.empty())
        return std::nullopt;
    const std::vector<std::string_view> views(names.begin(), names.end());
    throw Error(ErrorKind::Usage,
                fmt::format("{}: its scene has no camera \"{}\"; it has {}", document.fileName(), choice,
                            names.empty() ? "none" : quotedList(views)));
}

CameraPath readCameraPath(Buffers &buffers, const NodeTree &tree, const std::vector<Pose> &rest,
                          const PlacedCamera &camera, const SequenceTimes &sequence) {
    const Document &document = buffers.document();
    CameraPath path(static_cast<std::size_t>(sequence.firstFrame), poseOf(camera.camera));
    for (int frame = sequence.firstFrame; frame <= sequence.lastFrame; ++frame) {
        std::vector<Pose> poses = rest;
        animate(buffers, sequence.timeOf(frame), poses);
        const glm::dmat4x3 map = tree.toWorld(poses)[camera.node];
        if (!(glm::length(map[2]) > 0.0 && glm::length(map[1]) > 0.0))
            document.at("nodes", camera.node).fail(fmt::format("the camera is flattened in frame {}", frame));
        CameraPose pose = poseOf(camera.camera);
        aim(map, pose);
        path.push_back(pose);
    }
    return path;
}

} // namespace hyalite::core::gltf
