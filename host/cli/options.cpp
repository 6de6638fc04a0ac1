#include "host/cli/options.h"

#include "host/base/atomic_file.h"
#include "host/base/clean_text.h"
#include "host/base/message.h"
#include "host/base/standard_stream.h"
#include "host/image/image_file.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <system_error>

namespace hyalite::core {

namespace {

/// `text` as a number, without blanks around it and a leading plus sign. Empty unless all of it is a number.
template <class Number> std::optional<Number> parse(std::string_view text) {
    constexpr std::string_view blanks = " \t";
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    text.remove_suffix(text.size() - (text.find_last_not_of(blanks) + 1)); // npos + 1 is 0
    if (text.starts_with('+') && !text.starts_with("+-"))
        text.remove_prefix(1);
    Number number{};
    const char *end = text.data() + text.size();
    const std::from_chars_result result = std::from_chars(text.data(), end, number);
    return result.ec == std::errc{} && result.ptr == end ? std::optional(number) : std::nullopt;
}

/// The canonical path of a file: absolute, without links. The file need not exist, even as the target of a link.
std::filesystem::path canonicalPath(const std::string &path) {
    std::error_code error;
    const std::filesystem::path target = followLinks(std::filesystem::absolute(path, error));
    const std::filesystem::path canonical = std::filesystem::weakly_canonical(target, error);
    return error ? std::filesystem::path(path) : canonical; // an invalid path is refused when it is opened
}

bool isSameFile(const std::string &a, const std::string &b) {
    if (isStandardStream(a) || isStandardStream(b))
        return isStandardStream(a) && isStandardStream(b);
    std::error_code error; // of files that do not exist
    return canonicalPath(a) == canonicalPath(b) || std::filesystem::equivalent(a, b, error);
}

} // namespace

void refuseValue(const std::string &option, std::string_view found, std::string_view allowed) {
    throw Error(ErrorKind::Usage, fmt::format("{}: {}", option, refusalText(found, allowed)));
}

double readNumber(const std::string &option, std::string_view text, const Interval &allowed) {
    const std::optional<double> number = parse<double>(text);
    if (!number || !allowed.contains(*number))
        refuseValue(option, text, "a number " + allowed.text());
    return *number;
}

std::int64_t readWholeNumber(const std::string &option, std::string_view text, const Interval &allowed) {
    const std::optional<std::int64_t> number = parse<std::int64_t>(text);
    if (!number || !allowed.contains(static_cast<double>(*number)))
        refuseValue(option, text, "a whole number " + allowed.text());
    return *number;
}

CLI::Option *addWord(CLI::App &command, const std::string &name, std::string &word, std::string_view allowed,
                     const std::string &typeName, const std::string &help) {
    const auto read = [name, &word, allowed](const CLI::results_t &words) {
        if (words.front().empty())
            refuseValue(name, "", allowed);
        word = words.front();
        return true;
    };
    return command.add_option(name, CLI::callback_t(read), help)->type_name(typeName);
}

CLI::Option *addOutput(CLI::App &command, const std::string &name, std::string &path,
                       const std::string &typeName, const std::string &help) {
    return addWord(command, name, path, "the name of a file, or - for standard output", typeName, help)
        ->each([](const std::string &word) {
            if (isStandardStream(word))
                resultStream = stderr;
        });
}

CLI::Option *addFile(CLI::App &command, const std::string &name, std::string &path,
                     const std::string &typeName, const std::string &help) {
    return addWord(command, name, path, "the name of a file", typeName, help);
}

CLI::Option *addPaths(CLI::App &command, const std::string &name, std::vector<std::filesystem::path> &paths,
                      const std::string &help) {
    const auto read = [name, &paths](const CLI::results_t &words) {
        for (const std::string &word : words) {
            std::error_code error;
            if (!std::filesystem::exists(word, error))
                refuseValue(name, word, "a file or folder that exists");
            paths.emplace_back(word);
        }
        return true;
    };
    return command.add_option(name, CLI::callback_t(read), help)
        ->type_name("PATH")
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

CLI::Option *addTimeLimit(CLI::App &command, std::optional<double> &seconds, const std::string &help) {
    return addNumber(command, "--time-limit", seconds, anySeconds,
                     help + "; loading and building do not count")
        ->type_name("SECONDS");
}

CLI::Option *addToneOption(CLI::App &command, std::optional<ToneCurve> &curve) {
    return addChoice(command, "--tone", curve, toneCurveNames,
                     "tone curve of a PNG: gamma (2.2, the default) and srgb clip bright colours, aces and "
                     "agx roll them off as film does");
}

void addFileOptions(CLI::App &command, FileRequest &file) {
    addToneOption(command, file.tone);
    command.add_flag(
        "--half", file.isHalf,
        "store colours, alpha, albedo and ao of an .exr as 16-bit floats, at most 65504; the other "
        "layers stay exact");
    addChoice(command, "--exr-compression", file.compression, exrCompressionNames,
              "compression of an .exr: none to piz keep every bit; pxr24, b44, b44a, dwaa and dwab are lossy")
        ->type_name("NAME")
        ->default_str("zip");
}

std::string_view givenOption(const FileRequest &file) {
    return file.tone ? "--tone" : file.isHalf ? "--half" : file.compression ? "--exr-compression" : "";
}

void requireFileOptions(const FileRequest &file, ImageFormat format, const std::string &output) {
    if (file.tone && format != ImageFormat::Png)
        throw Error(ErrorKind::Usage,
                    fmt::format("--tone is for .png files: --output is {}, which holds radiance as it is; "
                                "`hyalite tonemap` makes a PNG of it",
                                output));
    if (const std::string_view option = givenOption({{}, file.isHalf, file.compression});
        !option.empty() && format != ImageFormat::Exr)
        throw Error(ErrorKind::Usage, fmt::format("{} is for .exr files: --output is {}", option, output));
}

void requireDistinctFiles(const std::vector<NamedFile> &outputs, const std::vector<std::string> &inputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const NamedFile &output = outputs[i];
        if (output.path.empty())
            continue;
        for (const std::string &input : inputs)
            if (!input.empty() && !isStandardStream(input) && isSameFile(output.path, input))
                throw Error(
                    ErrorKind::Usage,
                    fmt::format("{} {}: this would overwrite {}, which is an input; name another output",
                                output.option, output.path, input));
        for (std::size_t j = 0; j < i; ++j)
            if (!outputs[j].path.empty() && isSameFile(output.path, outputs[j].path))
                throw Error(ErrorKind::Usage,
                            fmt::format("{} {} and {} {} name the same file; name two", outputs[j].option,
                                        outputs[j].path, output.option, output.path));
    }
}

void addDisplayOption(CLI::App &command, std::string &address) {
    command
        .add_option(
            "--display", address,
            "show the picture in tev, or a viewer with its protocol, as its tiles finish; the port is 14158 "
            "unless it is given")
        ->type_name("HOST[:PORT]");
}

} // namespace hyalite::core
