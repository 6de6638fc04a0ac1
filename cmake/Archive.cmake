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

# Takes the pictures of the gallery and the pages that show them out of a list of documents, and installs them as WebP, which
# has a tenth of the size.
function(archive_pictures list_name)
    set(pictures ${${list_name}})
    list(FILTER pictures INCLUDE REGEX "^assets/gallery/.*[.]png$")
    set(pages README.md assets/gallery/README.md)
    list(REMOVE_ITEM ${list_name} ${pictures} ${pages})
    set(${list_name} ${${list_name}} PARENT_SCOPE)
    set(folder ${PROJECT_BINARY_DIR}/documents)
    foreach(picture IN LISTS pictures)
        string(REPLACE .png .webp small ${folder}/${picture})
        get_filename_component(parent ${small} DIRECTORY)
        add_custom_command(OUTPUT ${small}
            COMMAND ${CMAKE_COMMAND} -E make_directory ${parent}
            COMMAND cwebp -quiet -q 75 ${PROJECT_SOURCE_DIR}/${picture} -o ${small}
            DEPENDS ${picture}
            VERBATIM)
        list(APPEND all_small ${small})
    endforeach()
    add_custom_target(archive_pictures ALL DEPENDS ${all_small})
    foreach(page IN LISTS pages)
        file(READ ${page} text)
        string(REPLACE ".png)" ".webp)" text "${text}")
        file(WRITE ${folder}/${page} "${text}")
    endforeach()
    install(DIRECTORY ${folder}/ DESTINATION ${CMAKE_INSTALL_DOCDIR})
endfunction()
