#include "host/import/gltf/nodes.h"

#include "host/import/transform_json.h"
#include "host/scene/limits.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace hyalite::core::gltf {
namespace {

constexpr double maxRounding = 1e-3; ///< of numbers that should be 0, 1 or of length 1

/// Columns of four numbers; the last row is 0, 0, 0, 1.
glm::dmat4x3 readMatrix(const JsonNode &node) {
    const std::vector<double> numbers = numbersOf(node, 16, limits::coordinate);
    const auto isNear = [&](std::size_t i, double wanted) {
        return std::abs(numbers[i] - wanted) <= maxRounding;
    };
    if (!isNear(3, 0.0) || !isNear(7, 0.0) || !isNear(11, 0.0) || !isNear(15, 1.0))
        node.refuse("a matrix whose last row, every fourth number, is 0, 0, 0, 1");
    glm::dmat4x3 matrix;
    for (glm::length_t column = 0; column < 4; ++column)
        for (glm::length_t row = 0; row < 3; ++row)
            matrix[column][row] = numbers[static_cast<std::size_t>(4 * column + row)];
    return matrix;
}

Trs readTrs(const Document &document, const JsonObject &object) {
    Trs trs;
    trs.translation = object.vector("translation", limits::coordinate, trs.translation);
    trs.scale = object.vector("scale", limits::coordinate, trs.scale);
    if (const std::optional<JsonNode> rotation = object.find("rotation"))
        trs.rotation = readQuaternion(document, *rotation);
    return trs;
}

Pose readPose(const Document &document, const JsonObject &object) {
    Pose pose;
    if (const std::optional<JsonNode> matrix = object.find("matrix")) {
        for (const std::string_view key : {"translation", "rotation", "scale"})
            if (const std::optional<JsonNode> other = object.find(key))
                other->fail("found beside \"matrix\"; allowed: one of the two");
        pose.place = readMatrix(*matrix);
    } else {
        pose.place = readTrs(document, object);
    }
    if (const std::optional<JsonNode> weights = object.find("weights"))
        pose.weights = numbersOf(*weights, weights->value->size());
    return pose;
}

} // namespace

glm::dvec4 readQuaternion(const Document &document, const JsonNode &node) {
    const std::vector<double> q = numbersOf(node, 4);
    const glm::dvec4 quaternion(q[0], q[1], q[2], q[3]);
    const double length = glm::length(quaternion);
    if (!(length > 1e-3))
        node.refuse("a unit quaternion");
    if (std::ranges::any_of(q, [](double number) { return std::abs(number) > 1.0; }) ||
        std::abs(length - 1.0) > maxRounding)
        document.losses().add("rotation", [&] {
            return fmt::format("{}: {}: a rotation of length {} is normalised", document.fileName(),
                               node.path.to_string(), length);
        });
    return quaternion;
}

glm::dmat3 rotationOf(const glm::dvec4 &quaternion) {
    const glm::dvec4 q = glm::normalize(quaternion);
    const double x = q.x;
    const double y = q.y;
    const double z = q.z;
    const double w = q.w;
    return {1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w),       2.0 * (x * z - y * w),
            2.0 * (x * y - z * w),       1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w),
            2.0 * (x * z + y * w),       2.0 * (y * z - x * w),       1.0 - 2.0 * (x * x + y * y)};
}

glm::dmat4x3 Trs::toMatrix() const {
    const glm::dmat3 turned = rotationOf(rotation);
    return {turned[0] * scale.x, turned[1] * scale.y, turned[2] * scale.z, translation};
}

glm::dmat4x3 Pose::toParent() const {
    const auto *const trs = std::get_if<Trs>(&place);
    return trs != nullptr ? trs->toMatrix() : std::get<glm::dmat4x3>(place);
}

std::vector<Pose> readPoses(const Document &document) {
    const Elements nodes = elementsOf(document.top(), "nodes");
    std::vector<Pose> poses;
    poses.reserve(nodes.size());
    for (const JsonNode &node : nodes)
        poses.push_back(readPose(document, JsonObject(node)));
    return poses;
}

NodeTree::NodeTree(const Document &document) {
    const Elements nodes = elementsOf(document.top(), "nodes");
    firstChildren_.reserve(nodes.size() + 1);
    firstChildren_.push_back(0);
    parents_.resize(nodes.size(), noParent);
    for (std::size_t parent = 0; parent < nodes.size(); ++parent) {
        const JsonObject object(nodes[parent]);
        for (const JsonNode &node : elementsOf(object, "children")) {
            const std::size_t child = document.reference(node, "nodes");
            Index &known = parents_[child];
            if (known != noParent)
                object.at("children")
                    .fail(
                        fmt::format("node {} is a child of node {}, too; allowed: one parent", child, known));
            known = static_cast<Index>(parent);
            children_.push_back(static_cast<Index>(child));
        }
        firstChildren_.push_back(static_cast<Index>(children_.size()));
    }
    std::vector<Index> roots;
    for (std::size_t i = 0; i < parents_.size(); ++i)
        if (parents_[i] == noParent)
            roots.push_back(static_cast<Index>(i));
    all_ = descend(roots);
    if (all_.size() == nodes.size())
        return;
    std::vector<bool> isReached(nodes.size(), false); // a circle has no root
    for (const Index node : all_)
        isReached[node] = true;
    const auto lost = static_cast<std::size_t>(std::ranges::find(isReached, false) - isReached.begin());
    nodes[lost].fail("the node is its own ancestor, or below one that is");
}

std::vector<NodeTree::Index> NodeTree::descend(const std::vector<Index> &roots) const {
    std::vector<Index> order;
    std::vector<Index> waiting(roots.rbegin(), roots.rend());
    while (!waiting.empty()) {
        const Index node = waiting.back();
        waiting.pop_back();
        order.push_back(node);
        const std::span<const Index> children = childrenOf(node);
        waiting.insert(waiting.end(), children.rbegin(), children.rend());
    }
    return order;
}

std::vector<glm::dmat4x3> NodeTree::toWorld(const std::vector<Pose> &poses) const {
    std::vector<glm::dmat4x3> maps(poses.size());
    for (const Index node : all_) {
        const glm::dmat4x3 own = poses[node].toParent();
        const Index parent = parents_[node];
        maps[node] = parent == noParent ? own : composed(maps[parent], own);
    }
    return maps;
}

std::vector<bool> NodeTree::below(std::vector<bool> marked) const {
    for (const Index node : all_)
        if (parents_[node] != noParent && marked[parents_[node]])
            marked[node] = true;
    return marked;
}

std::optional<std::size_t> NodeTree::parentOf(std::size_t node) const {
    return parents_[node] == noParent ? std::nullopt : std::optional<std::size_t>(parents_[node]);
}

std::size_t NodeTree::depthOf(std::size_t node) const {
    std::size_t depth = 0;
    for (Index parent = parents_[node]; parent != noParent; parent = parents_[parent])
        ++depth;
    return depth;
}

std::optional<JsonObject> chosenScene(const Document &document, const std::string &choice) {
    const std::optional<std::size_t> ownChoice = document.reference(document.top(), "scene", "scenes");
    if (document.count("scenes") == 0 && choice.empty())
        return std::nullopt;
    const std::size_t scene =
        choice.empty() ? ownChoice.value_or(0) : chosenElement(document, "scenes", "scene", choice);
    return JsonObject(document.at("scenes", scene));
}

std::vector<std::size_t> NodeTree::nodesOfScene(const Document &document,
                                                const std::optional<JsonObject> &scene) const {
    if (!scene)
        return {all_.begin(), all_.end()};
    const JsonObject &object = *scene;
    std::vector<Index> roots;
    std::vector<bool> isTaken(parents_.size(), false);
    for (const JsonNode &node : elementsOf(object, "nodes")) {
        const std::size_t root = document.reference(node, "nodes");
        const bool hasParent = parents_[root] != noParent;
        if (hasParent || isTaken[root])
            object.at("nodes").fail(fmt::format("node {} is {}; allowed: nodes without parents, each once",
                                                root, hasParent ? "a child of another" : "named twice"));
        isTaken[root] = true;
        roots.push_back(static_cast<Index>(root));
    }
    const std::vector<Index> nodes = descend(roots);
    return {nodes.begin(), nodes.end()};
}

std::size_t chosenElement(const Document &document, std::string_view array, std::string_view what,
                          const std::string &choice) {
    const std::size_t count = document.count(array);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; ++i) {
        names.push_back(nameOf(JsonObject(document.at(array, i))));
        if (names.back() == choice)
            return i;
    }
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(choice.data(), choice.data() + choice.size(), index);
    if (error == std::errc() && end == choice.data() + choice.size() && index < count)
        return index;
    const std::vector<std::string_view> views(names.begin(), names.end());
    throw Error(ErrorKind::Usage,
                fmt::format("{}: it has no {} \"{}\"; it has {}{}", document.fileName(), what, choice,
                            count == 0 ? "none" : fmt::format("{}, by index from 0 or by name: ", count),
                            quotedList(views)));
}

} // namespace hyalite::core::gltf
