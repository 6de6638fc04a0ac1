// SPIR-V as a sequence of instructions: sections 2.3 and 2.4 of its specification.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <vector>

#define SPV_ENABLE_UTILITY_CODE
#include <spirv/unified1/spirv.hpp11>

namespace hyalite::core::gpu {

constexpr std::size_t spirvHeaderWords = 5;
constexpr std::size_t spirvBoundWord = 3; // in the header: an upper bound of all ids

struct SpirvInstruction {
    std::span<const std::uint32_t> words; ///< the first one holds the opcode and the number of words

    [[nodiscard]] spv::Op opcode() const { return static_cast<spv::Op>(words[0] & spv::OpCodeMask); }

    /// The id of the result, or 0 (not a valid id) if there is none.
    [[nodiscard]] std::uint32_t result() const {
        bool hasResult = false;
        bool hasType = false;
        spv::HasResultAndType(opcode(), &hasResult, &hasType);
        return hasResult ? words[hasType ? 2 : 1] : 0;
    }
};

/// All instructions of the module `spirv`, which must outlive them. Throws std::invalid_argument unless it is a header
/// followed by whole instructions.
[[nodiscard]] inline std::vector<SpirvInstruction> instructionsOf(std::span<const std::uint32_t> spirv) {
    if (spirv.size() < spirvHeaderWords || spirv[0] != spv::MagicNumber)
        throw std::invalid_argument("no SPIR-V header");
    std::vector<SpirvInstruction> instructions;
    for (std::size_t at = spirvHeaderWords; at < spirv.size();) {
        const std::size_t length = spirv[at] >> spv::WordCountShift;
        if (length == 0 || at + length > spirv.size())
            throw std::invalid_argument("a SPIR-V instruction of impossible length");
        instructions.push_back({spirv.subspan(at, length)});
        at += length;
    }
    return instructions;
}

/// Appends an instruction with these operands.
inline void append(std::vector<std::uint32_t> &words, spv::Op opcode,
                   std::span<const std::uint32_t> operands) {
    const auto length = static_cast<std::uint32_t>(1 + operands.size());
    words.push_back(length << spv::WordCountShift | static_cast<std::uint32_t>(opcode));
    words.insert(words.end(), operands.begin(), operands.end());
}

inline void append(std::vector<std::uint32_t> &words, spv::Op opcode,
                   std::initializer_list<std::uint32_t> operands) {
    append(words, opcode, std::span(operands.begin(), operands.size()));
}

} // namespace hyalite::core::gpu
