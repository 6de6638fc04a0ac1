# hyalite_kernel(TARGET KERNEL VARIABLE DEFINITIONS...)
#
# Compiles shaders/kernels/KERNEL.comp to SPIR-V 1.3 at build time and embeds it into TARGET: a header VARIABLE.h with the
# array `VARIABLE`. It is optimised (-Os), as drivers otherwise take up to twice as long to build a pipeline. KERNEL may
# also be a path ending in .comp, from the source folder. Dependency files follow every include, so an edited shader is
# always built anew. The target property HYALITE_KERNELS lists all variables. With UNOPTIMISED among the DEFINITIONS
# functions stay as they are written, for tests that look at them.
find_program(GLSLANG_VALIDATOR glslangValidator)
if(NOT GLSLANG_VALIDATOR)
    message(FATAL_ERROR "glslangValidator is missing: install the package glslang-tools")
endif()

# glslang 12 may follow `precise` round and round until memory is full (see shaders/math/vector.glsl): better an error.
set(GLSLANG_BOUNDED sh -c "ulimit -v 2000000 && exec \"$0\" \"$@\"" ${GLSLANG_VALIDATOR})

function(hyalite_kernel target kernel variable)
    if(NOT kernel MATCHES "\\.comp$")
        set(kernel shaders/kernels/${kernel}.comp)
    endif()
    set(source ${PROJECT_SOURCE_DIR}/${kernel})
    set(folder ${PROJECT_BINARY_DIR}/kernels)
    set(header ${folder}/${variable}.h)
    file(MAKE_DIRECTORY ${folder})
    set(definitions ${ARGN})
    set(optimise -Os)
    if("UNOPTIMISED" IN_LIST definitions)
        list(REMOVE_ITEM definitions UNOPTIMISED)
        set(optimise)
    endif()
    list(TRANSFORM definitions PREPEND -D)
    add_custom_command(
        OUTPUT ${header}
        COMMAND ${GLSLANG_BOUNDED} --quiet ${optimise} -V --target-env vulkan1.1 ${definitions} -I${PROJECT_SOURCE_DIR} -I${folder}
                --depfile ${header}.d --vn ${variable} -o ${header} ${source}
        DEPENDS ${source}
        DEPFILE ${header}.d
        COMMENT "Compiling ${kernel} to ${variable}"
        VERBATIM)
    target_sources(${target} PRIVATE ${header})
    target_include_directories(${target} PRIVATE ${folder})
    set_property(TARGET ${target} APPEND PROPERTY HYALITE_KERNELS ${variable})
endfunction()

# hyalite_kernel_list(TARGET FUNCTION)
#
# Defines `std::span<const hyalite::EmbeddedKernel> hyalite::FUNCTION()`, all kernels that were embedded into the target so
# far.
function(hyalite_kernel_list target function)
    set(kernel_includes)
    set(kernel_entries)
    get_target_property(kernels ${target} HYALITE_KERNELS)
    foreach(kernel IN LISTS kernels)
        string(APPEND kernel_includes "#include \"${kernel}.h\"\n")
        string(APPEND kernel_entries "        {\"${kernel}\", ${kernel}},\n")
    endforeach()
    set(list ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/kernel_list.cpp.in ${list} @ONLY)
    target_sources(${target} PRIVATE ${list})
endfunction()

# hyalite_pixel_sources(TARGET HEADER FILES...)
#
# Makes a header with `pixelSources`, a hash of the files.
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
