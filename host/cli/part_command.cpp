#include "host/cli/part_command.h"

#include "host/base/clean_text.h"
#include "host/base/shell.h"

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

namespace hyalite::core {

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
    for (std::size_t i = 0; i < words.size(); ++i)
        if (words[i] == option && i + 1 < words.size())
            words[i + 1] = replace(words[i + 1]);
        else if (words[i].starts_with(std::string(option) + "="))
            words[i] = fmt::format("{}={}", option, replace(words[i].substr(option.size() + 1)));
        else if (option.size() == 2 && words[i].starts_with(option) && words[i].size() > 2) // -oFILE
            words[i] = fmt::format("{}{}", option, replace(words[i].substr(2)));
}

} // namespace

std::string commandFor(const PartOrigin &origin, const Part &own, const Part &part) {
    std::vector<std::string> again = origin.words;
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

} // namespace hyalite::core
