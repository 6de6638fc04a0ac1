// Conservative ray-box tests.
//
// A box is widened by a pad on each side, which covers all rounding in this test and in the triangle test. How wide
// must it be? Let u be the unit of rounding and M the largest coordinate distance from the ray's origin to any box
// ("reach"). The triangle test moves the image of a vertex by at most 7 u M: one rounding of each of two translations,
// three of the shear, and one of the sum, which is at most 2 M. The slab test moves a plane by at most 4 u M: a
// difference, the pad, the inverse, a product. Together 11 u M: a pad of 16 u M covers it with room to spare.
//
// The test is monotone to the bit: the interval of a box is never larger than that of a box around it, because each
// operation rounds monotonically. Triangle hits are confined to the interval of the triangle's own box (triangle.glsl),
// so no tree over the same triangles can lose or change a hit. Compare Ize, "Robust BVH Ray Traversal", JCGT 2(2),
// 2013, which widens the far distance only: enough for the slab test, not for the error of the triangle test.

const float boxPadScale = 16.0 / 16777216.0; // 16 units of rounding

struct BoxRay {
    vec3 origin;
    float pad;    // widens every box on every side
    vec3 inverse; // 1 / direction, bounded
};

// `lower` and `upper` bound all boxes to be tested.
BoxRay makeBoxRay(vec3 origin, vec3 direction, vec3 lower, vec3 upper) {
    vec3 toLower = abs(lower - origin);
    vec3 toUpper = abs(upper - origin);
    float reach = largestComponent(greater(toLower, toUpper));
    // The inverse of a component near 0 would be infinite and, on a face of the box, give NaN. The bound moves the ray
    // by less than the pad over any distance that occurs.
    vec3 bounded = mix(direction, mix(vec3(1e-18), vec3(-1e-18), lessThan(direction, vec3(0.0))),
                       lessThan(abs(direction), vec3(1e-18)));
    return BoxRay(origin, boxPadScale * reach, divide(1.0, bounded));
}

// The interval of distances, from x to y, in which the ray is inside the box, with x >= 0; x > y: a miss. The corners
// of the box are relative to the ray's origin.
vec2 relativeBoxInterval(BoxRay ray, vec3 lower, vec3 upper) {
    vec3 toLower = (lower - ray.pad) * ray.inverse;
    vec3 toUpper = (upper + ray.pad) * ray.inverse;
    float enter = greater(largestComponent(lesser(toLower, toUpper)), 0.0);
    float leave = smallestComponent(greater(toLower, toUpper));
    return vec2(enter, leave);
}

vec2 boxInterval(BoxRay ray, vec3 lower, vec3 upper) {
    return relativeBoxInterval(ray, lower - ray.origin, upper - ray.origin);
}

// How far the boxes of ray queries reach beyond those of primitives, on every side, for tests by the device. It is twice
// the pad, or more, of rays whose reach is at most 128 times the size of all boxes together, so that 16 u M remain for
// the device's own rounding. `lower` and `upper` bound all boxes.
float queryBoxPad(vec3 lower, vec3 upper) { return largestComponent(upper - lower) * (1.0 / 4096.0); }
