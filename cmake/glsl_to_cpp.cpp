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
#include "cmake/glsl_reader.h"

#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

/// A declaration, and what its C++ depends on.
struct Translated : Declaration {
    bool isRecord = false;  ///< of layout.h
    bool usesReal = false;  ///< has to do with floats, or is a record: a template
    bool usesScene = false; ///< a function that reads the scene
};

const std::set<std::string> sceneWords{"frame",        "scattering",  "texturing",    "anyHit",
                                       "lighting",     "samplerKind", "camera",       "emitterCount",
                                       "hasTriangles", "hasNormals",  "hasInstances", "hasEmission",
                                       "hasLightTree", "treeSpheres", "sphereCount",  "infiniteEmitterCount",
                                       "placeCount"};
const std::map<std::string, std::string> types{
    {"float", "Real"}, {"vec2", "Vec2<Real>"}, {"vec3", "Vec3<Real>"}, {"vec4", "Vec4<Real>"}};

class Translator {
  public:
    void add(const Declaration &added, bool isRecord = false) {
        Translated one{added, isRecord, isRecord};
        const auto look = [&](const Tokens &tokens) {
            for (std::size_t i = 0; i < tokens.size(); ++i) {
                if (isMember(tokens, i))
                    continue;
                const Translated *known = find(tokens[i]);
                one.usesScene |= one.kind == Declaration::Function &&
                                 (isSceneWord(tokens[i]) || (known != nullptr && known->usesScene));
                one.usesReal |= isReal(tokens[i]) || (known != nullptr && known->usesReal);
            }
        };
        look(one.parameters);
        look(one.body);
        look({{Token::Word, one.type}});
        one.usesReal |= one.usesScene;
        const auto [overload, isNew] = names_.emplace(one.name, declarations_.size());
        if (!isNew && declarations_[overload->second].usesReal != one.usesReal)
            throw std::runtime_error(one.name + " has overloads with and without floats");
        declarations_.push_back(one);
    }

    [[nodiscard]] std::string text() const {
        std::string out;
        for (const Translated &one : declarations_)
            out += one.kind == Declaration::Struct     ? structText(one)
                   : one.kind == Declaration::Constant ? constantText(one)
                                                       : functionText(one);
        return out;
    }

  private:
    [[nodiscard]] const Translated *find(const Token &token) const {
        const auto found = names_.find(token.text);
        return token.kind == Token::Word && found != names_.end() ? &declarations_[found->second] : nullptr;
    }

    static bool isMember(const Tokens &tokens, std::size_t i) { return i > 0 && tokens[i - 1].text == "."; }

    [[nodiscard]] bool isSceneWord(const Token &token) const {
        return sceneWords.contains(token.text) || (token.text.starts_with("fetch") && find(token) == nullptr);
    }

    static bool isReal(const Token &token) {
        if (token.kind != Token::Number)
            return types.contains(token.text);
        return !token.text.starts_with("0x") && token.text.find_first_of(".e") != std::string::npos;
    }

    [[nodiscard]] std::string typeText(const std::string &type) const {
        if (const auto found = types.find(type); found != types.end())
            return found->second;
        const Translated *known = find({Token::Word, type});
        return known != nullptr && known->kind == Declaration::Struct && known->usesReal ? type + "<Real>"
                                                                                         : type;
    }

    /// An expression, statements or fields. A struct that is constructed gets braces, as it has no constructor.
    [[nodiscard]] std::string translated(const Tokens &tokens, bool isStruct = false) const {
        std::string out;
        std::vector<bool> isBraced; // for each open bracket
        bool opensStruct = false;
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            const Token &token = tokens[i];
            const bool isCalled = i + 1 < tokens.size() && tokens[i + 1].text == "(";
            const Translated *known = isMember(tokens, i) ? nullptr : find(token);
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
                if (known->usesScene) {
                    const bool hasOthers = tokens[afterBlanks(tokens, i + 2)].text != ")";
                    out += hasOthers ? "(scene, " : "(scene";
                    isBraced.push_back(false);
                    ++i;
                }
            } else if (token.kind == Token::Word && !isStruct && !isMember(tokens, i) && isSceneWord(token)) {
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
    [[nodiscard]] std::string parametersOf(const Translated &function) const {
        std::string out = function.usesScene ? "const SceneView<Real> &scene" : "";
        Tokens one;
        const auto addOne = [&] {
            const std::size_t type = afterBlanks(one, 0);
            if (type == one.size())
                return;
            const bool isOut = one[type].text == "inout" || one[type].text == "out";
            const std::size_t at = isOut ? afterBlanks(one, type + 1) : type;
            const std::string &name = one[afterBlanks(one, at + 1)].text;
            const bool isStruct = find(one[at]) != nullptr;
            const bool isByValue = !isStruct || isAssigned(name, function.body);
            out += (out.empty() ? "" : ", ") + std::string(isOut || isByValue ? "" : "const ") +
                   typeText(one[at].text) + (isOut || !isByValue ? " &" : " ") + name;
        };
        for (const Token &token : function.parameters) {
            if (token.text == ",") {
                addOne();
                one.clear();
            } else {
                one.push_back(token);
            }
        }
        addOne();
        return out;
    }

    static std::string plain(const Tokens &tokens) {
        std::string out;
        for (const Token &token : tokens)
            out += token.text;
        return out;
    }

    static std::string templateText(const Translated &one) {
        return one.usesReal ? "template <class Real> " : "";
    }

    [[nodiscard]] std::string structText(const Translated &one) const {
        std::string out =
            plain(one.head) + templateText(one) + "struct " + one.name + " " + translated(one.body, true);
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

    [[nodiscard]] std::string constantText(const Translated &one) const {
        return plain(one.head) + templateText(one) + "inline constexpr " + typeText(one.type) + " " +
               one.name + " = " + translated(one.body) + ";";
    }

    [[nodiscard]] std::string functionText(const Translated &one) const {
        return plain(one.head) + templateText(one) + "[[nodiscard]] inline " + typeText(one.type) + " " +
               one.name + "(" + parametersOf(one) + ") " + translated(one.body);
    }

    std::vector<Translated> declarations_;
    std::map<std::string, std::size_t> names_; ///< of the first overload
};

/// Adds the texts of the files that a file includes, each after those that it includes itself, and then its own. `file`
/// is the one that was read last.
void addLeaves(const std::string &root, const std::string &path, std::string &file,
               std::vector<std::string> &texts) {
    file = path;
    const std::string text = readText(path);
    std::istringstream lines(text);
    constexpr std::string_view include = "#include \"";
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(include))
            addLeaves(root, root + "/" + line.substr(include.size(), line.rfind('"') - include.size()), file,
                      texts);
    texts.push_back(text);
}

} // namespace

int main(int argumentCount, char **arguments) {
    if (argumentCount != 5) {
        std::fputs("glsl_to_cpp ROOT LAYOUT.h LEAVES.glsl OUT.h\n", stderr);
        return 2;
    }
    Translator translator;
    std::string file;
    try {
        std::vector<std::string> texts;
        addLeaves(arguments[1], arguments[3], file, texts);
        file = arguments[2];
        std::string constants; // of the layout, by their names
        for (const Declaration &one : declarationsOf(tokensOf(glslPartOf(readText(file)))))
            if (one.kind == Declaration::Constant)
                constants += "using layout::" + one.name + ";\n";
            else
                translator.add(one, one.kind == Declaration::Struct);
        file = arguments[3];
        for (const std::string &text : texts)
            for (const Declaration &one : declarationsOf(tokensOf(text)))
                translator.add(one);
        file = arguments[4];
        std::ofstream out(file);
        out << "// Made by cmake/glsl_to_cpp.cpp from the leaf functions of shaders/.\n"
            << constants << translator.text() << "\n";
        if (!out.flush())
            throw std::runtime_error("it cannot be written");
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s: %s\n", file.c_str(), error.what());
        return 1;
    }
    return 0;
}
