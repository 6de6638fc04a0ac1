// Steps of the build between glslang and the program, on files of SPIR-V (cmake/Shaders.cmake):
//
//   kernel_tool decorate IN.spv OUT.spv       marks every float operation NoContraction; refuses what has no fixed rounding
//   kernel_tool embed IN.spv VARIABLE OUT.h   writes it for C++, packed, its ids without gaps, and its hash
#include "host/base/hash.h"
#include "host/gpu/spirv/decorate.h"
#include "host/gpu/spirv/renumber.h"

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <zstd.h>

namespace {

std::vector<std::uint32_t> read(const std::string &path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> bytes(std::istreambuf_iterator<char>(file), {});
    if (!file || bytes.size() % sizeof(std::uint32_t) != 0)
        throw std::runtime_error("no words of SPIR-V can be read");
    std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

void write(const std::string &path, const std::string &bytes) {
    std::ofstream file(path, std::ios::binary);
    file << bytes;
    if (!file.flush())
        throw std::runtime_error("cannot write " + path);
}

void decorate(const std::string &from, const std::string &to) {
    const std::vector<std::uint32_t> words = hyalite::core::gpu::decorateNoContraction(read(from));
    write(to, std::string(reinterpret_cast<const char *>(words.data()), words.size() * sizeof(words[0])));
}

/// As KernelWords says; zeros follow to the end of the last word.
std::vector<std::uint32_t> pack(const std::vector<std::uint32_t> &words) {
    std::vector<std::uint8_t> planes;
    planes.reserve(words.size() * sizeof(words[0]));
    for (int shift = 0; shift < 32; shift += 8)
        for (const std::uint32_t word : words)
            planes.push_back(static_cast<std::uint8_t>(word >> shift));
    std::vector<std::uint32_t> packed(ZSTD_compressBound(planes.size()) / sizeof(words[0]) + 1);
    const std::size_t size = ZSTD_compress(packed.data(), packed.size() * sizeof(packed[0]), planes.data(),
                                           planes.size(), ZSTD_maxCLevel());
    if (ZSTD_isError(size) != 0)
        throw std::runtime_error(std::string("zstd cannot pack it: ") + ZSTD_getErrorName(size));
    packed.resize((size + sizeof(packed[0]) - 1) / sizeof(packed[0]));
    return packed;
}

void embed(const std::string &from, const std::string &variable, const std::string &to) {
    const std::vector<std::uint32_t> words = hyalite::core::gpu::renumber(read(from));
    const std::string hash =
        hyalite::core::hashText(hyalite::core::hashBytes(std::as_bytes(std::span(words))));
    std::string text = "#pragma once\n#include \"shaders/embedded_kernels.h\"\n\nconst std::uint64_t " +
                       variable + "Hash = 0x" + hash + ";\nstatic const std::uint32_t " + variable +
                       "Packed[] = {";
    std::size_t count = 0;
    const std::vector<std::uint32_t> packed = pack(words);
    for (const std::uint32_t word : packed) {
        char number[32];
        std::snprintf(number, sizeof(number), "%s0x%08x,", count++ % 8 == 0 ? "\n    " : " ", word);
        text += number;
    }
    write(to, text + "\n};\nconst hyalite::core::KernelWords " + variable + "(" + variable + "Packed, " +
                  std::to_string(words.size()) + ");\n");
}

} // namespace

int main(int argumentCount, char **arguments) {
    const std::vector<std::string> words(arguments + 1, arguments + argumentCount);
    try {
        if (words.size() == 3 && words[0] == "decorate")
            decorate(words[1], words[2]);
        else if (words.size() == 4 && words[0] == "embed")
            embed(words[1], words[2], words[3]);
        else
            throw std::runtime_error("kernel_tool decorate IN OUT | kernel_tool embed IN VARIABLE OUT");
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s: %s\n", words.size() > 1 ? words[1].c_str() : "kernel_tool", error.what());
        return 1;
    }
    return 0;
}
