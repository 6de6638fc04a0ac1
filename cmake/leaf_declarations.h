// All leaf functions of the shaders, and what their C++ depends on: what glsl_to_cpp and glsl_probes are made from.
#pragma once

#include "cmake/glsl_reader.h"

#include <map>
#include <set>
#include <string>
#include <vector>

struct LeafDeclaration : Declaration {
    std::string file;      ///< below the root
    bool isRecord = false; ///< of layout.h
    bool usesReal = false; ///< has to do with floats, or is a record: a template in C++
    /// What a function reads of the scene, itself or by those that it calls: constants, `frame`, fetch functions.
    std::set<std::string> sceneWords;
};

class LeafDeclarations {
  public:
    /// The file `leaves` includes the leaf files, by paths below `root`, and they may include others. `layout` comes
    /// first, without its constants. Throws std::runtime_error, naming the file.
    LeafDeclarations(const std::string &root, const std::string &layout, const std::string &leaves);

    /// In the order of the files: each after those that it depends on.
    [[nodiscard]] const std::vector<LeafDeclaration> &all() const { return declarations_; }
    /// Names of the constants of the layout.
    [[nodiscard]] const std::vector<std::string> &layoutConstants() const { return layoutConstants_; }

    /// Of this name the first, or nullptr.
    [[nodiscard]] const LeafDeclaration *find(const std::string &name) const;
    [[nodiscard]] const LeafDeclaration *find(const Token &token) const {
        return token.kind == Token::Word ? find(token.text) : nullptr;
    }

    /// Whether the word, in `function`, is read of the scene: a parameter of such a name is not.
    [[nodiscard]] bool isSceneWord(const std::string &word, const Declaration &function) const;

  private:
    void addFile(const std::string &root, const std::string &path);
    void add(const Declaration &added, const std::string &file, bool isRecord);

    std::vector<LeafDeclaration> declarations_;
    std::vector<std::string> layoutConstants_;
    std::map<std::string, std::size_t> names_; ///< of the first overload
};

/// Whether the token names a member of what is before it.
[[nodiscard]] inline bool isMember(const Tokens &tokens, std::size_t i) {
    return i > 0 && tokens[i - 1].text == ".";
}

/// Whether the token is a type of floats, or a number with a fraction.
[[nodiscard]] bool isReal(const Token &token);
