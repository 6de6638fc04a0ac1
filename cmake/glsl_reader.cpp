#include "cmake/glsl_reader.h"

#include <cctype>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace {

bool isWordLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// From an opening bracket to after the one that closes it.
std::size_t endOfBrackets(const Tokens &tokens, std::size_t begin) {
    int depth = 0;
    for (std::size_t i = begin; i < tokens.size(); ++i) {
        const std::string &text = tokens[i].text;
        depth += text == "(" || text == "{" ? 1 : text == ")" || text == "}" ? -1 : 0;
        if (depth == 0)
            return i + 1;
    }
    throw std::runtime_error("a bracket is not closed after " + tokens[begin].text);
}

Tokens part(const Tokens &tokens, std::size_t begin, std::size_t end) {
    return {tokens.begin() + static_cast<std::ptrdiff_t>(begin),
            tokens.begin() + static_cast<std::ptrdiff_t>(end)};
}

} // namespace

std::string readText(const std::string &path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file)
        throw std::runtime_error("it cannot be read");
    return text.str() + "\n";
}

Tokens tokensOf(const std::string &text) {
    Tokens tokens;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = at + 1;
        Token::Kind kind = Token::Mark;
        if (text.compare(at, 2, "//") == 0) {
            end = text.find('\n', at);
            kind = Token::Blank;
        } else if (text[at] == '#') {
            at = text.find('\n', at);
            continue;
        } else if (std::isspace(static_cast<unsigned char>(text[at])) != 0) {
            kind = Token::Blank;
        } else if (std::isdigit(static_cast<unsigned char>(text[at])) != 0) {
            kind = Token::Number;
            while (isWordLetter(text[end]) || text[end] == '.' ||
                   ((text[end] == '-' || text[end] == '+') && text[end - 1] == 'e'))
                ++end;
        } else if (isWordLetter(text[at])) {
            kind = Token::Word;
            while (isWordLetter(text[end]))
                ++end;
        }
        tokens.push_back({kind, text.substr(at, end - at)});
        at = end;
    }
    return tokens;
}

std::string glslPartOf(const std::string &text) {
    std::istringstream lines(text);
    std::string part;
    int depth = 0; // in #ifdef __cplusplus, before its #else
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("#ifdef __cplusplus"))
            depth = 1;
        else if (line.starts_with("#else") || line.starts_with("#endif"))
            depth = 0;
        else if (depth == 0)
            part += line + "\n";
    return part;
}

std::size_t afterBlanks(const Tokens &tokens, std::size_t at) {
    while (at < tokens.size() && tokens[at].kind == Token::Blank)
        ++at;
    return at;
}

std::vector<Declaration> declarationsOf(const Tokens &tokens) {
    std::vector<Declaration> declarations;
    for (std::size_t begin = 0; begin < tokens.size();) {
        Declaration one{};
        std::size_t at = afterBlanks(tokens, begin);
        one.head = part(tokens, begin, at);
        if (at == tokens.size())
            break;
        if (tokens[at].text == "HYALITE_INLINE")
            at = afterBlanks(tokens, at + 1);
        const bool isConstant = tokens[at].text == "const";
        const bool isStruct = tokens[at].text == "struct";
        if (isConstant)
            at = afterBlanks(tokens, at + 1);
        one.type = tokens[at].text;
        at = afterBlanks(tokens, at + 1);
        one.name = tokens.at(at).text;
        at = afterBlanks(tokens, at + 1);
        if (isStruct) {
            one.kind = Declaration::Struct;
            const std::size_t end = endOfBrackets(tokens, at);
            one.body = part(tokens, at, end);
            begin = end + 1; // the semicolon
        } else if (isConstant) {
            one.kind = Declaration::Constant;
            std::size_t end = at;
            while (tokens.at(end).text != ";")
                ++end;
            one.body = part(tokens, afterBlanks(tokens, at + 1), end);
            begin = end + 1;
        } else if (tokens.at(at).text == "(") {
            one.kind = Declaration::Function;
            const std::size_t end = endOfBrackets(tokens, at);
            one.parameters = part(tokens, at + 1, end - 1);
            at = afterBlanks(tokens, end);
            const std::size_t last = endOfBrackets(tokens, at);
            one.body = part(tokens, at, last);
            begin = last;
        } else {
            throw std::runtime_error(one.name + " is no struct, constant or function");
        }
        declarations.push_back(one);
    }
    return declarations;
}

std::vector<Variable> fieldsOf(const Declaration &record) {
    std::vector<Variable> fields;
    std::vector<std::string> words;
    for (const Token &token : record.body) {
        if (token.kind == Token::Word)
            words.push_back(token.text);
        if (token.text != ";")
            continue;
        if (words.size() != 2)
            throw std::runtime_error(record.name + " has a field that is not TYPE NAME;");
        fields.push_back({words[0], words[1]});
        words.clear();
    }
    return fields;
}

std::vector<Variable> parametersOf(const Declaration &function) {
    std::vector<Variable> parameters;
    std::vector<std::string> words;
    const auto addOne = [&] {
        if (words.empty())
            return;
        const bool isMarked = words.size() == 3; // in, out or inout
        parameters.push_back({words[words.size() - 2], words.back(), !isMarked || words[0] != "out",
                              isMarked && words[0] != "in"});
        words.clear();
    };
    for (const Token &token : function.parameters) {
        if (token.kind == Token::Word)
            words.push_back(token.text);
        else if (token.text == ",")
            addOne();
    }
    addOne();
    return parameters;
}
