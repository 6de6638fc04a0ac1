#!/usr/bin/env bash
# Lavapipe, Mesa's Vulkan driver for CPUs, as a folder that goes anywhere:
#
#   cmake/lavapipe.sh FOLDER
#
# FOLDER has the driver of this system's package mesa-vulkan-drivers, the libraries that it needs except those of glibc, each
# of which finds the others beside itself, and lvp_icd.json, which names the driver relative to itself. FOLDER.sources
# lists the files that it has copied.
set -euo pipefail

command -v patchelf >/dev/null || { echo "lavapipe.sh: patchelf is missing: install the package of that name" >&2; exit 1; }
driver=$(dpkg -L mesa-vulkan-drivers | grep '/libvulkan_lvp\.so$')
rm -rf "$1" "$1.sources"
mkdir -p "$1"
for library in "$driver" $(ldd "$driver" | sed -n 's/.*=> \(\/[^ ]*\) .*/\1/p'); do
    file=$(realpath "$library")
    ! { dpkg-query -S "$file" "${file#/usr}" 2>/dev/null || :; } | grep -q "^libc6:" || continue
    copy=$1/$(basename "$library")
    install -m 755 "$file" "$copy"
    patchelf --set-rpath '$ORIGIN' "$copy"
    echo "$file" >>"$1.sources"
done
version=$(sed -n 's/.*"api_version": "\([^"]*\)".*/\1/p' /usr/share/vulkan/icd.d/lvp_icd.*.json | head -n 1)
cat >"$1/lvp_icd.json" <<END
{
    "file_format_version": "1.0.0",
    "ICD": { "library_path": "./libvulkan_lvp.so", "api_version": "${version:-1.3.0}" }
}
END
