if(HYALITE_SANITIZE)
    add_library(hyalite_leaks OBJECT ${PROJECT_SOURCE_DIR}/tests/leaks.cpp)
endif()

# hyalite_library(TARGET)
#
# What all libraries of host/ share: includes by their path from the source folder, such as "host/scene/scene.h",
# warnings, and code for a shared library, which shows only what says so.
function(hyalite_library target)
    target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
    set_target_properties(${target} PROPERTIES
        POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    hyalite_warnings(${target})
    if(HYALITE_SANITIZE)
        target_sources(${target} INTERFACE $<TARGET_OBJECTS:hyalite_leaks>)
    endif()
endfunction()

# hyalite_read_alone(FILE...)
#
# Where several sources are compiled as one (CMAKE_UNITY_BUILD), these are not among them.
function(hyalite_read_alone)
    set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# For targets that take no time when they run, and much when they are compiled: twice as fast by little optimisation.
function(hyalite_compile_fast target)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()
