#!/usr/bin/env bash
# Installs missing packages (Debian 12 and 13), builds, and runs what follows:
#
#   cmake/run.sh showcase            renders spheres.png and cat.png into this folder
#   cmake/run.sh test                builds and runs the tests
#   cmake/run.sh test-all            all of them, with more kernels and draws, on more drivers, of archives and the farm
#   cmake/run.sh test-drivers        the tests of devices on another Mesa and on SwiftShader, which it fetches
#   cmake/run.sh test-farm [NAME...] one picture by several processes, as the templates of assets/farm do it, all of
#                                    them or those named: parallel, mpi, slurm, image, kubernetes
#   cmake/run.sh test-archive        archives, with lavapipe and without, in bare systems; as root
#   cmake/run.sh test-view           the page of `hyalite view`, in Chromium
#   cmake/run.sh build               builds only
#   cmake/run.sh archive [--with-lavapipe]   an archive for any Linux, build/hyalite-VERSION-linux-x86_64.tar.xz, which needs
#                                    glibc alone; with lavapipe, a larger one, which needs no driver either
#   cmake/run.sh packages            installs what check, test, test-drivers, test-view, and test-farm parallel mpi need
#   cmake/run.sh bench [OPTION...]   measures speed beside Embree's, some minutes; --benchmark_filter=^rays less of it,
#                                    --driver=mesa or --driver=swiftshader also images by drivers that it fetches
#   cmake/run.sh sanitize            builds with the address and undefined behaviour sanitizers, and runs all tests
#   cmake/run.sh check               checks the format of all C++ by clang-format, and host/ and cmake/ by clang-tidy
#   cmake/run.sh fuzz SECONDS        feeds each reader of files with inputs made up by libFuzzer, for so many seconds
#   cmake/run.sh ARGUMENT...         hyalite ARGUMENT..., for instance: render cat -o cat.png
#
# Where all packages are there already it needs neither root nor network. The build is in build/release, of check in
# build/check, of sanitize in build/sanitize, of fuzz in build/fuzz.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release
target=all
needed=(g++ make cmake pkg-config libvulkan-dev spirv-headers mesa-vulkan-drivers glslang-tools spirv-tools libglm-dev
        libtinyobjloader-dev libstb-dev libcli11-dev nlohmann-json3-dev libfmt-dev libopenexr-dev libjpeg-dev libxxhash-dev
        zlib1g-dev libpng-dev libwebp-dev libcpp-httplib-dev libmeshoptimizer-dev libdraco-dev libzstd-dev)
needed_for_python=(python3-dev pybind11-dev python3-numpy)
needed_for_tests=(libgtest-dev libembree-dev vulkan-validationlayers assimp-utils nodejs "${needed_for_python[@]}"
                  python3-pytest python3-jsonschema python3-matplotlib python3-nbclient python3-ipykernel openexr imagemagick
                  python3-openimageio)
needed_for_archive=(dpkg-dev binutils xz-utils webp)
needed_for_archive_with_lavapipe=(patchelf)
declare -A needed_for_farm=([parallel]="parallel" [mpi]="libopenmpi-dev openmpi-bin procps" [slurm]="munge procps slurm-client slurmctld slurmd"
                           [image]="buildah mmdebstrap" [kubernetes]="nodejs npm")
needed_for_view=(chromium nodejs)
needed_for_bench=(libbenchmark-dev libembree-dev)
needed_for_check=(clang-format-14 clang-tidy-14 libomp-14-dev)
needed_for_fuzz=(clang-14 libclang-rt-14-dev libomp-14-dev)

usage() { sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "${BASH_SOURCE[0]}"; }

is_installed() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

install_missing() {
    local missing=() package
    if ! command -v dpkg-query >/dev/null; then
        echo "run.sh: not a Debian system: it is up to you to install the equivalents of: $*" >&2
        return
    fi
    for package in "$@"; do
        is_installed "$package" || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    echo "run.sh: installing ${missing[*]}" >&2
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "run.sh: neither root nor sudo: ask for these packages to be installed" >&2
            exit 1
        fi
        as_root=(sudo)
    fi
    [ -n "${has_lists:-}" ] || "${as_root[@]}" apt-get update -qq >&2
    has_lists=1
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
}

# From Debian 14 on, the library of SPIRV-Tools has a package of its own. That of ImageMagick's OpenEXR has its version in
# its name: libmagickcore-6.q16-6-extra in Debian 12.
install_for_tests() {
    install_missing "${needed_for_tests[@]}"
    compgen -G '/usr/lib/*/cmake/SPIRV-Tools' >/dev/null || install_missing spirv-tools-dev
    compgen -G '/usr/lib/*/ImageMagick-*/modules-*/coders/exr.so' >/dev/null || ! command -v apt-cache >/dev/null ||
        install_missing $(apt-cache search --names-only '^libmagickcore-[0-9]+\.q16-[0-9]+-extra$' | cut -d ' ' -f 1)
}

# Shows on a terminal how far a build is that writes to this log, until it is killed.
show_progress() {
    [ -t 2 ] || exit 0
    trap 'printf "\r\033[K" >&2; exit' TERM
    while true; do
        printf '\r\033[Krun.sh: building %s' "$(grep -o '^\[[^]]*\]' "$1" | tail -n 1)" >&2
        sleep 0.5
    done
}

# $1: ON or OFF, whether tests are built; then more options for CMake. Builds $target, in $build. Up to 24 sources are
# compiled as one, which takes half the time, and is no help to who edits one of them. The build's output is shown only if
# it fails.
build_all() {
    local log progress tests=$1
    shift
    log=$(mktemp)
    show_progress "$log" &
    progress=$!
    trap "kill $progress 2>/dev/null" EXIT
    if ! { cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DHYALITE_TESTS="$tests" \
                 -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=24 -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
                 -DPython_EXECUTABLE=/usr/bin/python3 \
                 ${HYALITE_WARNINGS_AS_ERRORS:+-DHYALITE_WARNINGS_AS_ERRORS="$HYALITE_WARNINGS_AS_ERRORS"} "$@" &&
           cmake --build "$build" --target "$target" --parallel "$(nproc)"; } >"$log" 2>&1; then
        kill $progress 2>/dev/null && wait $progress || :
        cat "$log" >&2
        rm -f "$log"
        echo "run.sh: the build failed" >&2
        exit 1
    fi
    kill $progress 2>/dev/null && wait $progress || :
    trap - EXIT
    rm -f "$log"
}

# Folders of host/ that are read as one by clang-tidy. Where two define the same file-local name, it says so: one gets another
# name, or the folder another row.
read_as_one=("base bvh farm image" "api engine jobs reference scene" "film gpu import packing" "cli lab process report view")

# .clang-tidy says what is looked for. Headers of libraries take most of the time, so that folders are read several as one,
# and other sources as they were compiled.
check_by_clang_tidy() {
    local folders folder units=$build/units together="${read_as_one[*]}"
    rm -rf "$units" && mkdir "$units"
    for folders in "${read_as_one[@]}"; do
        for folder in $folders; do
            cat "$build/host/$folder"/CMakeFiles/*.dir/Unity/*.cxx
        done >"$units/${folders// /_}.cpp"
    done
    { sed -n 's/^ *"file": "\(.*\)".*/\1/p' "$build/compile_commands.json" |
          grep -F -e "$build/host/" -e "$build/CMakeFiles/" -e "$root/host/" -e "$root/cmake/" |
          grep -v -E "/host/(${together// /|})/.*/Unity/"
      ls "$units"/*; } | sort -u | xargs -r -d '\n' ls -S | # the longest first
        xargs -P "$(nproc)" -I UNIT clang-tidy-14 --quiet --config-file="$root/.clang-tidy" UNIT -- -std=c++20 -fopenmp \
            -DHYALITE_VERSION='"0"' -DHYALITE_DATA_FOLDER='"/"' -I"$root" -I"$build" -I"$build/include" \
            -I"$build/kernels" $(/usr/bin/python3-config --includes 2>/dev/null) -isystem /usr/include/Imath 2>&1 |
        sed '/warnings\{0,1\} generated\.$/d'
}

# Whatever was chosen before stays: a build with tests is not made one without by the next render.
tests_as_before() { grep -qs '^HYALITE_TESTS:BOOL=ON' "$build/CMakeCache.txt" && echo ON || echo OFF; }

if [ $# -eq 0 ]; then
    usage
    exit 2
fi
if [ "$1" = check ]; then
    install_missing "${needed[@]}" "${needed_for_check[@]}"
    cd "$root"
    git ls-files 'assets/*.cpp' 'assets/*.h' 'cmake/*.cpp' 'host/*.cpp' 'host/*.h' 'shaders/*.cpp' 'tests/*.cpp' 'tests/*.h' |
        xargs -P "$(nproc)" -n 64 clang-format-14 --dry-run -Werror
    build=$root/build/check
    target=hyalite_leaves_header # the C++ that is made from shaders
    build_all OFF
    check_by_clang_tidy
    exit
fi
install_missing "${needed[@]}"
case $1 in
packages)
    command -v npm >/dev/null || needed_for_view+=(npm)
    install_missing "${needed_for_tests[@]}" "${needed_for_check[@]}" "${needed_for_view[@]}" ${needed_for_farm[parallel]} \
        ${needed_for_farm[mpi]}
    install_for_tests
    ;;
showcase)
    build_all "$(tests_as_before)"
    "$build/bin/hyalite" render spheres -o spheres.png
    "$build/bin/hyalite" render cat -o cat.png
    ;;
test)
    install_for_tests
    build_all ON
    ctest --test-dir "$build" --output-on-failure --parallel "$(nproc)"
    ;;
test-all)
    install_for_tests
    build_all ON
    ctest --test-dir "$build" --build-config All --output-on-failure --parallel "$(nproc)"
    "$root/tests/drivers/run.sh" "$build" whole
    "$root/cmake/run.sh" test-archive
    exec "$root/cmake/run.sh" test-farm
    ;;
test-drivers)
    install_for_tests
    build_all ON
    exec "$root/tests/drivers/run.sh" "$build"
    ;;
test-archive)
    install_missing mmdebstrap
    version=$(sed -n 's/^project(hyalite VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")
    archive=$root/build/hyalite-$version-linux-$(uname -m)
    "$root/cmake/run.sh" archive --with-lavapipe
    "$root/tests/archive/systems.sh" "$archive-lavapipe.tar.xz"
    "$root/cmake/run.sh" archive
    "$root/tests/archive/systems.sh" "$archive.tar.xz"
    ;;
test-farm)
    shift
    templates=("$@")
    command -v npm >/dev/null && needed_for_farm[kubernetes]=nodejs # others than Debian's have npm in it
    [ $# -gt 0 ] || templates=("${!needed_for_farm[@]}")
    for template in "${templates[@]}"; do
        [ -n "${needed_for_farm[$template]:-}" ] || { usage >&2; exit 2; }
        install_missing ${needed_for_farm[$template]}
    done
    options=()
    [[ " ${templates[*]} " != *" mpi "* ]] || options=(-DHYALITE_MPI=ON)
    build_all "$(tests_as_before)" "${options[@]}"
    exec "$root/tests/farm/run.sh" "$build" "$@"
    ;;
test-view)
    install_missing "${needed_for_view[@]}"
    command -v npm >/dev/null || install_missing npm
    build_all "$(tests_as_before)"
    exec "$root/tests/view/run.sh" "$build" "${@:2}"
    ;;
archive)
    [[ $# -eq 1 || ($# -eq 2 && $2 = --with-lavapipe) ]] || { usage >&2; exit 2; }
    install_missing "${needed_for_archive[@]}"
    build=$root/build/archive
    log=$build/libraries.log
    lavapipe=
    mkdir -p "$build"
    if [ $# -eq 2 ]; then
        install_missing "${needed_for_archive_with_lavapipe[@]}"
        lavapipe=$build/lavapipe
        "$root/cmake/lavapipe.sh" "$lavapipe"
    fi
    "$root/cmake/static_libraries.sh" "$build/libraries" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
    PKG_CONFIG_PATH=$build/libraries/lib/pkgconfig build_all OFF -DHYALITE_ARCHIVE=ON -DHYALITE_MPI=OFF \
        -DHYALITE_LAVAPIPE_FOLDER="$lavapipe" -DCMAKE_PREFIX_PATH="$build/libraries"
    rm -f "$build"/hyalite-*.tar.*
    (cd "$build" && cpack -G TGZ >/dev/null)
    packed=$(ls "$build"/hyalite-*.tar.gz)
    archive=$root/build/$(basename "$packed" .gz).xz
    # The first filter makes the targets of jumps absolute, which saves 0.3 MiB; and all is a sixth less than cpack's.
    jumps=x86
    [ "$(uname -m)" != aarch64 ] || jumps=arm64
    gzip --decompress --stdout "$packed" | xz --"$jumps" --lzma2=preset=9e >"$archive"
    rm "$packed"
    "$root/tests/archive/check.sh" "$archive"
    ;;
build)
    build_all "$(tests_as_before)"
    ;;
sanitize)
    install_for_tests
    build=$root/build/sanitize
    build_all ON --preset sanitize -DCMAKE_BUILD_TYPE=RelWithDebInfo
    ctest --test-dir "$build" --output-on-failure --parallel "$(nproc)"
    ;;
bench)
    install_missing "${needed_for_bench[@]}"
    build_all "$(tests_as_before)" -DHYALITE_BENCH=ON
    options=()
    for option in "${@:2}"; do
        case $option in
        --driver=mesa | --driver=swiftshader)
            "$root/tests/drivers/fetch.sh" "$build/drivers" "${option#*=}"
            option=--driver=$build/drivers/${option#*=}.json
            ;;
        esac
        options+=("$option")
    done
    exec "$build/bin/hyalite_bench" "${options[@]}"
    ;;
fuzz)
    [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || { usage >&2; exit 2; }
    install_missing "${needed_for_fuzz[@]}"
    build=$root/build/fuzz
    target=fuzzers
    build_all OFF --preset fuzz -DCMAKE_BUILD_TYPE=Debug
    exec "$root/tests/fuzz/run.sh" "$build" "$2"
    ;;
*)
    build_all "$(tests_as_before)"
    exec "$build/bin/hyalite" "$@"
    ;;
esac
