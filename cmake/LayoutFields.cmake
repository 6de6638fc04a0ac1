# hyalite_layout_fields(HEADER)
#
# Writes a header, for C++ and GLSL, that knows the structs of shaders/layout/layout.h: FIELDS_X(G, r) is G(r.field) for each
# field of struct X, in order, and layoutStructCount tells how many structs there are.
function(hyalite_layout_fields header)
    set(layout ${PROJECT_SOURCE_DIR}/shaders/layout/layout.h)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${layout})
    file(READ ${layout} text)
    string(REGEX REPLACE "//[^\n]*" "" text "${text}")
    string(REPLACE ";" "," text "${text}") # lists of CMake are made with semicolons
    string(REGEX MATCHALL "struct [A-Za-z]+ {[^}]*}" structs "${text}")
    list(LENGTH structs count)
    set(macros "const uint layoutStructCount = ${count}u;\n")
    foreach(struct IN LISTS structs)
        string(REGEX REPLACE "struct ([A-Za-z]+) {.*" "\\1" name "${struct}")
        string(REGEX MATCHALL "[A-Za-z0-9]+ ?," fields "${struct}")
        list(TRANSFORM fields REPLACE " ?," "")
        list(TRANSFORM fields REPLACE "(.+)" "G(r.\\1)")
        list(JOIN fields " " fields)
        string(APPEND macros "#define FIELDS_${name}(G, r) ${fields}\n")
    endforeach()
    file(CONFIGURE OUTPUT ${header} CONTENT "// Made from shaders/layout/layout.h by cmake/LayoutFields.cmake.\n${macros}" @ONLY)
endfunction()
