#!/usr/bin/env bash
# Runs an archive in bare systems, each a changed root without a compiler, a library of ours or a driver:
#
#   tests/archive/systems.sh ARCHIVE [SYSTEM...]
#
# SYSTEM: bookworm, trixie, sid: Debian's essential packages; glibc: the files of the packages libc6 and libgcc-s1, which the
# former depends on, and nothing else, not even a shell, which stands for any Linux. All of them if none is named. As root.
set -euo pipefail

archive=$(realpath "$1")
shift
[ $# -gt 0 ] || set -- bookworm trixie sid glibc
command -v mmdebstrap >/dev/null ||
    { echo "systems.sh: mmdebstrap is missing: install the package of that name" >&2; exit 1; }
work=$(mktemp -d)
mounted=()
clean() {
    for folder in "${mounted[@]}"; do umount "$folder" || :; done
    rm -rf --one-file-system "$work"
}
trap clean EXIT

make_root() {
    case $1 in
    glibc)
        mkdir -p "$2" "$work/debs"
        (cd "$work/debs" && apt-get -qq -o APT::Sandbox::User=root download libc6 libgcc-s1)
        for package in "$work"/debs/*.deb; do dpkg -x "$package" "$2"; done
        ;;
    # A mirror may be behind.
    *) mmdebstrap --quiet --variant=essential --aptopt='Acquire::Check-Valid-Until "false"' "$1" "$2" >/dev/null ;;
    esac
}

for system in "$@"; do
    root=$work/$system
    make_root "$system" "$root"
    mkdir -p "$root/opt/any where" "$root/proc" "$root/tmp" "$root/dev"
    tar -C "$root/opt/any where" -xJf "$archive"
    mount -t proc proc "$root/proc" && mounted+=("$root/proc")
    mount --bind "$root/opt" "$root/opt" && mounted+=("$root/opt")
    mount -o remount,ro,bind "$root/opt"
    program="/opt/any where/$(ls "$root/opt/any where")/bin/hyalite"
    inside() { env -i HOME=/tmp "$(command -v chroot)" "$root" "$program" "$@"; }
    echo "$system: $(inside --version)"
    inside verify --device cpu | tail -n 1 | grep -qx 'equal, bit for bit'
    inside render spheres --device cpu --spp 1 --width 64 --height 64 --quiet -o /tmp/spheres.png
    [ -s "$root/tmp/spheres.png" ]
    code=0
    inside doctor --device cpu --time-limit 1e-6 >"$work/doctor.txt" || code=$?
    case $archive in
    *-lavapipe.tar.xz)
        inside devices | grep -q llvmpipe
        inside render spheres --device llvmpipe --spp 1 --width 64 --height 64 --quiet -o /tmp/lavapipe.pfm
        inside render spheres --device cpu --spp 1 --width 64 --height 64 --quiet -o /tmp/cpu.pfm
        cmp "$root/tmp/lavapipe.pfm" "$root/tmp/cpu.pfm"
        echo "$system: its lavapipe renders, with the bits of the CPU"
        ;;
    *)
        ! inside devices >"$work/devices.txt" 2>&1
        grep -q 'mesa-vulkan-drivers' "$work/devices.txt"
        grep -q 'no Vulkan driver is installed' "$work/doctor.txt"
        ;;
    esac
    [ "$code" -eq 0 ]
    echo "$system: equal, bit for bit"
done
