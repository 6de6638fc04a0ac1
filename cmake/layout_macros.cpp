// From the structs of shaders/layout/layout.h to macros that know their fields:
//
//   layout_macros LAYOUT.h OUT.h
//
//   FIELDS_X(G, record)            G(record.field) for each field of struct X, in order
//   LOAD_X(TEXELS, index)          the body of a GLSL function that returns record `index` of an image buffer of uvec4
//   STORE_X(TEXELS, index, record) writes one there
//   layoutStructCount              how many structs there are
//
// A texel is a row of 16 bytes: a vec3 and a scalar, or four scalars.
#include "cmake/glsl_reader.h"

#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

struct Field {
    std::string type;
    std::string name;
    std::size_t word; ///< of the record where it begins
};

std::size_t wordCount(std::string_view type) {
    if (type == "vec3")
        return 3;
    if (type == "float" || type == "uint")
        return 1;
    throw std::runtime_error("a field of type " + std::string(type) + ": use float, uint or vec3");
}

std::vector<Field> placedFieldsOf(const Declaration &record) {
    std::vector<Field> fields;
    std::size_t word = 0;
    for (const Variable &field : fieldsOf(record)) {
        const std::size_t count = wordCount(field.type);
        if (word % 4 + count > 4)
            throw std::runtime_error(record.name + "." + field.name + " crosses a row of 16 bytes");
        fields.push_back({field.type, field.name, word});
        word += count;
    }
    if (word % 4 != 0)
        throw std::runtime_error(record.name + " ends inside a row of 16 bytes");
    return fields;
}

/// GLSL for a field, from the rows that LOAD_X has read.
std::string loaded(const Field &field) {
    const std::string row = "row" + std::to_string(field.word / 4);
    const std::string words = row + "." + std::string("xyzw").substr(field.word % 4, wordCount(field.type));
    return field.type == "uint" ? words : "uintBitsToFloat(" + words + ")";
}

std::string macrosOf(const Declaration &record) {
    const std::vector<Field> fields = placedFieldsOf(record);
    const std::size_t rowCount = (fields.back().word + wordCount(fields.back().type)) / 4;
    const std::string first = "int(index) * " + std::to_string(rowCount);
    std::string visits;
    std::string loads;
    std::string members;
    std::string stores;
    for (const Field &field : fields) {
        visits += " G(r." + field.name + ")";
        const std::string row = std::to_string(field.word / 4);
        if (field.word % 4 == 0) {
            loads += " uvec4 row" + row + " = imageLoad(TEXELS, " + first + " + " + row + ");";
            stores += " imageStore(TEXELS, " + first + " + " + row + ", uvec4(";
        }
        members += (members.empty() ? "" : ", ") + loaded(field);
        const std::string value = "(record)." + field.name;
        stores += field.type == "uint" ? value : "floatBitsToUint(" + value + ")";
        stores += (field.word + wordCount(field.type)) % 4 == 0 ? "));" : ", ";
    }
    return "#define FIELDS_" + record.name + "(G, r)" + visits + "\n" + //
           "#define LOAD_" + record.name + "(TEXELS, index)" + loads + " return " + record.name + "(" +
           members + ");\n" + //
           "#define STORE_" + record.name + "(TEXELS, index, record)" + stores + "\n";
}

} // namespace

int main(int argumentCount, char **arguments) {
    if (argumentCount != 3) {
        std::fputs("layout_macros LAYOUT.h OUT.h\n", stderr);
        return 2;
    }
    const std::string layout = arguments[1];
    try {
        std::ofstream out(arguments[2]);
        out << "// Made by cmake/layout_macros.cpp from shaders/layout/layout.h.\n";
        std::size_t structCount = 0;
        for (const Declaration &one : declarationsOf(tokensOf(glslPartOf(readText(layout)))))
            if (one.kind == Declaration::Struct) {
                out << macrosOf(one);
                ++structCount;
            }
        out << "const uint layoutStructCount = " << structCount << "u;\n";
        if (!out.flush())
            throw std::runtime_error(std::string(arguments[2]) + " cannot be written");
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s: %s\n", layout.c_str(), error.what());
        return 1;
    }
    return 0;
}
