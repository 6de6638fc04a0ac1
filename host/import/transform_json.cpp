#include "host/import/transform_json.h"

#include "host/scene/instances.h"
#include "host/scene/limits.h"

#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <string_view>

namespace hyalite::core {

namespace {

constexpr std::string_view allowedTransforms =
    "12 numbers (three rows of four), 16 numbers (four rows, the last one 0, 0, 0, 1), or a list of steps, "
    "each {\"scale\": ...}, {\"rotateDegrees\": ...}, {\"translate\": ...} or {\"matrix\": ...}";

glm::dmat4x3 mapOf(const glm::dmat3 &linear, const glm::dvec3 &offset) {
    return {linear[0], linear[1], linear[2], offset};
}

glm::dmat3 linearPartOf(const glm::dmat4x3 &map) { return {map[0], map[1], map[2]}; }

glm::dmat4x3 readMatrix(const JsonNode &node) {
    const std::size_t count = node.value->is_array() ? node.value->size() : 0;
    if (count != 12 && count != 16)
        node.refuse(allowedTransforms);
    std::array<double, 16> numbers{};
    for (std::size_t i = 0; i < count; ++i)
        numbers[i] = JsonNode{&(*node.value)[i], node.fileName, node.path / i}.number(limits::coordinate);
    if (count == 16 &&
        !(numbers[12] == 0.0 && numbers[13] == 0.0 && numbers[14] == 0.0 && numbers[15] == 1.0))
        node.refuse("a matrix whose last row is 0, 0, 0, 1: an affine map");
    glm::dmat4x3 map;
    for (glm::length_t row = 0; row < 3; ++row)
        for (glm::length_t column = 0; column < 4; ++column)
            map[column][row] = numbers[static_cast<std::size_t>(4 * row + column)];
    return map;
}

/// Right-handed, about x, then y, then z.
glm::dmat3 rotationOf(const glm::dvec3 &degrees) {
    const glm::dvec3 angle = glm::radians(degrees);
    const glm::dvec3 c = glm::cos(angle);
    const glm::dvec3 s = glm::sin(angle);
    const glm::dmat3 aboutX(1.0, 0.0, 0.0, 0.0, c.x, s.x, 0.0, -s.x, c.x);
    const glm::dmat3 aboutY(c.y, 0.0, -s.y, 0.0, 1.0, 0.0, s.y, 0.0, c.y);
    const glm::dmat3 aboutZ(c.z, s.z, 0.0, -s.z, c.z, 0.0, 0.0, 0.0, 1.0);
    return aboutZ * aboutY * aboutX;
}

glm::dmat3 scaleBy(const glm::dvec3 &factors) {
    return {factors.x, 0.0, 0.0, 0.0, factors.y, 0.0, 0.0, 0.0, factors.z};
}

glm::dmat4x3 readStep(const JsonNode &node) {
    static constexpr auto keys =
        std::to_array<std::string_view>({"scale", "rotateDegrees", "translate", "matrix"});
    if (!node.value->is_object() || node.value->size() != 1)
        node.refuse("an object with one key: \"scale\", \"rotateDegrees\", \"translate\" or \"matrix\"");
    const JsonObject object(node, keys);
    if (const auto factors = object.find("scale"))
        return mapOf(scaleBy(factors->value->is_number() ? glm::dvec3(factors->number(limits::meshScale))
                                                         : factors->vector(limits::meshScale)),
                     glm::dvec3(0.0));
    if (object.find("rotateDegrees"))
        return mapOf(rotationOf(object.vector("rotateDegrees", limits::rotateDegrees)), glm::dvec3(0.0));
    if (object.find("translate"))
        return mapOf(glm::dmat3(1.0), object.vector("translate", limits::coordinate));
    return readMatrix(object.at("matrix"));
}

glm::dmat4x3 readSteps(const JsonNode &node) {
    glm::dmat4x3 map = mapOf(glm::dmat3(1.0), glm::dvec3(0.0));
    for (std::size_t i = 0; i < node.value->size(); ++i)
        map = composed(readStep({&(*node.value)[i], node.fileName, node.path / i}), map);
    return map;
}

} // namespace

glm::dmat4x3 readTransform(const JsonNode &node) {
    if (!node.value->is_array())
        node.refuse(allowedTransforms);
    const bool isMatrix = !node.value->empty() && node.value->front().is_number();
    const glm::dmat4x3 map = isMatrix ? readMatrix(node) : readSteps(node);
    if (determinant(toPlacement(map)) == 0.0)
        node.fail("the transform makes everything flat; allowed: one with a volume");
    return map;
}

glm::dmat4x3 mapOf(const MeshTransform &transform) {
    return mapOf(rotationOf(transform.rotateDegrees) * scaleBy(glm::dvec3(transform.scale)),
                 transform.translate);
}

glm::dmat4x3 composed(const glm::dmat4x3 &outer, const glm::dmat4x3 &inner) {
    const glm::dmat3 linear = linearPartOf(outer);
    return mapOf(linear * linearPartOf(inner), linear * inner[3] + outer[3]);
}

Placement toPlacement(const glm::dmat4x3 &transform) {
    Placement placement;
    for (glm::length_t row = 0; row < 3; ++row)
        placement.rows[static_cast<std::size_t>(row)] =
            glm::vec3(transform[0][row], transform[1][row], transform[2][row]);
    placement.offset = glm::vec3(transform[3]);
    placement.offsetRest = transform[3] - glm::dvec3(placement.offset);
    return placement;
}

} // namespace hyalite::core
