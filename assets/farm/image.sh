#!/usr/bin/env bash
# An OCI image with the program and lavapipe, for farms that run containers. It is made by mmdebstrap and buildah of
# Debian's packages alone; no registry is asked.
#
#   image.sh PREFIX IMAGE      image.sh /usr/local hyalite      image.sh build/release hyalite
#
# PREFIX is where the program is installed, or a folder that it was built in: bin/hyalite and share/hyalite are put into
# the image, with the packages of the libraries that the program is linked to, of this machine's release of Debian.
#
#   podman run --rm -v "$PWD:/work" hyalite render cat --part 1/16 -o 1.part
#
# renders on all cores. A GPU's driver is given from outside: --device nvidia.com/gpu=all where NVIDIA's container toolkit
# describes its devices; else the device, as --device /dev/dri, and a folder with the driver and its ICD file, as
# -v /opt/driver:/opt/driver -e VK_DRIVER_FILES=/opt/driver/icd.json.
set -euo pipefail
[ $# -eq 2 ] || { sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "${BASH_SOURCE[0]}" >&2; exit 2; }
prefix=$(cd "$1" && pwd)
context=$(mktemp -d)
trap 'rm -rf "$context"' EXIT
for command in mmdebstrap buildah; do
    command -v "$command" >/dev/null || { echo "image.sh: $command is missing: install the package of that name" >&2; exit 1; }
done

# The package that a library is of. Debian's packages know some by their names before /lib became a link to /usr/lib.
package_of() {
    local file
    file=$(realpath "$1")
    { dpkg-query -S "$file" "${file#/usr}" 2>/dev/null || :; } | sed 's/:.*//;q' | grep . ||
        { echo "image.sh: $1 is of no package" >&2; exit 1; }
}

linked=$(ldd "$prefix/bin/hyalite")
! grep 'not found' <<<"$linked" >&2
packages=mesa-vulkan-drivers
for library in $(sed -n 's/.*=> \(\/[^ ]*\) .*/\1/p' <<<"$linked"); do
    packages+=,$(package_of "$library")
done
# libxext6 is for NVIDIA's driver, which has no package here to ask for it.
mmdebstrap --quiet --variant=essential --include="$packages,libxext6" --dpkgopt='path-exclude=/usr/share/doc/*' \
    --dpkgopt='path-exclude=/usr/share/man/*' --dpkgopt='path-exclude=/usr/share/locale/*' \
    "$(. /etc/os-release && echo "$VERSION_CODENAME")" "$context/rootfs.tar"
buildah build --quiet --build-context "program=$prefix" --file "$(dirname "${BASH_SOURCE[0]}")/Containerfile" --tag "$2" "$context"
