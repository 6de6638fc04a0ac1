#include "host/base/json_document.h"

#include "host/base/clean_text.h"
#include "host/base/content_guess.h"
#include "host/base/error.h"
#include "host/base/input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

namespace hyalite::core {
namespace {

using nlohmann::json;

constexpr std::uint64_t maxFileBytes = std::uint64_t{512} << 20;
constexpr std::size_t maxNesting = 32;
constexpr std::size_t maxSyntaxMessageBytes = 300;

/// Walks through a text once, and knows where it is.
class DocumentWalk : public json::json_sax_t {
  public:
    bool null() override { return startValue(); }
    bool boolean(bool) override { return startValue(); }
    bool number_integer(number_integer_t) override { return startValue(); }
    bool number_unsigned(number_unsigned_t) override { return startValue(); }
    bool number_float(number_float_t, const string_t &) override { return startValue(); }
    bool string(string_t &) override { return startValue(); }
    bool binary(binary_t &) override { return startValue(); }
    bool start_object(std::size_t) override { return open(false); }
    bool end_object() override { return close(); }
    bool start_array(std::size_t) override { return open(true); }
    bool end_array() override { return close(); }
    bool key(string_t &key) override {
        levels_.back().key = key;
        onStep();
        return true;
    }

  protected:
    struct Level {
        bool isArray;
        std::size_t begunCount = 0; ///< number of elements of an array so far
        std::string key{};          ///< last key of an object
        std::unordered_set<std::string> keys{};
    };

    /// A key, or an element of an array, begins: the last of the levels.
    virtual void onStep() = 0;
    /// An object or an array begins, whose level does not exist yet.
    virtual void onNesting() {}

    [[nodiscard]] std::vector<Level> &levels() { return levels_; }
    [[nodiscard]] json::json_pointer path() const {
        json::json_pointer path;
        for (const Level &level : levels_)
            if (level.isArray)
                path /= level.begunCount - 1;
            else
                path /= level.key;
        return path;
    }

  private:
    bool startValue() {
        if (!levels_.empty() && levels_.back().isArray) {
            ++levels_.back().begunCount;
            onStep();
        }
        return true;
    }
    bool open(bool isArray) {
        startValue();
        onNesting();
        levels_.push_back({isArray});
        return true;
    }
    bool close() {
        levels_.pop_back();
        return true;
    }

    std::vector<Level> levels_;
};

/// Checks what a document cannot tell any more: the syntax with its place,
/// the nesting before it costs memory, and keys given twice (of which the parser keeps the last).
class DocumentCheck : public DocumentWalk {
  public:
    DocumentCheck(const std::string &fileName, const std::string &text) : fileName_(fileName), text_(text) {}

    /// `position` counts the bytes read, the last of which is at fault.
    bool parse_error(std::size_t position, const std::string &, const json::exception &error) override {
        if (const std::string guess = guessBySignature(text_); !guess.empty())
            throw Error(ErrorKind::BadInput,
                        fmt::format("{}: this is not JSON; it looks like {}", fileName_, guess));
        // "[json.exception.parse_error.101] parse error at line 1, column 2: what" -> "what"
        std::string what = error.what();
        what.erase(0, what.find("] ") + 2);
        if (what.starts_with("parse error"))
            what.erase(0, what.find(": ") + 2);
        // The bytes that it cites need not be UTF-8.
        std::replace_if(
            what.begin(), what.end(), [](char c) { return static_cast<unsigned char>(c) > 0x7F; }, '?');
        const std::size_t offset = std::max<std::size_t>(position, 1) - 1;
        const bool isComment = offset < text_.size() && (text_[offset] == '/' || text_[offset] == '#');
        failAtByte(offset, excerpt(what, maxSyntaxMessageBytes) +
                               (isComment ? "; JSON has no comments, but every object of a scene may have a "
                                            "\"description\""
                                          : ""));
    }

    /// Throws Error{BadInput} with the line and column of a byte of the text.
    [[noreturn]] void failAtByte(std::size_t offset, std::string_view message) const {
        const std::string_view before = std::string_view(text_).substr(0, offset);
        const auto line = 1 + std::count(before.begin(), before.end(), '\n');
        const std::size_t lineStart = before.rfind('\n') + 1; // npos + 1 is 0
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}:{}:{}: {}", fileName_, line, before.size() - lineStart + 1, message));
    }

  private:
    void onStep() override {
        Level &level = levels().back();
        if (!level.isArray && !level.keys.insert(level.key).second)
            failAt(fileName_, path(), "the key is given twice");
    }
    void onNesting() override {
        if (levels().size() == maxNesting)
            failAt(fileName_, path(), fmt::format("nested deeper than {} levels", maxNesting));
    }

    const std::string &fileName_;
    const std::string &text_;
};

/// Counts lines up to the last character that was read but one: the parser reads one character beyond a number.
class CountingIterator {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char *;
    using reference = const char &;

    CountingIterator(const char *at, std::size_t *line) : at_(at), line_(line) {}
    const char &operator*() const { return *at_; }
    CountingIterator &operator++() {
        *line_ += isBehindEnd_ ? 1 : 0;
        isBehindEnd_ = *at_++ == '\n';
        return *this;
    }
    bool operator==(const CountingIterator &other) const { return at_ == other.at_; }
    bool operator!=(const CountingIterator &other) const { return at_ != other.at_; }

  private:
    const char *at_;
    std::size_t *line_;
    bool isBehindEnd_ = false;
};

/// Follows a path as far as the document has it.
class LineFinder : public DocumentWalk {
  public:
    LineFinder(const json::json_pointer &path, const std::size_t &line) : line_(line) {
        for (json::json_pointer rest = path; !rest.empty(); rest.pop_back())
            wanted_.insert(wanted_.begin(), rest.back());
    }
    [[nodiscard]] std::size_t found() const { return found_; }

    bool parse_error(std::size_t, const std::string &, const json::exception &) override { return false; }

  private:
    void onStep() override {
        const auto step = [](const Level &level) {
            return level.isArray ? fmt::format("{}", level.begunCount - 1) : level.key;
        };
        const std::size_t depth = levels().size();
        if (depth > depth_ && depth <= wanted_.size() &&
            std::ranges::equal(levels(), std::span(wanted_).first(depth), {}, step)) {
            depth_ = depth;
            found_ = line_;
        }
    }

    const std::size_t &line_;
    std::vector<std::string> wanted_;
    std::size_t depth_ = 0;
    std::size_t found_ = 1;
};

std::string joined(const std::vector<JsonFault> &faults) {
    std::string text;
    for (const JsonFault &fault : faults)
        text += (text.empty() ? "" : "\n") + fault.text;
    return text;
}

std::string readText(const std::filesystem::path &path) {
    const InputFile file(path);
    if (file.sizeBytes() > maxFileBytes)
        throw file.bad(
            fmt::format("has {} bytes; at most {} (512 MiB) are read", file.sizeBytes(), maxFileBytes));
    std::string text(static_cast<std::size_t>(file.sizeBytes()), '\0');
    file.read(0, std::as_writable_bytes(std::span(text)));
    return text;
}

} // namespace

nlohmann::json readJsonFile(const std::filesystem::path &file) {
    return parseJson(readText(file), file.string());
}

nlohmann::json parseJson(const std::string &text, const std::string &fileName) {
    DocumentCheck check(fileName, text);
    json::sax_parse(text, &check);
    // The parser takes a NUL behind the document for the file's end, and would not see what follows.
    if (const std::size_t nul = text.find('\0'); nul != std::string::npos)
        check.failAtByte(nul, "a NUL follows the document; allowed: nothing but white space");
    return json::parse(text);
}

JsonError::JsonError(std::vector<JsonFault> theFaults, Remedy mayHelp)
    : Error(ErrorKind::BadInput, joined(theFaults), mayHelp), faults(std::move(theFaults)) {}

std::size_t lineOf(const std::string &text, const json::json_pointer &path) {
    std::size_t line = 1;
    LineFinder finder(path, line);
    json::sax_parse(CountingIterator(text.data(), &line), CountingIterator(text.data() + text.size(), &line),
                    &finder);
    return finder.found();
}

JsonError withLines(const JsonError &error, const std::filesystem::path &file) {
    const std::string text = readText(file);
    std::vector<JsonFault> faults = error.faults;
    const bool hasLines = text.find('\n') < text.find_last_not_of(" \t\r\n");
    for (JsonFault &fault : faults)
        if (hasLines && !fault.path.empty())
            fault.text += fmt::format(" (line {})", lineOf(text, fault.path));
    return {std::move(faults), error.remedy};
}

void failAt(const std::string &fileName, const nlohmann::json::json_pointer &path, std::string_view message,
            Remedy remedy) {
    const std::string place = path.empty() ? "the top level" : excerpt(path.to_string());
    throw JsonError({{path, fmt::format("{}: {}: {}", fileName, place, message)}}, remedy);
}

} // namespace hyalite::core
