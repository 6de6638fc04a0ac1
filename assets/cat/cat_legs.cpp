#include "assets/cat/cat_legs.h"

#include "assets/cat/cat_model.h"
#include "assets/cat/tube.h"

namespace hyalite::cat {
namespace {

void addPaw(Field &field, const Vec3 &ankle, double turn, double size) {
    // The paw points forwards and `turn` to the side; `ankle` is above its heel.
    Frame paw;
    paw.axisX = normalize({1.0, 0.0, turn});
    paw.axisZ = cross(paw.axisX, paw.axisY);
    paw.origin = {ankle.x, soleHeight, ankle.z};
    const auto capsule = [&paw, size](const Vec3 &a, double radiusA, const Vec3 &b, double radiusB) {
        return Primitive::taperedCapsule({paw.point(a * size), radiusA * size},
                                         {paw.point(b * size), radiusB * size});
    };
    Part pad;
    pad.outerBlend = 0.9;
    pad.innerBlend = 0.6;
    pad.primitives.push_back(capsule({0.0, 1.15, 0.0}, 1.25, {1.2, 0.95, 0.0}, 1.35));
    field.add(pad);
    Part toes;
    toes.outerBlend = 0.5;
    toes.innerBlend = 0.22;
    for (const double side : {1.0, -1.0}) {
        toes.primitives.push_back(capsule({0.9, 1.2, 0.45 * side}, 0.66, {2.55, 0.55, 0.55 * side}, 0.68));
        toes.primitives.push_back(capsule({0.6, 1.0, 1.0 * side}, 0.62, {1.85, 0.5, 1.45 * side}, 0.6));
    }
    field.add(toes);
}

// `foreleg` runs from the elbow to the ankle.
void addFrontLeg(Field &field, const std::vector<Ball> &foreleg, double side) {
    const Ball &elbow = foreleg.front();
    // The shoulder blade and the upper arm lie flat against the chest.
    Part shoulder;
    shoulder.outerBlend = 1.8;
    TubeShape flat;
    flat.stretch = {1.0, 1.0, 0.55};
    flat.blend = 1.4;
    addTube(
        shoulder,
        {{{9.4, 26.0, 2.2 * side}, 1.9}, {{12.6, 22.4, 3.3 * side}, 3.2}, {elbow.centre, elbow.radius + 0.4}},
        flat);
    field.add(shoulder);
    Part leg;
    leg.outerBlend = 1.6;
    addTube(leg, foreleg, {});
    field.add(leg);
    // The point of the elbow.
    Part point;
    point.outerBlend = 1.6;
    const Ball tip{elbow.centre + Vec3{-1.6, 0.3, 0.1 * side}, 0.9};
    point.primitives.push_back(Primitive::taperedCapsule(tip, tip));
    field.add(point);
}

// `thigh` runs from the hip to the knee, `shank` to the hock, `foot` from the hock to the ankle.
void addHindLeg(Field &field, const std::vector<Ball> &thigh, const std::vector<Ball> &shank,
                const std::vector<Ball> &foot) {
    Part haunch;
    haunch.outerBlend = 1.7;
    TubeShape flat;
    flat.stretch = {1.0, 1.0, 0.58};
    flat.blend = 1.6;
    addTube(haunch, thigh, flat);
    field.add(haunch);
    Part leg;
    leg.outerBlend = 1.8;
    TubeShape round;
    round.blend = 0.9;
    addTube(leg, shank, round);
    addTube(leg, foot, round);
    field.add(leg);
}

} // namespace

void addLegs(Field &field) {
    // A walk: the right legs are apart, the left legs meet under the belly.
    addFrontLeg(field,
                {{{11.2, 17.2, 3.9}, 2.2},
                 {{13.0, 13.0, 4.0}, 1.8},
                 {{15.2, 8.4, 3.9}, 1.22},
                 {{17.1, 4.8, 3.8}, 1.16},
                 {{17.7, 1.9, 3.8}, 1.05}},
                1.0);
    addPaw(field, {18.0, 0.0, 3.8}, 0.06, 0.95);
    addFrontLeg(field,
                {{{8.8, 16.8, -3.7}, 2.2},
                 {{7.8, 12.8, -3.6}, 1.8},
                 {{6.5, 8.4, -3.4}, 1.22},
                 {{5.1, 4.8, -3.3}, 1.16},
                 {{4.6, 1.9, -3.3}, 1.05}},
                -1.0);
    addPaw(field, {4.9, 0.0, -3.3}, -0.06, 0.95);

    addHindLeg(field, {{{-15.6, 23.2, 2.4}, 4.5}, {{-14.6, 19.6, 3.1}, 4.4}, {{-12.8, 15.8, 3.8}, 2.8}},
               {{{-13.0, 15.2, 3.9}, 2.4}, {{-17.0, 12.4, 3.9}, 1.8}, {{-21.6, 9.3, 3.8}, 1.0}},
               {{{-21.7, 9.2, 3.8}, 1.1}, {{-21.3, 5.6, 3.8}, 1.02}, {{-20.3, 2.0, 3.8}, 1.1}});
    addPaw(field, {-20.0, 0.0, 3.8}, 0.08, 0.95);
    addHindLeg(field, {{{-15.2, 23.2, -2.4}, 4.5}, {{-12.6, 19.6, -3.1}, 4.4}, {{-9.4, 15.8, -3.7}, 2.8}},
               {{{-9.4, 15.2, -3.8}, 2.4}, {{-11.2, 11.2, -3.8}, 1.7}, {{-14.0, 7.4, -3.6}, 1.0}},
               {{{-14.1, 7.3, -3.6}, 1.1}, {{-12.2, 4.4, -3.5}, 1.02}, {{-10.1, 1.9, -3.5}, 1.1}});
    addPaw(field, {-9.7, 0.0, -3.5}, -0.08, 0.95);

    Part ground;
    ground.combine = Combine::intersect;
    ground.outerBlend = 0.5;
    ground.primitives.push_back(Primitive::halfSpace({0.0, -1.0, 0.0}, -soleHeight));
    field.add(ground);
}

} // namespace hyalite::cat
