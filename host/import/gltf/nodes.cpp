#include "host/import/gltf/nodes.h"

#include "host/import/transform_json.h"
#include "host/scene/limits.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <charconv>

namespace hyalite::gltf {
namespace {

/// Columns of four numbers; the last row is 0, 0, 0, 1.
glm::dmat4x3 readMatrix(const JsonNode &node) {
    const std::vector<double> numbers = numbersOf(node, 16, limits::coordinate);
    if (numbers[3] != 0.0 || numbers[7] != 0.0 || numbers[11] != 0.0 || numbers[15] != 1.0)
        node.refuse("a matrix whose last row, every fourth number, is 0, 0, 0, 1");
    glm::dmat4x3 matrix;
    for (glm::length_t column = 0; column < 4; ++column)
        for (glm::length_t row = 0; row < 3; ++row)
            matrix[column][row] = numbers[static_cast<std::size_t>(4 * column + row)];
    return matrix;
}

Pose readPose(const JsonObject &object) {
    Pose pose;
    if (const std::optional<JsonNode> matrix = object.find("matrix")) {
        for (const std::string_view key : {"translation", "rotation", "scale"})
            if (const std::optional<JsonNode> other = object.find(key))
                other->fail("found beside \"matrix\"; allowed: one of the two");
        pose.matrix = readMatrix(*matrix);
    }
    pose.translation = object.vector("translation", limits::coordinate, pose.translation);
    pose.scale = object.vector("scale", limits::coordinate, pose.scale);
    if (const std::optional<JsonNode> rotation = object.find("rotation")) {
        const std::vector<double> q = numbersOf(*rotation, 4, {-1.0, 1.0});
        pose.rotation = {q[0], q[1], q[2], q[3]};
        if (!(glm::length(pose.rotation) > 1e-3))
            rotation->refuse("a unit quaternion");
    }
    if (const std::optional<JsonNode> weights = object.find("weights"))
        pose.weights = numbersOf(*weights, weights->value->size());
    return pose;
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

std::vector<std::size_t> readChildren(const Document &document, const JsonObject &object,
                                      std::string_view key) {
    std::vector<std::size_t> children;
    for (const JsonNode &child : elementsOf(object, key))
        children.push_back(document.reference(child, "nodes"));
    return children;
}

} // namespace

glm::dmat4x3 Pose::toParent() const {
    if (matrix)
        return *matrix;
    const glm::dmat3 turned = rotationOf(rotation);
    return {turned[0] * scale.x, turned[1] * scale.y, turned[2] * scale.z, translation};
}

std::vector<Pose> readPoses(const Document &document) {
    std::vector<Pose> poses;
    for (const JsonNode &node : elementsOf(document.top(), "nodes"))
        poses.push_back(readPose(JsonObject(node)));
    return poses;
}

NodeTree::NodeTree(const Document &document) {
    for (const JsonNode &node : elementsOf(document.top(), "nodes"))
        children_.push_back(readChildren(document, JsonObject(node), "children"));
    parents_.resize(children_.size());
    for (std::size_t parent = 0; parent < children_.size(); ++parent)
        for (std::size_t i = 0; i < children_[parent].size(); ++i) {
            std::optional<std::size_t> &known = parents_[children_[parent][i]];
            if (known)
                JsonNode(JsonObject(document.at("nodes", parent)).at("children"))
                    .fail(fmt::format("node {} is a child of node {}, too; allowed: one parent",
                                      children_[parent][i], *known));
            known = parent;
        }
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < parents_.size(); ++i)
        if (!parents_[i])
            roots.push_back(i);
    all_ = descend(roots);
    if (all_.size() == children_.size())
        return;
    std::vector<bool> isReached(children_.size(), false); // a circle has no root
    for (const std::size_t node : all_)
        isReached[node] = true;
    const auto lost = static_cast<std::size_t>(std::ranges::find(isReached, false) - isReached.begin());
    document.at("nodes", lost).fail("the node is its own ancestor, or below one that is");
}

std::vector<std::size_t> NodeTree::descend(const std::vector<std::size_t> &roots) const {
    std::vector<std::size_t> order;
    std::vector<std::size_t> waiting(roots.rbegin(), roots.rend());
    while (!waiting.empty()) {
        const std::size_t node = waiting.back();
        waiting.pop_back();
        order.push_back(node);
        waiting.insert(waiting.end(), children_[node].rbegin(), children_[node].rend());
    }
    return order;
}

std::vector<glm::dmat4x3> NodeTree::toWorld(const std::vector<Pose> &poses) const {
    std::vector<glm::dmat4x3> maps(poses.size());
    for (const std::size_t node : all_) {
        const glm::dmat4x3 own = poses[node].toParent();
        maps[node] = parents_[node] ? composed(maps[*parents_[node]], own) : own;
    }
    return maps;
}

std::vector<std::size_t> NodeTree::nodesOfScene(const Document &document, const std::string &choice) const {
    const std::optional<std::size_t> ownChoice = document.reference(document.top(), "scene", "scenes");
    if (document.count("scenes") == 0 && choice.empty())
        return all_;
    const std::size_t scene =
        choice.empty() ? ownChoice.value_or(0) : chosenElement(document, "scenes", "scene", choice);
    const JsonObject object(document.at("scenes", scene));
    const std::vector<std::size_t> roots = readChildren(document, object, "nodes");
    std::vector<bool> isTaken(children_.size(), false);
    for (const std::size_t root : roots) {
        if (parents_[root] || isTaken[root])
            object.at("nodes").fail(fmt::format("node {} is {}; allowed: nodes without parents, each once",
                                                root, parents_[root] ? "a child of another" : "named twice"));
        isTaken[root] = true;
    }
    return descend(roots);
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

} // namespace hyalite::gltf
