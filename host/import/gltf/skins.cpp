#include "host/import/gltf/skins.h"

#include "host/import/gltf/accessor.h"
#include "host/import/transform_json.h"

#include <fmt/format.h>

#include <optional>

namespace hyalite::core::gltf {
namespace {

glm::dmat4x3 matrixAt(const Accessor &matrices, std::size_t index) {
    glm::dmat4x3 matrix;
    for (glm::length_t column = 0; column < 4; ++column)
        for (glm::length_t row = 0; row < 3; ++row)
            matrix[column][row] =
                static_cast<double>(matrices.number(index, static_cast<std::size_t>(4 * column + row)));
    return matrix;
}

} // namespace

std::vector<glm::dmat4x3> jointMaps(Buffers &buffers, std::size_t skin,
                                    const std::vector<glm::dmat4x3> &toWorld) {
    const Document &document = buffers.document();
    const JsonObject object(document.at("skins", skin));
    const Elements joints = elementsOf(object, "joints");
    if (joints.empty())
        object.at("joints").refuse("an array of nodes, at least one");
    std::optional<Accessor> inverses;
    if (const auto index = document.reference(object, "inverseBindMatrices", "accessors")) {
        inverses.emplace(buffers, *index);
        inverses->requireType("MAT4");
        if (inverses->count() < joints.size())
            JsonObject(inverses->node())
                .at("count")
                .refuse(fmt::format("at least {}, one for each joint", joints.size()));
    }
    buffers.memoryBudget().take(joints.size() * sizeof(glm::dmat4x3), document.at("skins", skin));
    std::vector<glm::dmat4x3> maps;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const glm::dmat4x3 &joint = toWorld[document.reference(joints[i], "nodes")];
        maps.push_back(inverses ? composed(joint, matrixAt(*inverses, i)) : joint);
    }
    return maps;
}

} // namespace hyalite::core::gltf
