#!/usr/bin/env bash
# Static libraries of those that Debian has as shared ones only, built from Debian's sources of this release:
#
#   cmake/static_libraries.sh FOLDER
#
# FOLDER is a prefix then, for CMAKE_PREFIX_PATH and PKG_CONFIG_PATH: Imath, OpenEXR, fmt, meshoptimizer, and cpp-httplib as
# its one header, without TLS and compression, which nothing here uses. Of each source, FOLDER/copyright/NAME is
# debian/copyright, and FOLDER/versions.txt has its version. What is there already is not built again.
set -euo pipefail

mkdir -p "$1"
prefix=$(cd "$1" && pwd)
work=$prefix/work
mkdir -p "$work/lists/partial" "$prefix/copyright"
cd "$work"
release=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
[ -n "$release" ] || { echo "static_libraries.sh: not a release of Debian: its sources are not known" >&2; exit 1; }
case $release in forky) release=sid ;; esac

# apt, with sources and lists of its own.
site=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' "Codename: $release" | head -n 1)
keyring=$(ls /usr/share/keyrings/debian-archive-keyring.* | head -n 1)
echo "deb-src [signed-by=$keyring] ${site:-http://deb.debian.org/debian} $release main" >sources.list
apt=(apt-get -qq -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=/dev/null
     -o Dir::State::Lists="$work/lists" -o Acquire::Languages=none -o APT::Sandbox::User=root)

# build NAME SOURCE OPTION...: builds by CMake and installs; NAME is that of the binary packages.
build() {
    local name=$1 source=$2
    shift 2
    [ -f "$prefix/copyright/$name" ] && return
    unpack "$source"
    cmake -S "$source"-*/ -B "$source.build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" \
        -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_INSTALL_LIBDIR=lib -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF \
        -DCMAKE_POSITION_INDEPENDENT_CODE=ON "$@"
    cmake --build "$source.build" --parallel "$(nproc)"
    cmake --install "$source.build"
    keep_copyright "$name" "$source"
}
unpack() {
    [ -n "$(ls lists/*Sources* 2>/dev/null)" ] || "${apt[@]}" update
    rm -rf "$1"-*/ "$1.build"
    "${apt[@]}" source "$1"
}
# The last step: the file says that all is there.
keep_copyright() {
    echo "$1 $(dpkg-parsechangelog -l "$2"-*/debian/changelog -S Version), built from the source $2" >>"$prefix/versions.txt"
    cp "$2"-*/debian/copyright "$prefix/copyright/$1"
    rm -rf "$2"-*/ "$2.build" "$2"_*
}

build libimath imath -DPYTHON=OFF
build libopenexr openexr -DOPENEXR_BUILD_TOOLS=OFF -DOPENEXR_INSTALL_TOOLS=OFF -DOPENEXR_INSTALL_EXAMPLES=OFF
build libfmt fmtlib -DFMT_TEST=OFF -DFMT_DOC=OFF
build libmeshoptimizer meshoptimizer
if [ ! -f "$prefix/copyright/libcpp-httplib" ]; then
    unpack cpp-httplib
    mkdir -p "$prefix/include" "$prefix/lib/pkgconfig"
    cp cpp-httplib-*/httplib.h "$prefix/include/"
    cat >"$prefix/lib/pkgconfig/cpp-httplib.pc" <<END
Name: cpp-httplib
Description: an HTTP server, as one header
Version: $(ls -d cpp-httplib-*/ | sed 's/cpp-httplib-\([0-9.]*[0-9]\).*/\1/')
Cflags: -I$prefix/include -pthread
Libs: -pthread
END
    keep_copyright libcpp-httplib cpp-httplib
fi
