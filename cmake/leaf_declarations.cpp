#include "cmake/leaf_declarations.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace {

const std::set<std::string> sceneConstants{
    "frame",        "scattering",  "texturing",    "anyHit",
    "lighting",     "samplerKind", "camera",       "emitterCount",
    "hasTriangles", "hasNormals",  "hasInstances", "hasEmission",
    "hasLightTree", "treeSpheres", "sphereCount",  "infiniteEmitterCount",
    "placeCount"};
const std::set<std::string> realTypes{"float", "vec2", "vec3", "vec4"};

} // namespace

bool isReal(const Token &token) {
    if (token.kind != Token::Number)
        return realTypes.contains(token.text);
    return !token.text.starts_with("0x") && token.text.find_first_of(".e") != std::string::npos;
}

LeafDeclarations::LeafDeclarations(const std::string &root, const std::string &layout,
                                   const std::string &leaves) {
    try {
        for (const Declaration &one : declarationsOf(tokensOf(glslPartOf(readText(layout)))))
            if (one.kind == Declaration::Constant)
                layoutConstants_.push_back(one.name);
            else
                add(one, "shaders/layout/layout.h", one.kind == Declaration::Struct);
    } catch (const std::exception &error) {
        throw std::runtime_error(layout + ": " + error.what());
    }
    addFile(root, leaves.starts_with(root) ? leaves.substr(root.size() + 1) : leaves);
}

void LeafDeclarations::addFile(const std::string &root, const std::string &path) {
    const std::string text = readText(root + "/" + path);
    std::istringstream lines(text);
    constexpr std::string_view include = "#include \"";
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(include))
            addFile(root, line.substr(include.size(), line.rfind('"') - include.size()));
    try {
        for (const Declaration &one : declarationsOf(tokensOf(text)))
            add(one, path, false);
    } catch (const std::exception &error) {
        throw std::runtime_error(path + ": " + error.what());
    }
}

void LeafDeclarations::add(const Declaration &added, const std::string &file, bool isRecord) {
    LeafDeclaration one{added, file, isRecord, isRecord, {}};
    const auto look = [&](const Tokens &tokens) {
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            if (isMember(tokens, i))
                continue;
            const LeafDeclaration *known = find(tokens[i]);
            one.usesReal |= isReal(tokens[i]) || (known != nullptr && known->usesReal);
            if (one.kind != Declaration::Function)
                continue;
            if (tokens[i].kind == Token::Word && isSceneWord(tokens[i].text, one))
                one.sceneWords.insert(tokens[i].text);
            for (const LeafDeclaration &other : declarations_) // all overloads
                if (known != nullptr && other.name == known->name)
                    one.sceneWords.insert(other.sceneWords.begin(), other.sceneWords.end());
        }
    };
    look(one.parameters);
    look(one.body);
    look({{Token::Word, one.type}});
    one.usesReal |= !one.sceneWords.empty();
    const auto [overload, isNew] = names_.emplace(one.name, declarations_.size());
    if (!isNew && (declarations_[overload->second].usesReal != one.usesReal ||
                   declarations_[overload->second].sceneWords.empty() != one.sceneWords.empty()))
        throw std::runtime_error(one.name + " has overloads with and without floats or the scene");
    declarations_.push_back(one);
}

const LeafDeclaration *LeafDeclarations::find(const std::string &name) const {
    const auto found = names_.find(name);
    return found != names_.end() ? &declarations_[found->second] : nullptr;
}

bool LeafDeclarations::isSceneWord(const std::string &word, const Declaration &function) const {
    if (std::ranges::any_of(parametersOf(function), [&](const Variable &one) { return one.name == word; }))
        return false;
    return sceneConstants.contains(word) || (word.starts_with("fetch") && find(word) == nullptr);
}
