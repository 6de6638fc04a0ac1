# Writes OUTPUT, a header with a hash of the source FILES that decide what colour a pixel has. Lists are separated by "|",
# as a list of CMake does not survive a command line.
string(REPLACE "|" ";" FILES "${FILES}")
set(hashes)
foreach(file IN LISTS FILES)
    file(SHA256 ${file} hash)
    get_filename_component(name ${file} NAME)
    string(APPEND hashes "${name} ${hash}\n")
endforeach()
string(SHA256 hash "${hashes}")
string(SUBSTRING ${hash} 0 16 hash)
file(WRITE ${OUTPUT} "// What the kernels and their twin are made of.\n#pragma once\n\ninline constexpr const char *pixelSourcesHash = \"${hash}\";\n")
