#include "host/base/json_reader.h"

#include "host/base/clean_text.h"
#include "host/base/json_document.h"
#include "host/base/letter_case.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hyalite::core {
namespace {

using nlohmann::json;

std::string describe(const json &value) {
    if (value.is_array())
        return fmt::format("an array of {}", value.size());
    if (value.is_object())
        return "an object";
    return excerpt(value.dump());
}

/// Levenshtein's edit distance, upper and lower case being the same.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (lowerCase(a[i]) == lowerCase(b[j]) ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

/// In lower case, and as the English spell it.
std::string spelled(std::string_view word) {
    std::string text = lowerCase(word);
    for (const auto &[american, english] : {std::pair("color", "colour"), std::pair("center", "centre")})
        if (const std::size_t at = text.find(american); at != std::string::npos)
            text.replace(at, std::string_view(american).size(), english);
    return text;
}

bool isSynonym(std::string_view word, std::string_view candidate) {
    constexpr auto synonyms =
        std::to_array<std::pair<std::string_view, std::string_view>>({{"colour", "albedo"},
                                                                      {"basecolour", "albedo"},
                                                                      {"albedo", "basecolour"},
                                                                      {"colour", "power"},
                                                                      {"intensity", "power"},
                                                                      {"fov", "horizontalfov"},
                                                                      {"samples", "spp"},
                                                                      {"lookat", "target"},
                                                                      {"fovdegrees", "horizontalfov"},
                                                                      {"size", "transform"},
                                                                      {"position", "transform"},
                                                                      {"position", "centre"},
                                                                      {"radius", "transform"}});
    constexpr std::size_t shortest = 3;
    if (word.size() < shortest || word.size() > 64)
        return false;
    const std::pair<std::string, std::string> both(spelled(word), spelled(candidate));
    return both.second.find(both.first) != std::string::npos ||
           std::ranges::find(synonyms, std::pair<std::string_view, std::string_view>(both)) != synonyms.end();
}

} // namespace

void JsonNode::refuse(std::string_view allowed) const {
    fail(fmt::format("found {}; allowed: {}", describe(*value), allowed));
}

void JsonNode::fail(std::string_view message, Remedy remedy) const {
    failAt(*fileName, path, message, remedy);
}

double JsonNode::number(const Interval &allowed) const {
    const double number = value->is_number() ? allowed.rounded(value->get<double>()) : 0.0;
    if (!value->is_number() || !allowed.contains(number))
        refuse("a number " + allowed.text());
    return number;
}

glm::dvec3 JsonNode::vector(const Interval &allowed) const {
    if (!value->is_array() || value->size() != 3)
        refuse("an array of 3 numbers, each " + allowed.text());
    const auto component = [&](std::size_t i) {
        return JsonNode{&(*value)[i], fileName, path / i}.number(allowed);
    };
    return {component(0), component(1), component(2)};
}

glm::dvec2 JsonNode::pair(const Interval &allowed) const {
    if (value->is_number())
        return glm::dvec2(number(allowed));
    if (!value->is_array() || value->size() != 2)
        refuse("[u, v] or one number for both, each " + allowed.text());
    const auto component = [&](std::size_t i) {
        return JsonNode{&(*value)[i], fileName, path / i}.number(allowed);
    };
    return {component(0), component(1)};
}

glm::dvec3 JsonNode::colour(const Interval &allowed) const {
    if (value->is_number())
        return glm::dvec3(number(allowed));
    if (!value->is_array() || value->size() != 3)
        refuse("[red, green, blue] or one number for grey, each " + allowed.text());
    return vector(allowed);
}

double JsonNode::wholeNumber(const Interval &allowed) const {
    const double number = value->is_number() ? value->get<double>() : 0.5;
    if (number != std::trunc(number) || !allowed.contains(number))
        refuse("a whole number " + allowed.text());
    return number;
}

bool JsonNode::boolean() const {
    if (!value->is_boolean())
        refuse("true or false");
    return value->get<bool>();
}

std::string JsonNode::text() const {
    if (!value->is_string())
        refuse("a text");
    const std::string &text = value->get_ref<const std::string &>();
    if (text.find('\0') != std::string::npos)
        refuse("a text without the character NUL"); // the system would cut a file name there
    return text;
}

std::size_t JsonNode::indexOfName(std::span<const std::string_view> names) const {
    if (!value->is_string())
        refuse(quotedList(names));
    const std::string &text = value->get_ref<const std::string &>();
    const auto name = std::find(names.begin(), names.end(), text);
    if (name == names.end())
        refuse(quotedList(names) + suggestion(text, names));
    return static_cast<std::size_t>(name - names.begin());
}

void JsonFaults::keep(const Error &error) {
    constexpr std::size_t maxShown = 20;
    if (error.kind != ErrorKind::BadInput)
        throw; // it is being handled
    if (const auto *const faults = dynamic_cast<const JsonError *>(&error))
        faults_.insert(faults_.end(), faults->faults.begin(), faults->faults.end());
    else
        faults_.push_back({nlohmann::json::json_pointer(), error.what()});
    remedy_ = remedy_ == Remedy::None ? error.remedy : remedy_;
    if (faults_.size() >= maxShown) {
        faults_.resize(maxShown);
        throwThem();
    }
}

void JsonFaults::throwThem() const {
    if (!faults_.empty())
        throw JsonError(faults_, remedy_);
}

JsonObject::JsonObject(JsonNode node) : node_(std::move(node)) {
    if (!node_.value->is_object())
        node_.refuse("an object { }");
}

void JsonObject::allowOnly(std::span<const std::string_view> keys) const {
    JsonFaults faults;
    for (const auto &[key, value] : node_.value->items()) {
        if (std::find(keys.begin(), keys.end(), key) != keys.end())
            continue;
        const JsonNode node{&value, node_.fileName, node_.path / key};
        if (key == "description") {
            static_cast<void>(node.text());
            continue;
        }
        const std::string allowed = keys.empty() ? "none" : quotedList(keys);
        faults.collect([&, &word = key] {
            node.fail(fmt::format("unknown key; allowed: {}{}", allowed, suggestion(word, keys)));
        });
    }
    faults.throwThem();
}

std::optional<JsonNode> JsonObject::find(std::string_view key) const {
    const auto member = node_.value->find(key);
    if (member == node_.value->end() || member->is_null())
        return {};
    return JsonNode{&*member, node_.fileName, node_.path / std::string(key)};
}

JsonNode JsonObject::at(std::string_view key) const {
    if (std::optional<JsonNode> node = find(key))
        return *node;
    failAt(*node_.fileName, node_.path / std::string(key), "missing; the key is required here");
}

std::optional<JsonObject> JsonObject::object(std::string_view key,
                                             std::span<const std::string_view> keys) const {
    if (std::optional<JsonNode> node = find(key))
        return JsonObject(*node, keys);
    return {};
}

std::vector<JsonNode> JsonObject::elements(std::string_view key, std::size_t maxCount) const {
    std::vector<JsonNode> elements;
    const std::optional<JsonNode> array = find(key);
    if (!array)
        return elements;
    if (!array->value->is_array() || array->value->size() > maxCount)
        array->refuse(fmt::format("an array of at most {} objects", maxCount));
    for (const json &element : *array->value)
        elements.push_back({&element, array->fileName, array->path / elements.size()});
    return elements;
}

std::vector<std::pair<std::string, JsonNode>> JsonObject::members(std::size_t maxCount) const {
    if (node_.value->size() > maxCount)
        node_.fail(fmt::format("found {} keys; at most {} are allowed", node_.value->size(), maxCount));
    std::vector<std::pair<std::string, JsonNode>> members;
    for (const auto &[key, value] : node_.value->items())
        if (!value.is_null())
            members.push_back({key, {&value, node_.fileName, node_.path / key}});
    return members;
}

std::string suggestion(std::string_view word, std::span<const std::string_view> candidates) {
    constexpr std::size_t longestWord = 64; // longer words are not typing errors
    for (const std::string_view candidate : candidates)
        if (isSynonym(word, candidate))
            return fmt::format("; did you mean \"{}\"?", excerpt(candidate));
    std::string_view nearest;
    std::size_t minDistance = std::max<std::size_t>(2, word.size() / 2);
    for (const std::string_view candidate : candidates) {
        const std::size_t distance = word.size() > longestWord ? word.size() : editDistance(word, candidate);
        if (distance < minDistance || (nearest.empty() && distance == minDistance)) {
            nearest = candidate;
            minDistance = distance;
        }
    }
    return nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", excerpt(nearest));
}

std::string quotedList(std::span<const std::string_view> words) {
    constexpr std::size_t maxListed = 32; // a scene may define thousands of materials
    std::string list;
    for (const std::string_view word : words.first(std::min(words.size(), maxListed)))
        list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", excerpt(word));
    return words.size() > maxListed ? list + ", ..." : list;
}

} // namespace hyalite::core
