# HYALITE_ARCHIVE: what goes into the archive beside the program (cmake/archive.sh).
set(libraries lib/hyalite)
set_target_properties(hyalite PROPERTIES INSTALL_RPATH "$ORIGIN/../${libraries}")
set(map ${PROJECT_BINARY_DIR}/hyalite.map)
target_link_options(hyalite PRIVATE -Wl,-Map=${map})

# The loader, which looks for drivers where this system's does: in /etc, /usr/local/share and /usr/share, in the user's
# folders, and by its variables.
get_filename_component(loader ${Vulkan_LIBRARY} REALPATH)
install(PROGRAMS ${loader} DESTINATION ${libraries} RENAME libvulkan.so.1)
set(copied ${loader})

set(HYALITE_LAVAPIPE_FOLDER "" CACHE PATH "A folder that cmake/lavapipe.sh has made, to go into the archive")
if(HYALITE_LAVAPIPE_FOLDER)
    install(DIRECTORY ${HYALITE_LAVAPIPE_FOLDER}/ DESTINATION ${libraries}/lavapipe USE_SOURCE_PERMISSIONS)
    file(STRINGS ${HYALITE_LAVAPIPE_FOLDER}.sources sources)
    list(APPEND copied ${sources})
endif()

set(licences ${PROJECT_BINARY_DIR}/licences)
add_custom_target(licences ALL
    COMMAND ${PROJECT_SOURCE_DIR}/cmake/licences.sh ${PROJECT_BINARY_DIR} ${map} ${licences} ${copied}
    COMMENT "Gathering licences"
    VERBATIM)
add_dependencies(licences hyalite)
install(DIRECTORY ${licences}/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/licences)
