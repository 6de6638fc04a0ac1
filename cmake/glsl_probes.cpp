// From the leaf functions of the shaders to probes, one for each, on the device and in C++:
//
//   glsl_probes ROOT LAYOUT.h LEAVES.glsl OUT.glsl WORDS.h PROBES.h
//
// A probe reads the parameters of its leaf as words, field by field where they are structs, calls it, and writes the
// result and then the parameters that come out as words. tests/kernels/leaf_probes.comp has the words of the device,
// tests/kernels/words.h those of the host.
//
//   GLSL   void probe7() { vec3 p0 = takeVec3(); vec3 p1 = takeVec3(); give(dotProduct(p0, p1)); }
//   C++    void probe7(const SceneView<float> &, WordReader &in, Words &out) { ... out << dotProduct<float>(p0, p1); }
//
// WORDS.h has the structs as words. PROBES.h has the probes, a table of them, with the types and names of their
// parameters and what they read of the scene, and one of the fields of structs: inputs are drawn by these names
// (tests/kernels/leaf_inputs.cpp).
#include "cmake/leaf_declarations.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <exception>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

/// Text with numbers and names in the place of each %.
std::string filled(std::string_view pattern, const std::vector<std::string> &values) {
    std::string out;
    std::size_t at = 0;
    for (const char c : pattern)
        out += c == '%' ? values.at(at++) : std::string(1, c);
    return out;
}

/// The functions that divide or take roots, themselves or by those that they call: for them devices have two ways.
std::set<std::string> dividingFunctions(const LeafDeclarations &leaves) {
    std::set<std::string> dividing{"divide", "squareRoot"};
    for (const LeafDeclaration &one : leaves.all())
        if (one.kind == Declaration::Function &&
            std::ranges::any_of(one.body, [&](const Token &token) { return dividing.contains(token.text); }))
            dividing.insert(one.name);
    return dividing;
}

std::string takeOf(std::string type) {
    type[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(type[0])));
    return "take" + type;
}

std::string glslOf(const LeafDeclaration &record) {
    std::string takes;
    std::string gives;
    for (const Variable &field : fieldsOf(record)) {
        takes += filled(" r.% = %();", {field.name, takeOf(field.type)});
        gives += filled(" give(r.%);", {field.name});
    }
    return filled("% %() { % r;% return r; }\nvoid give(% r) {% }\n",
                  {record.name, takeOf(record.name), record.name, takes, record.name, gives});
}

std::string glslOf(const LeafDeclaration &function, const std::string &number) {
    std::string out = filled("void probe%() {", {number});
    std::string arguments;
    std::string results;
    int index = 0;
    for (const Variable &parameter : parametersOf(function)) {
        const std::string name = "p" + std::to_string(index++); // shadows no leaf
        out +=
            filled(parameter.isIn ? " % % = %();" : " % %;", {parameter.type, name, takeOf(parameter.type)});
        results += parameter.isOut ? filled(" give(%);", {name}) : "";
        arguments += (arguments.empty() ? "" : ", ") + name;
    }
    return out + filled(" % r = %(%); give(r);%", {function.type, function.name, arguments, results}) +
           " }\n";
}

class CppWriter {
  public:
    explicit CppWriter(const LeafDeclarations &leaves) : leaves_(leaves) {}

    [[nodiscard]] std::string recordText(const LeafDeclaration &record) const {
        std::string takes;
        std::string gives;
        for (const Variable &field : fieldsOf(record)) {
            takes += filled(" >> to.%", {field.name});
            gives += filled(" << from.%", {field.name});
        }
        const std::string type = typeText(record.name);
        return filled("inline WordReader &operator>>(WordReader &in, % &to) { return in%; }\n"
                      "inline Words &operator<<(Words &out, const % &from) { return out%; }\n",
                      {type, takes, type, gives});
    }

    [[nodiscard]] std::string functionText(const LeafDeclaration &function, const std::string &number) const {
        const bool usesScene = !function.sceneWords.empty();
        std::string out =
            filled("inline void probe%(const SceneView<float> &%, WordReader &%, Words &out) {",
                   {number, usesScene ? "scene" : "", parametersOf(function).empty() ? "" : "in"});
        std::string arguments = usesScene ? "scene" : "";
        std::string results;
        int index = 0;
        for (const Variable &parameter : parametersOf(function)) {
            const std::string name = "p" + std::to_string(index++);
            out += filled(" % %{};", {typeText(parameter.type), name});
            out += parameter.isIn ? filled(" in >> %;", {name}) : "";
            results += parameter.isOut ? " << " + name : "";
            arguments += (arguments.empty() ? "" : ", ") + name;
        }
        return out + filled(" const auto r = %%(%); out << r%; }\n",
                            {function.name, function.usesReal ? "<float>" : "", arguments, results});
    }

    [[nodiscard]] static std::string rowText(const LeafDeclaration &function, const std::string &number,
                                             bool divides) {
        std::string parameters;
        for (const Variable &parameter : parametersOf(function))
            parameters += parameter.isIn ? variableText(parameter) : "";
        std::string words;
        for (const std::string &word : function.sceneWords)
            words += filled(R"("%",)", {word});
        return filled(R"(    {"%", "%", {%}, {%}, %, probe%},)",
                      {function.file, function.name, parameters, words, divides ? "true" : "false", number}) +
               "\n";
    }

    [[nodiscard]] static std::string rowText(const LeafDeclaration &record) {
        std::string fields;
        for (const Variable &field : fieldsOf(record))
            fields += variableText(field);
        return filled(R"(    {"%", {%}},)", {record.name, fields}) + "\n";
    }

  private:
    [[nodiscard]] std::string typeText(const std::string &type) const {
        const LeafDeclaration *known = leaves_.find(type);
        return known != nullptr && known->usesReal ? type + "<float>"
               : type.starts_with("vec")           ? "glm::" + type
                                                   : type;
    }

    static std::string variableText(const Variable &variable) {
        return filled(R"({"%","%"},)", {variable.type, variable.name});
    }

    const LeafDeclarations &leaves_;
};

void write(const std::string &path, const std::string &text) {
    std::ofstream out(path);
    out << "// Made by cmake/glsl_probes.cpp from the leaf functions of shaders/.\n" << text;
    if (!out.flush())
        throw std::runtime_error(path + " cannot be written");
}

} // namespace

int main(int argumentCount, char **arguments) {
    if (argumentCount != 7) {
        std::fputs("glsl_probes ROOT LAYOUT.h LEAVES.glsl OUT.glsl WORDS.h PROBES.h\n", stderr);
        return 2;
    }
    try {
        const LeafDeclarations leaves(arguments[1], arguments[2], arguments[3]);
        const CppWriter cpp(leaves);
        const std::set<std::string> dividing = dividingFunctions(leaves);
        std::string glsl;
        std::string choices;
        std::string words;
        std::string functions;
        std::string probeRows;
        std::string structRows;
        int count = 0;
        for (const LeafDeclaration &one : leaves.all()) {
            if (one.kind == Declaration::Struct) {
                glsl += glslOf(one);
                words += cpp.recordText(one);
                structRows += CppWriter::rowText(one);
            } else if (one.kind == Declaration::Function) {
                const std::string number = std::to_string(count++);
                glsl += glslOf(one, number);
                choices += filled("    if (probedFunction == %u) probe%();\n", {number, number});
                functions += cpp.functionText(one, number);
                probeRows += CppWriter::rowText(one, number, dividing.contains(one.name));
            }
        }
        write(arguments[4], glsl + "void probeLeaf() {\n" + choices + "}\n");
        write(arguments[5], words);
        write(arguments[6], functions + "const std::vector<LeafStruct> structTable{\n" + structRows + "};\n" +
                                "const std::vector<LeafProbe> probeTable{\n" + probeRows + "};\n");
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
