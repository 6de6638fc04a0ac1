# From shaders/*/*.comp to SPIR-V in the program, packed:
#
#   glslangValidator -> kernel_tool decorate -> spirv-opt -> kernel_tool embed, which numbers the ids anew
#
# Every float operation is marked NoContraction before anything optimises. The passes of spirv-opt inline all functions,
# keep variables in registers and drop what is dead: without them drivers take up to twice as long to build a pipeline.
find_program(GLSLANG_VALIDATOR glslangValidator)
if(NOT GLSLANG_VALIDATOR)
    message(FATAL_ERROR "glslangValidator is missing: install the package glslang-tools")
endif()
find_program(SPIRV_OPT spirv-opt)
if(NOT SPIRV_OPT)
    message(FATAL_ERROR "spirv-opt is missing: install the package spirv-tools")
endif()

set(HYALITE_KERNEL_PASSES
    --eliminate-dead-branches --merge-return --inline-entry-points-exhaustive --scalar-replacement
    --convert-local-access-chains --eliminate-local-single-block --eliminate-local-single-store --simplify-instructions
    --eliminate-dead-code-aggressive --eliminate-dead-branches --merge-blocks --ssa-rewrite --if-conversion
    --simplify-instructions --eliminate-dead-code-aggressive --vector-dce --redundancy-elimination
    --eliminate-dead-code-aggressive)

add_executable(kernel_tool ${PROJECT_SOURCE_DIR}/cmake/kernel_tool.cpp ${PROJECT_SOURCE_DIR}/host/base/hash.cpp
               ${PROJECT_SOURCE_DIR}/host/gpu/spirv/decorate.cpp ${PROJECT_SOURCE_DIR}/host/gpu/spirv/renumber.cpp)
target_include_directories(kernel_tool PRIVATE ${PROJECT_SOURCE_DIR})
target_include_directories(kernel_tool SYSTEM PRIVATE ${XXHASH_INCLUDE_DIR})
target_link_libraries(kernel_tool PRIVATE SPIRV-Headers::SPIRV-Headers fmt::fmt ${ZSTD_LIBRARY} ${XXHASH_LIBRARY})
hyalite_warnings(kernel_tool)
hyalite_compile_fast(kernel_tool)

foreach(tool IN ITEMS glsl_to_cpp glsl_probes layout_macros)
    add_executable(${tool} ${PROJECT_SOURCE_DIR}/cmake/${tool}.cpp ${PROJECT_SOURCE_DIR}/cmake/glsl_reader.cpp
                   ${PROJECT_SOURCE_DIR}/cmake/leaf_declarations.cpp)
    target_include_directories(${tool} PRIVATE ${PROJECT_SOURCE_DIR})
    hyalite_warnings(${tool})
    hyalite_compile_fast(${tool})
endforeach()

# The fields of the records, for kernels and tests.
add_custom_command(
    OUTPUT ${PROJECT_BINARY_DIR}/kernels/layout_macros.h
    COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/kernels
    COMMAND layout_macros ${PROJECT_SOURCE_DIR}/shaders/layout/layout.h ${PROJECT_BINARY_DIR}/kernels/layout_macros.h
    DEPENDS layout_macros ${PROJECT_SOURCE_DIR}/shaders/layout/layout.h
    VERBATIM)
add_custom_target(layout_macros_header DEPENDS ${PROJECT_BINARY_DIR}/kernels/layout_macros.h)

# hyalite_kernel(TARGET VARIABLE SOURCE [UNOPTIMISED] [INCLUDES FOLDER] [DEFINITIONS NAME=VALUE...])
#
# Embeds SOURCE, a path, into TARGET as VARIABLE, a KernelWords of SPIR-V 1.3, in a header VARIABLE.h. An edited shader
# is always built anew. With UNOPTIMISED functions stay as they are written, for tests that look at them. Includes are
# looked for in FOLDER first. The target property HYALITE_KERNELS lists all variables, HYALITE_DEFINITIONS_<VARIABLE>
# the definitions.
function(hyalite_kernel target variable source)
    cmake_parse_arguments(PARSE_ARGV 3 kernel UNOPTIMISED INCLUDES DEFINITIONS)
    set(folder ${PROJECT_BINARY_DIR}/kernels)
    file(MAKE_DIRECTORY ${folder})
    set(passes ${HYALITE_KERNEL_PASSES})
    if(kernel_UNOPTIMISED)
        set(passes)
    endif()
    set(includes ${kernel_INCLUDES} ${PROJECT_SOURCE_DIR} ${folder})
    list(TRANSFORM includes PREPEND -I)
    list(JOIN kernel_DEFINITIONS " " definitions)
    set_property(TARGET ${target} PROPERTY HYALITE_DEFINITIONS_${variable} "${definitions}")
    list(TRANSFORM kernel_DEFINITIONS PREPEND -D)
    set(base ${folder}/${variable})
    set(language)
    if(definitions MATCHES "TRAVERSAL_RAY_QUERY=1") # which GLSL has from 4.60 on
        set(language --glsl-version 460)
    endif()
    add_custom_command(
        OUTPUT ${base}.glslang.spv
        COMMAND ${GLSLANG_VALIDATOR} --quiet -V --target-env vulkan1.1 ${language} ${kernel_DEFINITIONS} ${includes}
                --depfile ${base}.d -o ${base}.glslang.spv ${source}
        DEPENDS ${source} layout_macros_header
        DEPFILE ${base}.d
        COMMENT "Compiling ${variable}"
        VERBATIM)
    add_custom_command(
        OUTPUT ${base}.h
        COMMAND kernel_tool decorate ${base}.glslang.spv ${base}.exact.spv
        COMMAND ${SPIRV_OPT} --target-env=vulkan1.1 ${passes} ${base}.exact.spv -o ${base}.spv
        COMMAND kernel_tool embed ${base}.spv ${variable} ${base}.h
        DEPENDS ${base}.glslang.spv kernel_tool
        COMMENT "Optimising ${variable}"
        VERBATIM)
    target_sources(${target} PRIVATE ${base}.h)
    target_include_directories(${target} PRIVATE ${folder})
    set_property(TARGET ${target} APPEND PROPERTY HYALITE_KERNELS ${variable})
endfunction()

# hyalite_kernel_list(TARGET FUNCTION)
#
# Defines `std::span<const hyalite::core::EmbeddedKernel> hyalite::core::FUNCTION()`, all kernels that were embedded into
# the target so far.
function(hyalite_kernel_list target function)
    set(kernel_includes)
    set(kernel_entries)
    get_target_property(kernels ${target} HYALITE_KERNELS)
    foreach(kernel IN LISTS kernels)
        string(APPEND kernel_includes "#include \"${kernel}.h\"\n")
        get_property(definitions TARGET ${target} PROPERTY HYALITE_DEFINITIONS_${kernel})
        string(APPEND kernel_entries "        {\"${kernel}\", \"${definitions}\", ${kernel}, ${kernel}Hash},\n")
    endforeach()
    set(list ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/kernel_list.cpp.in ${list} @ONLY)
    target_sources(${target} PRIVATE ${list})
endfunction()

# hyalite_pixel_sources(TARGET HEADER FILES...)
#
# Makes a header with `pixelSourcesHash`, a hash of the files.
function(hyalite_pixel_sources target header)
    set(output ${PROJECT_BINARY_DIR}/kernels/${header})
    list(JOIN ARGN "|" files)
    add_custom_command(
        OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DFILES=${files} -P ${PROJECT_SOURCE_DIR}/cmake/PixelSources.cmake
        DEPENDS ${ARGN} ${PROJECT_SOURCE_DIR}/cmake/PixelSources.cmake
        VERBATIM)
    target_sources(${target} PRIVATE ${output})
endfunction()

# hyalite_leaf_functions(TARGET HEADER LEAVES)
#
# Compiles the leaf functions that the shader LEAVES includes to C++ for TARGET, an interface library
# (cmake/glsl_to_cpp.cpp).
set(HYALITE_LEAVES_ROOT ${PROJECT_SOURCE_DIR} CACHE PATH "Folder whose shaders/ the CPU's leaf functions are read from")
mark_as_advanced(HYALITE_LEAVES_ROOT)
function(hyalite_leaf_functions target header leaves)
    set(output ${PROJECT_BINARY_DIR}/kernels/${header})
    set(layout ${PROJECT_SOURCE_DIR}/shaders/layout/layout.h)
    set(leaves ${HYALITE_LEAVES_ROOT}/${leaves})
    file(GLOB_RECURSE shaders CONFIGURE_DEPENDS ${HYALITE_LEAVES_ROOT}/shaders/*.glsl)
    add_custom_command(
        OUTPUT ${output}
        COMMAND glsl_to_cpp ${HYALITE_LEAVES_ROOT} ${layout} ${leaves} ${output}
        DEPENDS glsl_to_cpp ${layout} ${shaders}
        COMMENT "Compiling leaf functions to C++"
        VERBATIM)
    add_custom_target(${target}_header DEPENDS ${output})
    add_dependencies(${target} ${target}_header)
    target_include_directories(${target} SYSTEM INTERFACE ${PROJECT_BINARY_DIR}/kernels)
endfunction()

# hyalite_leaf_probes(TARGET LEAVES)
#
# Makes a probe of each leaf function that LEAVES includes, in GLSL and in C++, for TARGET: leaf_probes.glsl, leaf_words.h
# and leaf_probe_table.h (cmake/glsl_probes.cpp).
function(hyalite_leaf_probes target leaves)
    set(layout ${PROJECT_SOURCE_DIR}/shaders/layout/layout.h)
    file(GLOB_RECURSE shaders CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/shaders/*.glsl)
    set(outputs leaf_probes.glsl leaf_words.h leaf_probe_table.h)
    list(TRANSFORM outputs PREPEND ${PROJECT_BINARY_DIR}/kernels/)
    add_custom_command(
        OUTPUT ${outputs}
        COMMAND glsl_probes ${PROJECT_SOURCE_DIR} ${layout} ${PROJECT_SOURCE_DIR}/${leaves} ${outputs}
        DEPENDS glsl_probes ${layout} ${shaders}
        COMMENT "Making probes of leaf functions"
        VERBATIM)
    target_sources(${target} PRIVATE ${outputs})
endfunction()
