#!/usr/bin/env bash
# Checks an archive that cmake/run.sh archive has made:
#
#   tests/archive/check.sh ARCHIVE
#
# its sizes and contents, that it needs glibc alone, and that it runs from a folder that is read-only and has a space in its
# name, without any variable of the environment.
set -euo pipefail

archive=$(realpath "$1")
fail() { echo "$(basename "$archive"): $*" >&2; exit 1; }
bytes() { du --apparent-size --bytes --summarize "$1" | cut -f 1; }
mebibyte=$((1 << 20))
case $archive in
*-lavapipe.tar.xz) most_packed=64 most_unpacked=240 ;; # MiB: LLVM
*) most_packed=12 most_unpacked=40 ;;
esac

work=$(mktemp -d)
trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
folder="$work/any where"
mkdir "$folder"
tar -C "$folder" -xJf "$archive"
roots=("$folder"/*)
[ ${#roots[@]} -eq 1 ] || fail "unpacks to more than one folder: ${roots[*]}"
root=${roots[0]}
[[ $(basename "$root") =~ ^hyalite-[0-9]+\.[0-9]+\.[0-9]+$ ]] || fail "unpacks to $(basename "$root")"

packed=$(bytes "$archive") unpacked=$(bytes "$root")
echo "packed $((packed * 10 / mebibyte))e-1 MiB, unpacked $((unpacked * 10 / mebibyte))e-1 MiB" | sed 's/\([0-9]\)e-1/.\1/g'
[ "$packed" -le $((most_packed * mebibyte)) ] || fail "has more than $most_packed MiB"
[ "$unpacked" -le $((most_unpacked * mebibyte)) ] || fail "has more than $most_unpacked MiB, unpacked"

for file in bin/hyalite lib/hyalite/libvulkan.so.1 share/hyalite/scenes/cat.obj share/hyalite/verify/films.json \
            share/hyalite/known-machines.json share/man/man1/hyalite.1 share/bash-completion/completions/hyalite \
            share/doc/hyalite/README.md share/doc/hyalite/LICENSE share/doc/hyalite/host/cli/README.md \
            share/doc/hyalite/assets/README.md share/doc/hyalite/licences/packages.txt \
            share/doc/hyalite/licences/libvulkan1 share/doc/hyalite/licences/libopenexr; do
    [ -s "$root/$file" ] || fail "has no $file"
done
# Pages show their pictures.
(cd "$root/share/doc/hyalite" && grep -rno --include='*.md' '!\[[^]]*\]([^)]*)' . | while IFS=: read -r page line picture; do
    picture=${picture#*](}
    [ -s "$(dirname "$page")/${picture%)}" ] || fail "$page:$line shows ${picture%)}, which is not there"
done)
[ ! -e "$root/include" ] && [ ! -e "$root/lib/cmake" ] || fail "has files for developers"
# Each package has its licence.
while read -r package _; do
    [ -s "$root/share/doc/hyalite/licences/${package%%:*}" ] || fail "has no licence of $package"
done <"$root/share/doc/hyalite/licences/packages.txt"

# Needed: glibc's libraries, and what is in the archive itself.
ours=$(find "$root" -name '*.so*' -printf '%f\n')
find "$root/bin" "$root/lib" -type f | while IFS= read -r file; do
    readelf -h "$file" >/dev/null 2>&1 || continue
    readelf -S "$file" | grep -q '\.debug_' && fail "$file is not stripped"
    readelf -d "$file" | sed -n 's/.*NEEDED.*\[\(.*\)\]/\1/p' | while read -r library; do
        case $library in
        libc.so.6 | libm.so.6 | libpthread.so.0 | libdl.so.2 | librt.so.1 | ld-linux-*) ;;
        *) grep -qxF "$library" <<<"$ours" || fail "$file needs $library" ;;
        esac
    done
    ! readelf -d "$file" | grep -q 'R.*PATH.*\[/' || fail "$file has an absolute RUNPATH"
done
versions() { find "$root/bin" "$root/lib" -type f ! -name '*.json' -exec readelf -V {} + 2>/dev/null || :; }
glibc=$(versions | grep -oE 'GLIBC_[0-9.]+' | sort -uV | tail -n 1)
echo "needs ${glibc/_/ } or newer, of $(ldd --version | sed -n '1s/.* //p') where it was built"

chmod -R a-w "$root"
run() { (cd / && env -i HOME="$work" "$root/bin/hyalite" "$@"); }
run --version >/dev/null
run --scene-names | grep -qx cat || fail "does not find its scenes"
run verify --device cpu --scenes lights | tail -n 1 | grep -qx 'equal, bit for bit' || fail "does not verify"
run render cornell --device cpu --spp 1 --width 64 --height 64 --quiet -o "$work/cornell.png"
case $archive in
*-lavapipe.tar.xz)
    none=(XDG_DATA_DIRS="$work/none" XDG_CONFIG_DIRS="$work/none" HOME="$work")
    env -i "${none[@]}" HYALITE_BUNDLED_DRIVER=1 "$root/bin/hyalite" devices | grep -q llvmpipe ||
        fail "does not find its driver"
    ;;
esac
echo "$(basename "$archive") is in order"
