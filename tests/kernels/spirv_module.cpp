#include "tests/kernels/spirv_module.h"

#include <stdexcept>

namespace hyalite::testing {

namespace {

/// Four characters a word, the lowest byte first, ended by a zero.
std::string readString(std::span<const std::uint32_t> words) {
    std::string text;
    for (const std::uint32_t word : words) {
        for (std::uint32_t shift = 0; shift < 32; shift += 8) {
            const char letter = static_cast<char>(word >> shift & 0xFFu);
            if (letter == '\0')
                return text;
            text += letter;
        }
    }
    return text;
}

} // namespace

SpirvModule::SpirvModule(std::span<const std::uint32_t> words) {
    constexpr std::size_t headerWords = 5;
    if (words.size() < headerWords || words[0] != 0x07230203u)
        throw std::runtime_error("no SPIR-V header");
    std::map<std::uint32_t, std::string> names;
    std::string function;
    for (std::size_t at = headerWords; at < words.size();) {
        const std::size_t length = words[at] >> 16;
        if (length == 0 || at + length > words.size())
            throw std::runtime_error("a SPIR-V instruction of impossible length");
        const std::uint32_t opcode = words[at] & 0xFFFFu;
        const std::span<const std::uint32_t> operands = words.subspan(at + 1, length - 1);
        if (opcode == spirv::opName)
            names[operands[0]] = readString(operands.subspan(1));
        if (opcode == spirv::opDecorate && operands[1] == spirv::decorationNoContraction)
            uncontracted.insert(operands[0]);
        if (opcode == spirv::opFunction)
            function = names[operands[1]];
        instructions.push_back({opcode, operands, function});
        if (opcode == spirv::opFunctionEnd)
            function.clear();
        at += length;
    }
}

} // namespace hyalite::testing
