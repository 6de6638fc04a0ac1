#!/usr/bin/env bash
# Puts Vulkan drivers that this machine lacks into a folder, unpacked from Debian's packages; nothing is installed:
#
#   tests/drivers/fetch.sh FOLDER
#
#   FOLDER/mesa.json          lavapipe of another version of Mesa than the release's own
#   FOLDER/swiftshader.json   SwiftShader, which comes with Chromium
#
# What is there already is not fetched again. A driver that cannot be had, or whose libraries are missing, is an error.
set -euo pipefail

mkdir -p "$1"
cd "$1"
folder=$PWD
architecture=$(dpkg --print-architecture)
triplet=$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || gcc -print-multiarch)
release=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
# tests/README.md has the same table.
case $release in
bookworm | trixie) mesa_suite=$release-backports ;;
*)
    echo "fetch.sh: no other Mesa is known for this system (${release:-without a code name}); known: Debian 12 and 13" >&2
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

# fetch NAME PACKAGE SUITE LIBRARY: writes NAME.json.
fetch() {
    local name=$1 package=$2 suite=$3 library=$4 missing
    [ -f "$name.json" ] && return
    [ -n "$(ls lists/*Packages* 2>/dev/null)" ] || "${apt[@]}" update
    rm -rf "$name" "$package"_*.deb
    "${apt[@]}" download "$package/$suite"
    dpkg -x "$package"_*.deb "$name"
    rm "$package"_*.deb
    if missing=$(ldd "$name/$library" | grep 'not found'); then
        echo "fetch.sh: $package of $suite needs libraries that are not installed:" $missing >&2
        exit 1
    fi
    printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "%s", "api_version": "1.3.0"}}\n' \
        "$folder/$name/$library" >"$name.json"
}
fetch mesa mesa-vulkan-drivers "$mesa_suite" "usr/lib/$triplet/libvulkan_lvp.so"
fetch swiftshader chromium-common "$release" usr/lib/chromium/libvk_swiftshader.so
