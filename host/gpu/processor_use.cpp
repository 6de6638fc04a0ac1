#include "host/gpu/processor_use.h"

#include "host/base/clean_text.h"
#include "host/base/error.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

namespace hyalite::core::gpu {

bool hasWideVectors() {
    // The extensions that compilers assume together.
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
#else
    return false;
#endif
}

void requireVectorWidth() {
    constexpr const char *width = "LP_NATIVE_VECTOR_WIDTH";
    const char *const bits = std::getenv(width);
    const std::string_view given = bits != nullptr ? bits : "";
    if (!given.empty() && given != "128" && given != "256" && given != "512")
        throw Error(ErrorKind::Usage, fmt::format("{}: found \"{}\"; allowed: 128, 256 or 512, or unset it",
                                                  width, excerpt(given)));
}

} // namespace hyalite::core::gpu
