# hyalite_embed(TARGET NAMESPACE FILE...)
#
# Text files of the current folder as constants: `#include "FOLDER/NAMESPACE.h"`, such as "host/report/profile_page.h",
# has a std::string_view for each file in hyalite::core::NAMESPACE. Its name is that of the file in lowerCamelCase:
# pageScriptJs of page_script.js, whatever folder it is in. A file may have 64 KB, all that compilers promise of a string.
function(hyalite_embed target namespace)
    set(constants "")
    foreach(file IN LISTS ARGN)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
        file(READ ${file} text)
        get_filename_component(name ${file} NAME)
        string(REGEX MATCHALL "[A-Za-z0-9]+" words ${name})
        list(POP_FRONT words constant)
        foreach(word IN LISTS words)
            string(SUBSTRING ${word} 0 1 first)
            string(SUBSTRING ${word} 1 -1 others)
            string(TOUPPER ${first} first)
            string(APPEND constant ${first}${others})
        endforeach()
        string(APPEND constants "inline constexpr std::string_view ${constant} = R\"embedded(${text})embedded\";\n\n")
    endforeach()
    file(CONFIGURE OUTPUT ${namespace}.h @ONLY CONTENT [[
#pragma once

#include <string_view>

namespace hyalite::core::@namespace@ {

@constants@} // namespace hyalite::core::@namespace@
]])
    target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR})
endfunction()
