# What fuzzing needs of the compiler, and how everything is compiled for it: with libFuzzer's coverage, the address and
# undefined behaviour sanitizers, and all assertions, the standard library's as well.
include(CheckCXXSourceCompiles)

set(fuzzing_packages "clang-14 libclang-rt-14-dev libomp-14-dev")
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL Clang)
    message(FATAL_ERROR "HYALITE_FUZZ needs Clang, for its libFuzzer. Install ${fuzzing_packages}, and use the preset "
                        "fuzz, or -DCMAKE_CXX_COMPILER=clang++-14")
endif()

set(CMAKE_REQUIRED_FLAGS "-fsanitize=fuzzer,address,undefined -fopenmp")
check_cxx_source_compiles("
    #include <omp.h>
    #include <cstddef>
    #include <cstdint>
    extern \"C\" int LLVMFuzzerTestOneInput(const std::uint8_t *, std::size_t) { return omp_in_parallel(); }"
    HYALITE_CAN_FUZZ)
unset(CMAKE_REQUIRED_FLAGS)
if(NOT HYALITE_CAN_FUZZ)
    unset(HYALITE_CAN_FUZZ CACHE) # or the next run would not look again
    message(FATAL_ERROR "${CMAKE_CXX_COMPILER} has no libFuzzer or no OpenMP. Install ${fuzzing_packages}")
endif()

add_compile_options(-O1 -g1 -UNDEBUG -D_GLIBCXX_ASSERTIONS -fno-omit-frame-pointer
                    -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined)
add_link_options(-fsanitize=address,undefined)
