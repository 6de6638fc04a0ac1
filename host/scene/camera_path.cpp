#include "host/scene/camera_path.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace hyalite::core {

namespace {

/// The numbers of a pose that are interpolated.
using PoseNumbers = std::array<double, 13>;
constexpr std::size_t firstSize = 9; // angles and lengths, behind points and directions

PoseNumbers numbersOf(const CameraPose &pose) {
    const glm::dvec3 target = pose.position + pose.direction;
    return {pose.position.x,
            pose.position.y,
            pose.position.z,
            target.x,
            target.y,
            target.z,
            pose.up.x,
            pose.up.y,
            pose.up.z,
            pose.aperture,
            pose.horizontalFovDegrees,
            pose.focusDistance,
            pose.viewWidth};
}

CameraPose poseFrom(const PoseNumbers &numbers) {
    CameraPose pose;
    pose.position = {numbers[0], numbers[1], numbers[2]};
    pose.direction = glm::dvec3(numbers[3], numbers[4], numbers[5]) - pose.position;
    pose.up = {numbers[6], numbers[7], numbers[8]};
    pose.aperture = numbers[9];
    pose.horizontalFovDegrees = numbers[10];
    pose.focusDistance = numbers[11];
    pose.viewWidth = numbers[12];
    return pose;
}

class KeyCurve {
  public:
    KeyCurve(std::span<const CameraKey> keys, KeyInterpolation interpolation)
        : keys_(keys), interpolation_(interpolation) {
        for (const CameraKey &key : keys)
            values_.push_back(numbersOf(key.pose));
        for (std::size_t i = 0; i < keys.size(); ++i)
            slopes_.push_back(slopeAt(i));
    }

    /// The pose at `frame`, which is not before the first key and before the one after `i`.
    [[nodiscard]] CameraPose at(std::size_t i, int frame) const {
        if (frame == keys_[i].frame)
            return keys_[i].pose;
        const double length = keys_[i + 1].frame - keys_[i].frame;
        const double t = (frame - keys_[i].frame) / length;
        PoseNumbers numbers{};
        for (std::size_t n = 0; n < numbers.size(); ++n) {
            const double from = values_[i][n];
            const double to = values_[i + 1][n];
            numbers[n] = from + t * (to - from);
            if (interpolation_ == KeyInterpolation::Smooth) // the line, and what bends it towards the slopes
                numbers[n] += t * (1.0 - t) *
                              ((1.0 - t) * (length * slopes_[i][n] - (to - from)) -
                               t * (length * slopes_[i + 1][n] - (to - from)));
            if (n >= firstSize) // a spline may swing beyond its keys, where no camera is
                numbers[n] = std::clamp(numbers[n], std::min(from, to), std::max(from, to));
        }
        return poseFrom(numbers);
    }

  private:
    [[nodiscard]] double frameOf(std::size_t i) const { return keys_[i].frame; }

    [[nodiscard]] PoseNumbers slopeAt(std::size_t i) const {
        PoseNumbers slope{};
        if (keys_.size() == 1)
            return slope;
        const bool isEnd = i == 0 || i + 1 == keys_.size();
        const std::size_t before = i == 0 ? 0 : i - 1;
        const std::size_t after = isEnd ? before + 1 : i + 1;
        for (std::size_t n = 0; n < slope.size(); ++n) {
            if (isEnd) {
                slope[n] = (values_[after][n] - values_[before][n]) / (frameOf(after) - frameOf(before));
                continue;
            }
            const double left = frameOf(i) - frameOf(before);
            const double right = frameOf(after) - frameOf(i);
            slope[n] = ((values_[i][n] - values_[before][n]) / left * right +
                        (values_[after][n] - values_[i][n]) / right * left) /
                       (left + right);
        }
        return slope;
    }

    std::span<const CameraKey> keys_;
    KeyInterpolation interpolation_;
    std::vector<PoseNumbers> values_;
    std::vector<PoseNumbers> slopes_; ///< per frame
};

/// Rodrigues' formula. `axis` has unit length.
glm::dvec3 turned(const glm::dvec3 &v, const glm::dvec3 &axis, double radians) {
    const double cosine = std::cos(radians);
    return cosine * v + std::sin(radians) * glm::cross(axis, v) + (1.0 - cosine) * glm::dot(axis, v) * axis;
}

} // namespace

CameraPose poseOf(const Camera &camera) {
    return {camera.position, camera.direction,     camera.up,       camera.horizontalFovDegrees,
            camera.aperture, camera.focusDistance, camera.viewWidth};
}

Camera posed(Camera camera, const CameraPose &pose) {
    camera.position = pose.position;
    camera.direction = pose.direction;
    camera.up = pose.up;
    camera.horizontalFovDegrees = pose.horizontalFovDegrees;
    camera.aperture = pose.aperture;
    camera.focusDistance = pose.focusDistance;
    camera.viewWidth = pose.viewWidth;
    return camera;
}

CameraPath pathThrough(std::span<const CameraKey> keys, KeyInterpolation interpolation) {
    assert(!keys.empty() && keys.front().frame >= 0);
    const KeyCurve curve(keys, interpolation);
    CameraPath path;
    path.reserve(static_cast<std::size_t>(keys.back().frame) + 1);
    path.resize(static_cast<std::size_t>(keys.front().frame), keys.front().pose);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const int end = i + 1 < keys.size() ? keys[i + 1].frame : keys[i].frame + 1;
        for (int frame = keys[i].frame; frame < end; ++frame)
            path.push_back(curve.at(i, frame));
    }
    return path;
}

CameraPath turntable(const Camera &camera, const glm::dvec3 &pivot, const glm::dvec3 &axis, int frameCount) {
    const glm::dvec3 unitAxis = glm::normalize(axis);
    CameraPath path{poseOf(camera)};
    path.reserve(static_cast<std::size_t>(frameCount));
    for (int frame = 1; frame < frameCount; ++frame) {
        const double radians = 2.0 * std::numbers::pi * frame / frameCount;
        CameraPose pose = path.front();
        pose.position = pivot + turned(pose.position - pivot, unitAxis, radians);
        pose.direction = turned(pose.direction, unitAxis, radians);
        if (axis != pose.up)
            pose.up = turned(pose.up, unitAxis, radians);
        path.push_back(pose);
    }
    return path;
}

glm::dvec3 pivotOf(const Camera &camera, const glm::dvec3 &centre) {
    const glm::dvec3 direction = glm::normalize(camera.direction);
    const double distance = glm::dot(centre - camera.position, direction);
    return distance > 0.0 ? camera.position + distance * direction : centre;
}

} // namespace hyalite::core
