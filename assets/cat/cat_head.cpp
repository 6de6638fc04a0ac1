#include "assets/cat/cat_head.h"

namespace hyalite::cat {
namespace {

// Lengths in this file are for a skull of radius 3.8 or so; the head is this much larger.
constexpr double headSize = 1.08;

Primitive capsule(const Frame &head, const Vec3 &a, double radiusA, const Vec3 &b, double radiusB) {
    return Primitive::taperedCapsule({head.point(a * headSize), radiusA * headSize},
                                     {head.point(b * headSize), radiusB * headSize});
}

Primitive ellipsoid(const Frame &head, const Vec3 &centre, const Vec3 &radii) {
    const Ball ball{head.point(centre * headSize), headSize};
    return Primitive::taperedCapsule(ball, ball, radii, head);
}

void addSkull(Field &field, const Frame &head) {
    Part skull;
    skull.innerBlend = 1.6;
    skull.primitives.push_back(ellipsoid(head, {-0.5, 0.4, 0.0}, {3.8, 3.2, 3.35}));
    for (const double side : {1.0, -1.0})
        skull.primitives.push_back(ellipsoid(head, {0.7, -1.0, 1.75 * side}, {1.9, 1.7, 1.6}));
    // The bridge of the nose.
    skull.primitives.push_back(capsule(head, {0.9, 1.0, 0.0}, 1.7, {3.9, -0.55, 0.0}, 0.72));
    // Brows.
    for (const double side : {1.0, -1.0})
        skull.primitives.push_back(ellipsoid(head, {1.7, 1.25, 1.25 * side}, {1.2, 0.9, 1.0}));
    skull.combine = Combine::unite;
    skull.outerBlend = 1.5;
    field.add(skull);
}

void addEyes(Field &field, const Frame &head) {
    Part sockets;
    sockets.combine = Combine::subtract;
    sockets.outerBlend = 1.1;
    Part eyes;
    eyes.combine = Combine::unite;
    eyes.outerBlend = 0.4;
    for (const double side : {1.0, -1.0}) {
        sockets.primitives.push_back(ellipsoid(head, {3.25, 0.55, 1.9 * side}, {0.85, 0.7, 0.9}));
        eyes.primitives.push_back(ellipsoid(head, {1.95, 0.45, 1.42 * side}, {0.95, 0.72, 0.95}));
    }
    field.add(sockets);
    field.add(eyes);
}

void addMuzzle(Field &field, const Frame &head) {
    Part muzzle;
    muzzle.innerBlend = 0.5;
    muzzle.combine = Combine::unite;
    muzzle.outerBlend = 0.9;
    for (const double side : {1.0, -1.0})
        muzzle.primitives.push_back(ellipsoid(head, {3.1, -1.35, 0.72 * side}, {1.3, 0.92, 1.0}));
    muzzle.primitives.push_back(capsule(head, {1.4, -1.9, 0.0}, 1.2, {3.1, -2.1, 0.0}, 0.78));
    field.add(muzzle);
    Part nose;
    nose.combine = Combine::unite;
    nose.outerBlend = 0.4;
    nose.primitives.push_back(ellipsoid(head, {4.25, -0.65, 0.0}, {0.5, 0.42, 0.62}));
    field.add(nose);
}

void addEar(Field &field, const Frame &head, double side) {
    // The ear's own frame: up along the ear, x out of its opening (forwards and outwards).
    Frame ear;
    const Vec3 up = normalize({-0.12, 1.0, 0.32 * side});
    const Vec3 roughFacing{0.7, 0.0, 0.62 * side};
    const Vec3 facing = normalize(roughFacing - up * dot(roughFacing, up));
    ear.origin = head.point(Vec3{-0.9, 2.0, 2.05 * side} * headSize);
    ear.axisX = head.direction(facing);
    ear.axisY = head.direction(up);
    ear.axisZ = head.direction(cross(facing, up));
    const auto cone = [&ear](const Vec3 &base, double baseRadius, const Vec3 &tip, double tipRadius,
                             double thickness) {
        return Primitive::taperedCapsule({ear.point(base * headSize), baseRadius * headSize},
                                         {ear.point(tip * headSize), tipRadius * headSize},
                                         {thickness, 1.0, 1.0}, ear);
    };
    Part shell;
    shell.combine = Combine::unite;
    shell.outerBlend = 1.2;
    shell.primitives.push_back(cone({0.0, 0.3, 0.0}, 2.4, {-0.1, 4.7, 0.0}, 0.42, 0.62));
    field.add(shell);
    Part hollow;
    hollow.combine = Combine::subtract;
    hollow.outerBlend = 0.6;
    hollow.primitives.push_back(cone({1.4, 1.0, 0.0}, 1.5, {0.62, 3.9, 0.0}, 0.22, 0.75));
    field.add(hollow);
}

} // namespace

void addHead(Field &field, const Frame &head) {
    addSkull(field, head);
    addMuzzle(field, head);
    addEyes(field, head);
    for (const double side : {1.0, -1.0})
        addEar(field, head, side);
}

} // namespace hyalite::cat
