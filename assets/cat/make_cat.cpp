// make_cat --triangles N --output FILE: writes the cat as a Wavefront OBJ file. Runs while Hyalite is built.
#include "assets/cat/cat_model.h"

#include <charconv>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <string_view>

namespace {

constexpr int exitUsage = 2;
constexpr int exitOutput = 7;

struct Options {
    std::size_t triangleCount = 0;
    std::string output;
};

std::optional<std::size_t> parseCount(std::string_view text) {
    std::size_t count = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), count);
    if (result.ec != std::errc() || result.ptr != text.data() + text.size())
        return std::nullopt;
    return count;
}

std::optional<Options> parseOptions(int argumentCount, char **arguments) {
    Options options;
    for (int i = 1; i < argumentCount; i += 2) {
        const std::string_view name = arguments[i];
        if (i + 1 == argumentCount) {
            std::fprintf(stderr, "make_cat: %s: a value is missing\n", arguments[i]);
            return std::nullopt;
        }
        if (name == "--triangles") {
            const std::optional<std::size_t> count = parseCount(arguments[i + 1]);
            if (!count || *count == 0) {
                std::fprintf(stderr, "make_cat: --triangles %s: not a positive number\n", arguments[i + 1]);
                return std::nullopt;
            }
            options.triangleCount = *count;
        } else if (name == "--output") {
            options.output = arguments[i + 1];
        } else {
            std::fprintf(stderr, "make_cat: %s: unknown option\n", arguments[i]);
            return std::nullopt;
        }
    }
    if (options.triangleCount == 0 || options.output.empty()) {
        std::fputs("usage: make_cat --triangles N --output FILE\n", stderr);
        return std::nullopt;
    }
    return options;
}

bool writeFile(const std::string &path, const std::string &text) {
    std::FILE *file = std::fopen(path.c_str(), "wb");
    if (file == nullptr)
        return false;
    const bool isWritten = std::fwrite(text.data(), 1, text.size(), file) == text.size();
    return std::fclose(file) == 0 && isWritten;
}

} // namespace

int main(int argumentCount, char **arguments) {
    const std::optional<Options> options = parseOptions(argumentCount, arguments);
    if (!options)
        return exitUsage;
    try {
        const hyalite::cat::Mesh mesh = hyalite::cat::makeCat(options->triangleCount);
        const std::string text = hyalite::cat::formatCat(mesh);
        if (writeFile(options->output, text))
            return 0;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "make_cat: %s\n", error.what());
        return exitUsage;
    }
    std::fprintf(stderr, "make_cat: %s: cannot be written\n", options->output.c_str());
    return exitOutput;
}
