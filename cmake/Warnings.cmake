# Warnings, on our own targets only. They are errors for developers and in CI, and never on a user's machine, whose
# compiler or libraries may be newer than ours.
option(HYALITE_WARNINGS_AS_ERRORS "Stop the build at a compiler warning" OFF)

function(hyalite_warnings target)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
    if(HYALITE_WARNINGS_AS_ERRORS)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
        # GCC 12 warns about its own std::string and initializer lists (GCC bugs 105651, 105562).
        target_compile_options(${target} PRIVATE -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow)
        if(HYALITE_SANITIZE) # and then about its own std::regex, too
            target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
        endif()
    endif()
endfunction()
