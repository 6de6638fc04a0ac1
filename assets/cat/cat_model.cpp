#include "assets/cat/cat_model.h"

#include "assets/cat/cat_head.h"
#include "assets/cat/cat_legs.h"
#include "assets/cat/polygonise.h"
#include "assets/cat/tube.h"

namespace hyalite::cat {
namespace {

void addTrunk(Field &field) {
    // Rump, loins, the tuck of the belly, the deep chest. Narrower than high.
    Part trunk;
    TubeShape shape;
    shape.stretch = {1.0, 1.0, 0.76};
    shape.blend = 2.0;
    addTube(trunk,
            {{{-17.4, 24.2, 0.0}, 3.9},
             {{-12.8, 24.9, 0.0}, 4.5},
             {{-6.5, 24.7, 0.0}, 4.6},
             {{-0.5, 23.5, 0.0}, 5.2},
             {{5.0, 22.5, 0.0}, 5.8},
             {{10.0, 22.5, 0.0}, 5.7},
             {{13.6, 23.7, 0.0}, 4.6}},
            shape);
    field.add(trunk);

    Part neck;
    neck.outerBlend = 3.0;
    shape.stretch = {1.0, 1.0, 0.82};
    addTube(neck,
            {{{11.8, 24.0, 0.0}, 4.6},
             {{16.2, 25.9, 0.0}, 3.6},
             {{19.8, 28.5, 0.1}, 2.85},
             {{23.4, 30.8, 0.3}, 2.5}},
            shape);
    field.add(neck);
}

void addTail(Field &field) {
    Part tail;
    tail.outerBlend = 2.2;
    TubeShape shape;
    shape.blend = 0.4;
    addTube(tail,
            {{{-17.0, 25.8, 0.0}, 2.1},
             {{-20.8, 26.2, 0.0}, 1.55},
             {{-24.8, 27.4, 0.2}, 1.3},
             {{-28.2, 30.6, 0.6}, 1.18},
             {{-29.9, 35.2, 1.0}, 1.1},
             {{-31.0, 39.8, 1.0}, 1.0},
             {{-33.2, 43.2, 0.5}, 0.9},
             {{-35.2, 44.3, 0.2}, 0.78}},
            shape);
    field.add(tail);
}

// Looking ahead and to the right, the crown leaning to the right, so that both ears show from that side.
Frame headFrame() {
    Frame head;
    head.origin = {25.2, 31.9, 0.7};
    head.axisX = normalize({1.0, -0.1, 0.54});
    head.axisZ = normalize(cross(head.axisX, Vec3{0.0, 1.0, 0.1}));
    head.axisY = cross(head.axisZ, head.axisX);
    return head;
}

} // namespace

Field makeCatField() {
    Field field;
    addTrunk(field);
    addTail(field);
    addHead(field, headFrame());
    addLegs(field);
    return field;
}

Box catBounds() { return {{-40.0, -2.0, -10.0}, {36.0, 50.0, 12.0}}; }

Mesh makeCat(std::size_t minimumTriangleCount) {
    return polygonise(makeCatField(), catBounds(), minimumTriangleCount);
}

std::string formatCat(const Mesh &mesh) {
    return formatObj(mesh, "A walking cat, made by Hyalite's make_cat with " +
                               std::to_string(mesh.triangles.size()) + " triangles");
}

} // namespace hyalite::cat
