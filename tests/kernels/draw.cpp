#include "tests/kernels/draw.h"

#include "host/reference/scene_view.h"

#include <cmath>

namespace hyalite::core::testing {

std::uint32_t Draw::word() {
    const std::uint32_t bits = next();
    switch (index(8)) {
    case 0:
        return 1u << (bits % 32);
    case 1:
        return ~(1u << (bits % 32));
    case 2:
        return bits % 1024;
    default:
        return bits;
    }
}

float Draw::coordinate() {
    const float sign = chance(2) ? -1.0f : 1.0f;
    switch (index(16)) {
    case 0:
        return sign * 0.0f;
    case 1:
        return sign * static_cast<float>(index(10));
    case 2:
        return sign * std::ldexp(1.0f, static_cast<int>(index(41)) - 20);
    case 3:
    case 4:
        return sign * std::ldexp(1.0f + unit(), static_cast<int>(index(41)) - 20);
    default:
        return sign * 10.0f * unit();
    }
}

glm::vec3 Draw::point() {
    const float x = coordinate();
    const float y = coordinate();
    return {x, y, coordinate()};
}

glm::vec3 Draw::direction() {
    glm::vec3 v;
    for (int axis = 0; axis < 3; ++axis)
        v[axis] = 2.0f * unit() - 1.0f;
    for (int axis = 0; axis < 3; ++axis)
        if (chance(6))
            v[axis] = chance(2) ? -0.0f : 0.0f;
    if (v == glm::vec3(0.0f))
        v[static_cast<int>(index(3))] = chance(2) ? -1.0f : 1.0f;
    return reference::unitVector(v);
}

glm::vec3 Draw::towards(const glm::vec3 &origin, const glm::vec3 &target) {
    const glm::vec3 v = target - origin;
    return v == glm::vec3(0.0f) ? direction() : reference::unitVector(v);
}

} // namespace hyalite::core::testing
