#include "host/farm/part_origin.h"

#include "host/base/clean_text.h"
#include "host/base/error.h"
#include "host/base/shell.h"
#include "host/report/provenance.h"
#include "host/scene/names.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include <unistd.h>

namespace hyalite {

namespace {

/// The name of a file for another part: its own number, where the name has it, becomes that of the other one.
std::string fileFor(const std::string &file, const Part &own, const Part &part) {
    const std::filesystem::path path(file);
    std::string stem = path.stem().string();
    const std::string from = fmt::format("{}", own.index);
    for (std::size_t at = stem.rfind(from); at != std::string::npos && !stem.empty();
         at = at == 0 ? std::string::npos : stem.rfind(from, at - 1)) {
        const auto isDigit = [&](std::size_t i) {
            return i < stem.size() && stem[i] >= '0' && stem[i] <= '9';
        };
        std::size_t begin = at; // with zeros in front
        while (begin > 0 && stem[begin - 1] == '0')
            --begin;
        if (isDigit(at + from.size()) || (begin > 0 && isDigit(begin - 1)))
            continue;
        const std::size_t width = at + from.size() - begin;
        stem.replace(begin, width, fmt::format("{:0{}}", part.index, begin < at ? width : 1));
        return (path.parent_path() / (stem + path.extension().string())).string();
    }
    return (path.parent_path() / fmt::format("{}-{}{}", stem, part.index, path.extension().string()))
        .string();
}

/// Replaces the value of an option, which follows it or stands in its word behind an equals sign.
template <class Replace>
void replaceValue(std::vector<std::string> &words, std::string_view option, const Replace &replace) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == option && i + 1 < words.size())
            words[i + 1] = replace(words[i + 1]);
        else if (words[i].starts_with(std::string(option) + "="))
            words[i] = fmt::format("{}={}", option, replace(words[i].substr(option.size() + 1)));
        else if (option.size() == 2 && words[i].starts_with(option) && words[i].size() > 2) // -oFILE
            words[i] = fmt::format("{}{}", option, replace(words[i].substr(2)));
    }
}

/// Whether a word of a command line can be shown as it is.
bool isPlain(const std::string &word) {
    return std::ranges::none_of(word, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; });
}

int sideOf(const nlohmann::ordered_json &value) {
    constexpr std::int64_t most = 1 << 20;
    if (!value.is_number_integer() || value.get<std::int64_t>() < 1 || value.get<std::int64_t>() > most)
        throw Error(ErrorKind::BadInput,
                    fmt::format("its picture cannot have a side of {} pixels", value.dump()));
    return static_cast<int>(value.get<std::int64_t>());
}

} // namespace

std::string PartOrigin::maker() const {
    return fmt::format("{} ({})", excerpt(host, 80), excerpt(device, 160));
}

std::string PartOrigin::commandFor(const Part &own, const Part &part) const {
    std::vector<std::string> again = words;
    replaceValue(again, "--part",
                 [&](const std::string &) { return fmt::format("{}/{}", part.index, part.count); });
    for (const std::string_view option : {"-o", "--output"})
        replaceValue(again, option, [&](const std::string &file) { return fileFor(file, own, part); });
    again.front() = "hyalite"; // wherever it was there
    std::vector<const char *> pointers;
    pointers.reserve(again.size());
    for (const std::string &word : again)
        pointers.push_back(word.c_str());
    return cleanText(shellLine(pointers));
}

std::string hostName() {
    std::array<char, 256> name{};
    return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown host";
}

std::string toText(const PartOrigin &origin) {
    nlohmann::ordered_json json{{"host", origin.host},
                                {"folder", origin.folder},
                                {"words", origin.words},
                                {"wholeWidth", origin.wholeWidth},
                                {"wholeHeight", origin.wholeHeight},
                                {"layers", nlohmann::ordered_json::array()},
                                {"provenance", nlohmann::ordered_json::parse(origin.provenance)}};
    for (const Integrator layer : origin.layers)
        json["layers"].push_back(nameOf(layer));
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

PartOrigin readPartOrigin(std::string_view text) {
    try {
        constexpr int deepest = 16;
        const nlohmann::ordered_json json =
            nlohmann::ordered_json::parse(text, [](int depth, auto, const nlohmann::ordered_json &) {
                if (depth > deepest)
                    throw Error(ErrorKind::BadInput,
                                "it does not say how it was made: it is nested too deeply");
                return true;
            });
        PartOrigin origin;
        origin.host = json.at("host").get<std::string>();
        origin.folder = json.at("folder").get<std::string>();
        origin.words = json.at("words").get<std::vector<std::string>>();
        if (origin.words.size() < 2 || origin.words[1] != "render" ||
            !std::ranges::all_of(origin.words, isPlain))
            throw Error(ErrorKind::BadInput, "it does not say by which render it was made");
        origin.wholeWidth = sideOf(json.at("wholeWidth"));
        origin.wholeHeight = sideOf(json.at("wholeHeight"));
        const nlohmann::ordered_json &provenance = json.at("provenance");
        if (!hasKnownAttributes(provenance))
            throw Error(ErrorKind::BadInput, "it says of itself what no render says");
        origin.provenance = provenance.dump();
        const auto integratorOf = [](const nlohmann::ordered_json &word) {
            const auto named = std::ranges::find(integratorNames, word.get<std::string>(),
                                                 [](const auto &name) { return std::string(name.first); });
            if (named == integratorNames.end())
                throw Error(ErrorKind::BadInput, fmt::format("there is no integrator {}", word.dump()));
            return named->second;
        };
        for (const nlohmann::ordered_json &word : json.at("layers"))
            origin.layers.push_back(integratorOf(word));
        const nlohmann::ordered_json &settings = provenance.at("settings");
        origin.integrator = integratorOf(settings.at("integrator"));
        origin.exposureStops = settings.at("exposure").get<double>();
        const nlohmann::ordered_json &device = provenance.at("device");
        origin.device = fmt::format("{}, {}", device.at("name").get<std::string>(),
                                    device.at("driver").get<std::string>());
        return origin;
    } catch (const nlohmann::json::exception &error) {
        throw Error(ErrorKind::BadInput, fmt::format("it does not say how it was made: {}", error.what()));
    }
}

} // namespace hyalite
