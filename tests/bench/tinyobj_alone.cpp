#include "tests/bench/tinyobj_alone.h"

#include "host/base/error.h"

// The library itself has tinyobjloader in double, under the same names.
#define tinyobj tinyobj_alone
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

namespace hyalite::core::bench {

std::size_t countTrianglesByTinyObj(const std::filesystem::path &file) {
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warnings;
    std::string errors;
    if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warnings, &errors, file.c_str()))
        throw Error(ErrorKind::BadInput, "tinyobjloader: " + errors);
    std::size_t count = 0;
    for (const tinyobj::shape_t &shape : shapes)
        count += shape.mesh.num_face_vertices.size();
    return count;
}

} // namespace hyalite::core::bench
