# How everything is compiled, ours and what it is tested with.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release)
endif()

# The two renderers agree to the bit only if nothing is contracted to fused operations. And GCC 12 at -O3 drops the
# rounding of double -> float -> double where it vectorises straight-line code (box_test.cpp found it).
add_compile_options(-ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    add_compile_options(-fno-tree-slp-vectorize)
endif()

option(HYALITE_SANITIZE "Build with the address and undefined behaviour sanitizers" OFF)
if(HYALITE_SANITIZE)
    # With all assertions, the standard library's as well, whatever the build type says.
    add_compile_options(-O1 -g1 -UNDEBUG -D_GLIBCXX_ASSERTIONS
                        -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
    add_link_options(-fsanitize=address,undefined)
endif()
