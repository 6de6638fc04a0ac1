#!/usr/bin/env bash
# Verifies the program and runs the tests of kernels on the drivers that fetch.sh fetches; ctest has the installed one:
#
#   tests/drivers/run.sh BUILD [whole]     the build folder, with the tests
#
# Succeeds if all of them pass on every driver. Mesa verifies one kernel, SwiftShader all that it chooses, and both run the
# tests of kernels that need a device, ray queries among them, which Mesa offers from 25 on. LLVM compiles those without its
# optimisations, which takes less than half of the time. `whole`: all kernels and tests, optimised; Mesa 25 takes a thousand
# seconds of one core for kernels with a stack.
set -euo pipefail

build=$(cd "$1" && pwd)
drivers=$build/drivers
kernels_of_mesa=(--kernels skip-list)
kernels_of_swiftshader=()
how_compiled=GALLIVM_PERF=nopt
on_device='*Twin*:*Division.*:*SquareRoot.*:StartupCheck.*:LaneExchange.*:Layout.*:RayQuery.*'
if [ "${2:-}" = whole ]; then
    kernels_of_mesa=()
    on_device='*'
    how_compiled=
    export HYALITE_TEST_ALL=1
fi
"$(dirname "${BASH_SOURCE[0]}")/fetch.sh" "$drivers" mesa swiftshader
# One driver, with a folder of its own for compiled kernels.
test_on() {
    local name=$1 log=$drivers/$1.log status=0
    local -n kernels=kernels_of_$1
    export VK_DRIVER_FILES=$drivers/$name.json VK_ICD_FILENAMES=$drivers/$name.json # loaders before 1.3.207 know the latter
    LD_LIBRARY_PATH=$(dirname "$(sed 's/.*"library_path": "\([^"]*\)".*/\1/' "$drivers/$name.json")") # what came along
    export LD_LIBRARY_PATH
    export MESA_SHADER_CACHE_DIR=$drivers/$name.cache HYALITE_CACHE=$drivers/$name.found HYALITE_TEST_DEVICE=0
    "$build/bin/hyalite" verify --device 0 "${kernels[@]}" --junit "$drivers/$name.xml" 2>"$log" || { cat "$log"; status=1; }
    if env $how_compiled "$build/bin/kernels_tests" --gtest_filter="$on_device" >"$log" 2>&1; then
        tail -n 1 "$log"
    else
        grep -v '^\[ RUN\|^\[       OK' "$log"
        status=1
    fi
    return "$status"
}
# Most of the time passes while one thread compiles kernels: both drivers at once.
test_on mesa >"$drivers/mesa.txt" 2>&1 &
status=0
test_on swiftshader || status=1
wait $! || status=1
cat "$drivers/mesa.txt"
exit "$status"
