// Primary rays. Twin: shaders/camera/camera.glsl.
#pragma once

#include "host/packing/packed_scene.h"
#include "host/reference/functions.h"
#include "host/reference/random.h"

namespace hyalite::reference {

/// Where `offset` from the top left of `pixel` lies, in pixels from the middle of the image, y up.
template <class Real>
[[nodiscard]] Vec2<Real> fromMiddle(const layout::FrameRecord &frame, const glm::uvec2 &pixel,
                                    const Vec2<Real> &offset) {
    return {static_cast<Real>(pixel.x) + offset.x - Real(0.5) * static_cast<Real>(frame.imageWidth),
            Real(0.5) * static_cast<Real>(frame.imageHeight) - (static_cast<Real>(pixel.y) + offset.y)};
}

template <class Real>
[[nodiscard]] Vec3<Real> onImagePlane(const layout::FrameRecord &frame, const Vec2<Real> &position,
                                      const Vec3<Real> &middle) {
    return Vec3<Real>(frame.pixelRight) * position.x + Vec3<Real>(frame.pixelUp) * position.y + middle;
}

/// The unit direction of the primary ray of a pinhole through `offset` in [0,1)^2 inside of `pixel`; see FrameRecord.
template <class Real>
[[nodiscard]] Vec3<Real> primaryDirection(const layout::FrameRecord &frame, const glm::uvec2 &pixel,
                                          const Vec2<Real> &offset) {
    return unitVector(onImagePlane(frame, fromMiddle(frame, pixel, offset), Vec3<Real>(frame.imagePlane)));
}

template <class Real> struct PrimaryRay {
    Vec3<Real> origin;
    Vec3<Real> direction; ///< unit length
};

/// Through a point of a thin lens, which `u` in [0,1)^2 draws, to what a pinhole would show at the focus distance: Cook,
/// Porter and Carpenter, "Distributed Ray Tracing", SIGGRAPH 1984.
template <class Real>
[[nodiscard]] PrimaryRay<Real> throughLens(const layout::FrameRecord &frame, const glm::uvec2 &pixel,
                                           const Vec2<Real> &offset, const Vec2<Real> &u) {
    const Vec3<Real> straight =
        onImagePlane(frame, fromMiddle(frame, pixel, offset), Vec3<Real>(frame.imagePlane));
    const Real radius = std::sqrt(u.x) * static_cast<Real>(frame.lensScale);
    const SineCosine<Real> angle = sineCosine(u.y);
    const Vec2<Real> onLens(radius * angle.cosine, radius * angle.sine);
    const Vec3<Real> aside = Vec3<Real>(frame.pixelRight) * onLens.x + Vec3<Real>(frame.pixelUp) * onLens.y;
    return {Vec3<Real>(frame.eye) + aside,
            unitVector(straight * static_cast<Real>(frame.focusDistance) - aside)};
}

/// Parallel to the view direction.
template <class Real>
[[nodiscard]] PrimaryRay<Real> alongView(const layout::FrameRecord &frame, const glm::uvec2 &pixel,
                                         const Vec2<Real> &offset) {
    return {onImagePlane(frame, fromMiddle(frame, pixel, offset), Vec3<Real>(frame.eye)),
            unitVector(Vec3<Real>(frame.imagePlane))};
}

/// By longitude and latitude: the image's middle is the view direction, its top row is up.
template <class Real>
[[nodiscard]] PrimaryRay<Real> allAround(const layout::FrameRecord &frame, const glm::uvec2 &pixel,
                                         const Vec2<Real> &offset) {
    const Real x = static_cast<Real>(pixel.x) + offset.x;
    const Real y = static_cast<Real>(pixel.y) + offset.y;
    const SineCosine<Real> longitude = sineCosine(x / static_cast<Real>(frame.imageWidth));
    const SineCosine<Real> latitude = sineCosine(Real(0.5) * (y / static_cast<Real>(frame.imageHeight)));
    const Real right = -longitude.sine * latitude.sine;
    const Real forward = -longitude.cosine * latitude.sine;
    return {Vec3<Real>(frame.eye),
            unitVector(Vec3<Real>(frame.pixelRight) * right + Vec3<Real>(frame.pixelUp) * latitude.cosine +
                       Vec3<Real>(frame.imagePlane) * forward)};
}

/// Where in a pixel the part `u` of its filter, in [0, 1), lies to the left or above. Ernst, Stamminger and Greiner,
/// "Filter Importance Sampling", 2006: samples that are as dense as the filter is high weigh alike, and each serves one
/// pixel only.
template <class Real> [[nodiscard]] Real filterQuantile(const PackedScene &scene, Real u) {
    const Real x = u * static_cast<Real>(layout::filterCellCount);
    const auto cell = static_cast<std::uint32_t>(x);
    const layout::TexelRecord &texel = scene.texels[scene.frame.filterTexels + cell];
    return static_cast<Real>(texel.value.x) +
           static_cast<Real>(texel.value.y) * (x - static_cast<Real>(cell));
}

inline constexpr std::uint32_t lensPair = 1024; // of random numbers: beyond those of paths

/// The primary ray of a sample. `shift` moves it by so many pixels, to learn how the picture changes around it.
template <class Real>
[[nodiscard]] PrimaryRay<Real> primaryRay(const PackedScene &scene, std::uint32_t samplerKind,
                                          const glm::uvec2 &pixel, std::uint32_t sampleIndex,
                                          const Vec2<Real> &shift = Vec2<Real>(Real(0))) {
    const layout::FrameRecord &frame = scene.frame;
    Vec2<Real> offset = samplePixel<Real>(samplerKind, pixel, sampleIndex, frame.seed);
    if (samplerKind == layout::samplerFiltered)
        offset = {filterQuantile(scene, offset.x), filterQuantile(scene, offset.y)};
    offset += shift;
    switch (scene.camera) {
    case layout::cameraLens:
        return throughLens(frame, pixel, offset,
                           unitReals<Real>(sampleBits(pairKeys(pixel, frame.seed, lensPair), sampleIndex)));
    case layout::cameraOrthographic:
        return alongView(frame, pixel, offset);
    case layout::cameraPanorama:
        return allAround(frame, pixel, offset);
    default:
        return {Vec3<Real>(frame.eye), primaryDirection(frame, pixel, offset)};
    }
}

} // namespace hyalite::reference
