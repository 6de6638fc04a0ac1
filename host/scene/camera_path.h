// Camera paths: where a camera is in each frame of a sequence.
#pragma once

#include "host/scene/scene.h"

#include <glm/vec3.hpp>

#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

/// The part of a camera that moves; its projection and the size of the image stay.
struct CameraPose {
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0.0, 0.0, -1.0}; ///< with the length to the target, where there is one
    glm::dvec3 up{0.0, 1.0, 0.0};
    double horizontalFovDegrees = 60.0;
    double aperture = 0.0;
    double focusDistance = 10.0;
    double viewWidth = 10.0;
};

/// The poses of frames 0, 1, ...; after the last one the camera stands still. Empty: it never moves.
using CameraPath = std::vector<CameraPose>;

[[nodiscard]] CameraPose poseOf(const Camera &camera);
/// The camera in that pose.
[[nodiscard]] Camera posed(Camera camera, const CameraPose &pose);

struct CameraKey {
    int frame = 0; ///< from 0
    CameraPose pose;
};

enum class KeyInterpolation { Smooth, Linear };

/// The path through keys, whose frames increase; it stands still before the first one. Points of the path and what it
/// looks at (position + direction) are interpolated, and each other number by itself, between those of its keys.
/// Smooth: cubic Hermite splines whose slope at a key is that of the parabola through it and its neighbours (finite
/// differences for unequal intervals), at the ends that to the neighbour.
[[nodiscard]] CameraPath pathThrough(std::span<const CameraKey> keys, KeyInterpolation interpolation);

/// `frameCount` poses on a full circle around an axis through `pivot`, counter-clockwise seen from where the axis
/// points: frame 0 is the camera itself. The axis has any length but zero; it may be the camera's up vector, which then
/// stays.
[[nodiscard]] CameraPath turntable(const Camera &camera, const glm::dvec3 &pivot, const glm::dvec3 &axis,
                                   int frameCount);

/// The point of the view ray that is nearest to `centre`, or the centre if it lies behind the camera: what a turntable
/// turns around.
[[nodiscard]] glm::dvec3 pivotOf(const Camera &camera, const glm::dvec3 &centre);

} // namespace hyalite::core
