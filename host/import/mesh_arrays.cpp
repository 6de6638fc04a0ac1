#include "host/import/mesh_arrays.h"

#include "host/base/error.h"
#include "host/import/mesh_builder.h"
#include "host/import/transform_json.h"
#include "host/scene/instances.h"
#include "host/scene/limits.h"
#include "host/scene/origin.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace hyalite::core {

namespace {

void requireVolume(const std::string &name, std::size_t index, const glm::dmat4x3 &place) {
    for (glm::length_t column = 0; column < 4; ++column)
        for (glm::length_t row = 0; row < 3; ++row)
            if (!limits::coordinate.contains(place[column][row]))
                failAtPlace(name, PlaceUnit::Row, index,
                            fmt::format("found {} in the instance's matrix; allowed: numbers {}",
                                        place[column][row], limits::coordinate.text()));
    if (determinant(toPlacement(place)) == 0.0)
        failAtPlace(name, PlaceUnit::Row, index,
                    "the instance makes everything flat; allowed: a matrix with a volume");
}

} // namespace

MeshFile readMeshArrays(const std::string &name, const MeshArrays &arrays, const MeshTransform &transform) {
    constexpr std::size_t maxCount = std::numeric_limits<std::int32_t>::max();
    if (arrays.positions.size() > maxCount)
        throw Error(ErrorKind::LimitExceeded, fmt::format("{}: found {} vertices; allowed: at most {}", name,
                                                          arrays.positions.size(), maxCount));
    for (std::size_t i = 0; i < arrays.places.size(); ++i)
        requireVolume(name, i, arrays.places[i]);
    const std::size_t faceCount = arrays.corners.size() / arrays.cornersPerFace;
    MeshFile file = meshFileOf(readNear([&](const glm::dvec3 &origin) {
        MeshBuilder builder(name, transform, origin, PlaceUnit::Row);
        builder.reserve(arrays.positions.size(), faceCount * (arrays.cornersPerFace - 2));
        for (std::size_t i = 0; i < arrays.positions.size(); ++i) {
            builder.addPosition(arrays.positions[i], i);
            if (!arrays.colours.empty())
                builder.setColour(arrays.colours[i]);
        }
        for (const glm::dvec3 &normal : arrays.normals)
            builder.addNormal(normal);
        for (const glm::dvec2 &uv : arrays.uvs)
            builder.addUv(uv);
        std::vector<FaceCorner> face(arrays.cornersPerFace);
        for (std::size_t i = 0; i < faceCount; ++i) {
            for (std::size_t corner = 0; corner < face.size(); ++corner) {
                const std::uint32_t index = arrays.corners[i * face.size() + corner];
                if (index >= arrays.positions.size())
                    failAtPlace(name, PlaceUnit::Row, i,
                                fmt::format("found the vertex {}; allowed: from 0 to {}", index,
                                            static_cast<std::int64_t>(arrays.positions.size()) - 1));
                const auto fromOne = static_cast<std::int32_t>(index + 1);
                face[corner] = {fromOne, arrays.normals.empty() ? 0 : fromOne,
                                arrays.uvs.empty() ? 0 : fromOne};
            }
            builder.addFace(face, i);
        }
        return builder.finish();
    }));
    file.meshes.front().places = arrays.places;
    return file;
}

} // namespace hyalite::core
