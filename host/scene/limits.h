// Ranges and counts of scene files and command-line options. Those of settings are in settings_table.h.
#pragma once

#include "host/base/interval.h"
#include "shaders/layout/layout.h"

#include <cstddef>

namespace hyalite::core::limits {

inline constexpr Interval coordinate{-1e15, 1e15};
inline constexpr Interval directionLength{1e-100, 1e16}; ///< its square neither underflows nor overflows
inline constexpr double minSineToUp = 1e-6;              ///< of the angle from the view direction to up
inline constexpr Interval horizontalFovDegrees{0.0, 180.0, false, false};
inline constexpr Interval aperture{0.0, 1e15};
inline constexpr Interval focusDistance{0.0, 1e15, false};
inline constexpr Interval viewWidth{0.0, 1e15, false};
inline constexpr Interval imageSize{1, 32768}; ///< pixels, width and height alike
inline constexpr Interval frame{0, 99999};     ///< of a sequence
inline constexpr Interval framesPerSecond{1e-3, 1000.0};
inline constexpr std::size_t cameraKeyCount = 10000;

inline constexpr Interval spotAngle{0.0, 180.0, false};
inline constexpr Interval environmentScale{0.0, 1e15};
inline constexpr Interval power{0.0, 1e30};    ///< per channel
inline constexpr Interval radiance{0.0, 1e30}; ///< of the background and of surfaces, per channel
inline constexpr Interval fraction{0.0, 1.0};  ///< albedo, tint, light through glass
inline constexpr Interval refractiveIndex{1.0, 10.0};
inline constexpr Interval dispersion{0.0, 20.0};     ///< 20 / Abbe number: the index stays above 1
inline constexpr Interval conductorIndex{0.0, 20.0}; ///< real and imaginary part, per channel
inline constexpr Interval absorption{0.0, 1e30};     ///< per unit of length and channel
inline constexpr Interval priority{-1000, 1000};
inline constexpr double meshExtent = 1e-15; ///< of all meshes together, at least: squares of less underflow
inline constexpr Interval radius{0.0, 1e15, false};
inline constexpr Interval texturePlacement{-1e6, 1e6}; ///< scale and offset of textures
inline constexpr Interval normalStrength{0.0, 100.0};
inline constexpr Interval alphaCutoff{0.0, 1e30};
inline constexpr Interval radians{-1e6, 1e6};
inline constexpr Interval filmThickness{0.0, 1e5}; ///< nanometres: of far less, no wave is told from another

inline constexpr Interval meshScale{-1e15, 1e15}; ///< and not 0
inline constexpr Interval segments{3, 4096};      ///< of disks and cylinders
inline constexpr Interval rotateDegrees{-3600.0, 3600.0};
inline constexpr double normalLengthTolerance = 1e-3; ///< of a mesh normal's length around 1
inline constexpr Interval framedExtent{1e-12, 1e12};  ///< box diagonal of a mesh that can be framed

inline constexpr Interval timeSeconds{0.0, 1e9};

inline constexpr Interval threadCount{1, 1024};
inline constexpr Interval viewCount{1, 64};      ///< around a scene
inline constexpr Interval partCount{1, 65536};   ///< of a picture
inline constexpr Interval inspectedRays{1, 1e6}; ///< each is tested against all triangles

inline constexpr Interval profileAngle{0.0, 180.0};    ///< gamma, in degrees
inline constexpr std::size_t profileAngleCount = 8192; ///< in a file, of gamma and of C
inline constexpr std::size_t profileValueCount = std::size_t{1}
                                                 << 22; ///< of all profiles: 64 MiB on the device
inline constexpr Interval candela{0.0, 1e30};

inline constexpr std::size_t lightCount = std::size_t{1} << 27;
inline constexpr std::size_t lightGroupCount = layout::maxLightGroups;
inline constexpr std::size_t mediumCount = layout::maxMedia; ///< dielectrics, for the path integrator
inline constexpr std::size_t environmentTexelCount = std::size_t{1} << 27; ///< pixels: 2 GiB on the device
inline constexpr std::size_t textureBytes = std::size_t{1} << 30; ///< of all textures together, on the device
inline constexpr std::size_t materialCount = 65536;
inline constexpr std::size_t meshCount = std::size_t{1} << 20;             ///< and as many shapes
inline constexpr std::size_t triangleCount = (std::size_t{1} << 30) - 128; ///< of all meshes together
inline constexpr std::size_t sphereCount = triangleCount;
inline constexpr std::size_t treeCount = triangleCount; ///< spheres and triangles together
inline constexpr std::size_t instanceCount = (std::size_t{1} << 30) - 128;
/// Spheres, and triangles of meshes and instances, all together: each has an id.
inline constexpr std::size_t primitiveCount = layout::noPrimitive - layout::minFirstTriangleId;

} // namespace hyalite::core::limits
