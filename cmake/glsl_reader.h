// GLSL as the build tools read it: tokens, and the structs, constants and functions at the top level of a file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

struct Token {
    enum Kind { Blank, Word, Number, Mark } kind; ///< comments are blanks
    std::string text;
};

using Tokens = std::vector<Token>;

struct Declaration {
    enum Kind { Struct, Constant, Function } kind;
    std::string name;
    std::string type; ///< of a constant or a result
    Tokens head;      ///< blanks and comments before it
    Tokens parameters;
    Tokens body; ///< of a struct and a function with braces; of a constant its value
};

/// A field of a struct, or a parameter of a function.
struct Variable {
    std::string type;
    std::string name;
    bool isIn = true;
    bool isOut = false;
};

/// The text of a file. Throws std::runtime_error.
[[nodiscard]] std::string readText(const std::string &path);

/// The text without the parts between `#ifdef __cplusplus` and its `#else` or `#endif`.
[[nodiscard]] std::string glslPartOf(const std::string &text);

/// Lines for the preprocessor are left out.
[[nodiscard]] Tokens tokensOf(const std::string &text);

/// Throws std::runtime_error where the tokens are anything else than structs, constants and functions.
[[nodiscard]] std::vector<Declaration> declarationsOf(const Tokens &tokens);

/// Of a struct. Throws std::runtime_error where they are not `TYPE NAME;` each.
[[nodiscard]] std::vector<Variable> fieldsOf(const Declaration &record);

/// Of a function, in order.
[[nodiscard]] std::vector<Variable> parametersOf(const Declaration &function);

/// The first token from `at` on that is no blank, or the end.
[[nodiscard]] std::size_t afterBlanks(const Tokens &tokens, std::size_t at);
