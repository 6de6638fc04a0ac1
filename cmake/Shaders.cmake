# hyalite_kernel(TARGET KERNEL VARIABLE DEFINITIONS...)
#
# Compiles shaders/KERNEL.comp to SPIR-V 1.3 at build time and embeds it into TARGET: a header VARIABLE.h with the
# array `VARIABLE`. Dependency files follow every include, so an edited shader is always built anew.
find_program(GLSLANG_VALIDATOR glslangValidator)
if(NOT GLSLANG_VALIDATOR)
    message(FATAL_ERROR "glslangValidator is missing: install the package glslang-tools")
endif()

function(hyalite_kernel target kernel variable)
    set(source ${PROJECT_SOURCE_DIR}/shaders/${kernel}.comp)
    set(folder ${PROJECT_BINARY_DIR}/kernels)
    set(header ${folder}/${variable}.h)
    file(MAKE_DIRECTORY ${folder})
    list(TRANSFORM ARGN PREPEND -D OUTPUT_VARIABLE definitions)
    add_custom_command(
        OUTPUT ${header}
        COMMAND ${GLSLANG_VALIDATOR} --quiet -V --target-env vulkan1.1 ${definitions} -I${PROJECT_SOURCE_DIR}
                --depfile ${header}.d --vn ${variable} -o ${header} ${source}
        DEPENDS ${source}
        DEPFILE ${header}.d
        COMMENT "Compiling ${kernel}.comp to ${variable}"
        VERBATIM)
    target_sources(${target} PRIVATE ${header})
    target_include_directories(${target} PRIVATE ${folder})
endfunction()
