#!/usr/bin/env bash
# Gathers the licences of all that a program is made of:
#
#   cmake/licences.sh BUILD MAP FOLDER FILE...
#
# BUILD is a build folder, MAP what the linker wrote of its program, FOLDER is made anew, and FILE... are libraries that go
# beside the program. A licence is /usr/share/doc/PACKAGE/copyright of Debian, or that of a source that
# cmake/static_libraries.sh built, for each package that a linked object, an included header or a FILE is of. FOLDER/common
# has the texts that they refer to, and FOLDER/packages.txt versions.
set -euo pipefail

build=$1 map=$2 folder=$3
shift 3
rm -rf "$folder"
mkdir -p "$folder/common"
cd "$build/host" # names in the map are relative to where the program was linked

# Linked: the files of the map. Included: those of the compiler's lists, but for system calls of the C library and tests.
{
    sed -n 's/^LOAD //p' "$map"
    find "$build" -name '*.d' -path '*/CMakeFiles/*' -exec cat {} + | tr -s ' \\' '\n\n' | grep '^/' | sed 's/:$//'
    printf '%s\n' "$@"
} | sort -u | xargs -r -d '\n' realpath -e -q -- | sort -u >"$folder/files"

# Built here from sources: each has left its licence.
prefix=$(sed -n 's|^\(/.*\)/lib/libOpenEXR[^/]*\.a$|\1|p' "$folder/files" | head -n 1)
if [ -n "$prefix" ]; then
    cp "$prefix"/copyright/* "$folder/"
    cp "$prefix/versions.txt" "$folder/packages.txt"
fi

# Debian's packages know some files by their names before /lib became a link to /usr/lib.
grep '^/usr/\|^/lib' "$folder/files" | sed 'p;s|^/usr/lib|/lib|' |
    xargs -r -d '\n' dpkg-query -S 2>/dev/null | sed 's/: \/.*//;s/, /\n/g' | sort -u >"$folder/found" || :
while IFS= read -r package; do
    name=${package%%:*}
    cp -L "/usr/share/doc/$name/copyright" "$folder/$name"
    dpkg-query -W -f '${binary:Package} ${Version}, of ${source:Package}\n' "$package" >>"$folder/packages.txt"
done <"$folder/found"
{ grep -rhoE '/usr/share/common-licenses/[A-Za-z0-9.-]*[A-Za-z0-9]' "$folder" || :; } | sort -u |
    while IFS= read -r text; do
        [ ! -f "$text" ] || cp -L "$text" "$folder/common/"
    done
sort -o "$folder/packages.txt" "$folder/packages.txt"
rm "$folder/files" "$folder/found"
