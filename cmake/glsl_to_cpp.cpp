// From the leaf functions of the shaders to C++, so that they are written once:
//
//   glsl_to_cpp ROOT LAYOUT.h LEAVES.glsl OUT.h
//
// LEAVES.glsl includes the leaf files, by paths below ROOT, and they may include others.
//
// GLSL and C++ differ in little that leaves use. Each struct and each function that has to do with floats becomes a
// template over `Real`, float or double; literals become `Real(0.5)`, so that no sum is taken in another precision.
// What a function reads of the scene (constants, frame, records) comes in a parameter `scene` of its own in C++, of the
// type SceneView<Real> (host/reference/scene_view.h), which has members of the same names.
//
//   GLSL   float pdfCosine(float cosine) { return cosine * inversePi; }
//   C++    template <class Real> inline Real pdfCosine(Real cosine) { return cosine * inversePi<Real>; }
//
// Leaves keep to this part of GLSL: functions, structs and constants at the top level, every function defined before it
// is used, no swizzles (vec2(v) takes the first two components), no arrays and no preprocessor.
#include "cmake/leaf_declarations.h"

#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

const std::map<std::string, std::string> types{
    {"float", "Real"}, {"vec2", "Vec2<Real>"}, {"vec3", "Vec3<Real>"}, {"vec4", "Vec4<Real>"}};

class Translator {
  public:
    explicit Translator(const LeafDeclarations &leaves) : leaves_(leaves) {}

    [[nodiscard]] std::string text() const {
        std::string out;
        for (const LeafDeclaration &one : leaves_.all())
            out += one.kind == Declaration::Struct     ? structText(one)
                   : one.kind == Declaration::Constant ? constantText(one)
                                                       : functionText(one);
        return out;
    }

  private:
    [[nodiscard]] std::string typeText(const std::string &type) const {
        if (const auto found = types.find(type); found != types.end())
            return found->second;
        const LeafDeclaration *known = leaves_.find(type);
        return known != nullptr && known->kind == Declaration::Struct && known->usesReal ? type + "<Real>"
                                                                                         : type;
    }

    /// An expression, statements or fields. A struct that is constructed gets braces, as it has no constructor.
    [[nodiscard]] std::string translated(const LeafDeclaration &of) const {
        const Tokens &tokens = of.body;
        std::string out;
        std::vector<bool> isBraced; // for each open bracket
        bool opensStruct = false;
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            const Token &token = tokens[i];
            const bool isCalled = i + 1 < tokens.size() && tokens[i + 1].text == "(";
            const LeafDeclaration *known = isMember(tokens, i) ? nullptr : leaves_.find(token);
            if (known != nullptr && known->kind == Declaration::Function && !isCalled)
                known = nullptr; // a field or a variable of the same name
            if (token.text == "(") {
                isBraced.push_back(opensStruct);
                out += opensStruct ? "{" : "(";
                opensStruct = false;
            } else if (token.text == ")") {
                out += isBraced.back() ? "}" : ")";
                isBraced.pop_back();
            } else if (token.kind == Token::Number && isReal(token)) {
                out += "Real(" + token.text + ")";
            } else if (known != nullptr) {
                out += known->usesReal ? token.text + "<Real>" : token.text;
                opensStruct = known->kind == Declaration::Struct && isCalled;
                if (!known->sceneWords.empty()) {
                    const bool hasOthers = tokens[afterBlanks(tokens, i + 2)].text != ")";
                    out += hasOthers ? "(scene, " : "(scene";
                    isBraced.push_back(false);
                    ++i;
                }
            } else if (token.kind == Token::Word && of.kind != Declaration::Struct && !isMember(tokens, i) &&
                       leaves_.isSceneWord(token.text, of)) {
                out += "scene." + token.text;
            } else if (token.kind == Token::Word && !isMember(tokens, i)) {
                out += typeText(token.text);
            } else {
                out += token.text;
            }
        }
        return out;
    }

    /// Whether the statements assign to a variable or to a part of it.
    static bool isAssigned(const std::string &name, const Tokens &statements) {
        for (std::size_t i = 0; i < statements.size(); ++i) {
            if (statements[i].text != name || isMember(statements, i))
                continue;
            std::size_t at = i + 1;
            while (statements[at].text == "." || statements[at].text == "[") {
                const bool isIndexed = statements[at].text == "[";
                for (++at; isIndexed && statements[at].text != "]"; ++at) {
                }
                ++at;
            }
            at = afterBlanks(statements, at);
            const bool isCombined =
                std::string_view("+-*/%^|&").find(statements[at].text) != std::string_view::npos;
            at += isCombined ? 1 : 0;
            if (statements[at].text == "=" && statements[at + 1].text != "=")
                return true;
        }
        return false;
    }

    /// A struct that a function does not change it gets by reference.
    [[nodiscard]] std::string parametersOf(const LeafDeclaration &function) const {
        std::string out = function.sceneWords.empty() ? "" : "const SceneView<Real> &scene";
        for (const Variable &one : ::parametersOf(function)) {
            const bool isByValue = leaves_.find(one.type) == nullptr || isAssigned(one.name, function.body);
            out += (out.empty() ? "" : ", ") + std::string(one.isOut || isByValue ? "" : "const ") +
                   typeText(one.type) + (one.isOut || !isByValue ? " &" : " ") + one.name;
        }
        return out;
    }

    static std::string plain(const Tokens &tokens) {
        std::string out;
        for (const Token &token : tokens)
            out += token.text;
        return out;
    }

    static std::string templateText(const LeafDeclaration &one) {
        return one.usesReal ? "template <class Real> " : "";
    }

    [[nodiscard]] std::string structText(const LeafDeclaration &one) const {
        std::string out = plain(one.head) + templateText(one) + "struct " + one.name + " " + translated(one);
        if (!one.isRecord)
            return out + ";\n";
        // A record of the host becomes one in this precision: of floats, it is the same bytes.
        std::string fields;
        for (std::size_t i = 0; i + 1 < one.body.size(); ++i)
            if (one.body[i].kind == Token::Word && one.body[i + 1].text == ";") {
                const std::string &field = one.body[i].text;
                fields += "            " + field + " = decltype(" + field + ")(from." + field + ");\n";
            }
        out.pop_back();
        return out + "\n    " + one.name + "() = default;\n    " + one.name + "(const layout::" + one.name +
               " &from) {\n        if constexpr (std::is_same_v<Real, float>) {\n"
               "            std::memcpy(static_cast<void *>(this), &from, sizeof(from));\n        } else "
               "{\n" +
               fields + "        }\n    }\n};\n";
    }

    [[nodiscard]] std::string constantText(const LeafDeclaration &one) const {
        return plain(one.head) + templateText(one) + "inline constexpr " + typeText(one.type) + " " +
               one.name + " = " + translated(one) + ";";
    }

    [[nodiscard]] std::string functionText(const LeafDeclaration &one) const {
        return plain(one.head) + templateText(one) + "[[nodiscard]] inline " + typeText(one.type) + " " +
               one.name + "(" + parametersOf(one) + ") " + translated(one);
    }

    const LeafDeclarations &leaves_;
};

} // namespace

int main(int argumentCount, char **arguments) {
    if (argumentCount != 5) {
        std::fputs("glsl_to_cpp ROOT LAYOUT.h LEAVES.glsl OUT.h\n", stderr);
        return 2;
    }
    try {
        const LeafDeclarations leaves(arguments[1], arguments[2], arguments[3]);
        std::ofstream out(arguments[4]);
        out << "// Made by cmake/glsl_to_cpp.cpp from the leaf functions of shaders/.\n";
        for (const std::string &name : leaves.layoutConstants())
            out << "using layout::" << name << ";\n";
        out << Translator(leaves).text() << "\n";
        if (!out.flush())
            throw std::runtime_error(std::string(arguments[4]) + " cannot be written");
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
