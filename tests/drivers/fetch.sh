#!/usr/bin/env bash
# Puts Vulkan drivers that this machine lacks into a folder, unpacked from Debian's packages; nothing is installed:
#
#   tests/drivers/fetch.sh FOLDER DRIVER...
#
#   mesa          FOLDER/mesa.json, lavapipe of another version of Mesa than the release's own
#   swiftshader   FOLDER/swiftshader.json, SwiftShader, which comes with Chromium
#
# What is there already is not fetched again. A driver that cannot be had, or whose libraries are missing, is an error.
set -euo pipefail

mkdir -p "$1"
cd "$1"
shift
folder=$PWD
architecture=$(dpkg --print-architecture)
triplet=$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || gcc -print-multiarch)
release=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
# tests/README.md has the same table.
case $release in
bookworm) mesa_suite=bookworm-backports ;;
trixie) mesa_suite=bookworm ;; # 26.1.6 of its backports crashes on one of our kernels
forky | sid) release=sid mesa_suite=trixie ;;
*)
    echo "fetch.sh: no other Mesa is known for this system (${release:-without a code name});" \
         "known: Debian 12, 13 and sid" >&2
    exit 1
    ;;
esac

# apt, with sources and lists of its own.
site=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' "Codename: $release" | head -n 1)
keyring=$(ls /usr/share/keyrings/debian-archive-keyring.* | head -n 1)
mkdir -p lists/partial
for suite in "$release" "$mesa_suite"; do
    echo "deb [arch=$architecture signed-by=$keyring] ${site:-http://deb.debian.org/debian} $suite main"
done >sources.list
apt=(apt-get -qq -o Dir::Etc::SourceList="$folder/sources.list" -o Dir::Etc::SourceParts=/dev/null
     -o Dir::State::Lists="$folder/lists" -o Acquire::Languages=none -o APT::Sandbox::User=root)

# unpack NAME PACKAGE=VERSION...
unpack() {
    local name=$1 archive
    shift
    "${apt[@]}" download "$@"
    for archive in *.deb; do
        dpkg -x "$archive" "$name"
    done
    rm -- *.deb
}

# missing_of FILE: its libraries that neither the system nor the folder of the driver has.
missing_of() { LD_LIBRARY_PATH=$(dirname "$1") ldd "$1" | grep 'not found' || :; }

# fetch NAME PACKAGE SUITE LIBRARY: writes NAME.json.
fetch() {
    local name=$1 package=$2 suite=$3 library=$4
    [ -f "$name.json" ] && return
    [ -n "$(ls lists/*Packages* 2>/dev/null)" ] || "${apt[@]}" update
    rm -rf "$name" ./*.deb
    unpack "$name" "$package/$suite"
    # Libraries that it needs and the system lacks: those of the packages that an installation would bring along.
    if [ -n "$(missing_of "$name/$library")" ]; then
        mapfile -t others < <("${apt[@]}" -s --allow-downgrades --no-install-recommends install "$package/$suite" |
            sed -n "/^Inst $package /d; s/^Inst \([^ ]*\) \(\[[^]]*\] \)\?(\([^ ]*\) .*/\1=\3/p")
        unpack "$name" "${others[@]}"
    fi
    if [ -n "$(missing_of "$name/$library")" ]; then
        echo "fetch.sh: $package of $suite needs libraries that cannot be had:" $(missing_of "$name/$library") >&2
        exit 1
    fi
    printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "%s", "api_version": "1.3.0"}}\n' \
        "$folder/$name/$library" >"$name.json"
}
for driver in "$@"; do
    case $driver in
    mesa) fetch mesa mesa-vulkan-drivers "$mesa_suite" "usr/lib/$triplet/libvulkan_lvp.so" ;;
    swiftshader) fetch swiftshader chromium-common "$release" usr/lib/chromium/libvk_swiftshader.so ;;
    *) echo "fetch.sh: no driver is known as $driver" >&2; exit 2 ;;
    esac
done
