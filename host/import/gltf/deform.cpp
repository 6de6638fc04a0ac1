#include "host/import/gltf/deform.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace hyalite::core::gltf {
namespace {

/// Adds the deltas of an attribute of a target.
template <class Value>
void addDeltas(const Attributes &target, std::string_view name, double weight, const Vertices &vertices,
               std::vector<Value> &values) {
    const auto deltas = target.find(name);
    if (deltas == target.end() || values.empty())
        return;
    deltas->second.requireType("VEC3");
    for (std::size_t i = 0; i < values.size(); ++i) {
        const glm::dvec3 delta = weight * glm::dvec3(deltas->second.vec3(vertices.sources[i]));
        for (glm::length_t axis = 0; axis < 3; ++axis)
            values[i][axis] = static_cast<float>(static_cast<double>(values[i][axis]) + delta[axis]);
    }
}

void morph(Buffers &buffers, const JsonObject &object, const std::vector<double> &weights,
           Primitive &primitive) {
    const Elements targets = elementsOf(object, "targets");
    const std::size_t vertexCount = primitive.attributes.begin()->second.count();
    for (std::size_t i = 0; i < std::min(weights.size(), targets.size()); ++i) {
        if (weights[i] == 0.0)
            continue;
        const Attributes target = readAttributes(buffers, targets[i]);
        for (const auto &[name, accessor] : target)
            accessor.requireCount(vertexCount);
        Vertices &vertices = primitive.vertices;
        addDeltas(target, "POSITION", weights[i], vertices, vertices.positions);
        addDeltas(target, "NORMAL", weights[i], vertices, vertices.normals);
        addDeltas(target, "TANGENT", weights[i], vertices, vertices.tangents);
    }
}

/// Joints and their weights of each vertex, in sets of four.
struct Influences {
    const Accessor *joints;
    const Accessor *weights;
};

std::vector<Influences> influencesOf(const Attributes &attributes) {
    std::vector<Influences> sets;
    for (std::size_t set = 0;; ++set) {
        const auto joints = attributes.find(fmt::format("JOINTS_{}", set));
        const auto weights = attributes.find(fmt::format("WEIGHTS_{}", set));
        if (joints == attributes.end() || weights == attributes.end())
            return sets;
        joints->second.requireType("VEC4");
        joints->second.requireUnsigned();
        weights->second.requireType("VEC4");
        sets.push_back({&joints->second, &weights->second});
    }
}

/// The mean of the joints' maps, weighted.
glm::dmat4x3 blended(const std::vector<Influences> &sets, const std::vector<glm::dmat4x3> &joints,
                     std::uint32_t vertex) {
    glm::dmat4x3 sum(0.0);
    double total = 0.0;
    for (const Influences &set : sets)
        for (std::size_t i = 0; i < 4; ++i) {
            const double weight = static_cast<double>(set.weights->number(vertex, i));
            if (weight == 0.0)
                continue; // whatever the joint
            const std::uint32_t joint = set.joints->whole(vertex, i);
            if (joint >= joints.size())
                set.joints->node().fail(
                    fmt::format("element {} names joint {}; allowed: less than {}, as the "
                                "skin has",
                                vertex, joint, joints.size()));
            sum += weight * joints[joint];
            total += weight;
        }
    return total > 0.0 ? sum * (1.0 / total) : joints[0];
}

void skin(const std::vector<glm::dmat4x3> &joints, const glm::dvec3 &origin, Primitive &primitive) {
    const std::vector<Influences> sets = influencesOf(primitive.attributes);
    Vertices &vertices = primitive.vertices;
    if (sets.empty()) {
        for (glm::vec3 &position : vertices.positions)
            position = glm::vec3(glm::dvec3(position) - origin);
        return;
    }
    for (std::size_t i = 0; i < vertices.positions.size(); ++i) {
        const glm::dmat4x3 map = blended(sets, joints, vertices.sources[i]);
        const glm::dmat3 linear(map[0], map[1], map[2]);
        vertices.positions[i] = glm::vec3(linear * glm::dvec3(vertices.positions[i]) + map[3]);
        const glm::dmat3 cofactors(glm::cross(map[1], map[2]), glm::cross(map[2], map[0]),
                                   glm::cross(map[0], map[1]));
        const double orientation = glm::dot(map[0], cofactors[0]) < 0.0 ? -1.0 : 1.0;
        if (!vertices.normals.empty())
            vertices.normals[i] = glm::vec3(orientation * (cofactors * glm::dvec3(vertices.normals[i])));
        if (!vertices.tangents.empty())
            vertices.tangents[i] =
                glm::vec4(glm::vec3(linear * glm::dvec3(vertices.tangents[i])), vertices.tangents[i].w);
    }
}

} // namespace

void deform(Buffers &buffers, const JsonNode &node, const Deformation &deformation, Primitive &primitive) {
    morph(buffers, JsonObject(node), deformation.weights, primitive);
    if (!deformation.joints.empty())
        skin(deformation.joints, deformation.origin, primitive);
}

} // namespace hyalite::core::gltf
