#!/usr/bin/env bash
# Drives Chromium through the page of `hyalite view`, as a person would, by the tests in browser/:
#
#   tests/view/run.sh BUILD [TEST...]     the build folder, with the program; all files, unless some are named: pictures hands
#
# What they need is installed in BUILD/view, where also the screenshots are.
set -euo pipefail
[ $# -ge 1 ] || { sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "${BASH_SOURCE[0]}" >&2; exit 2; }
build=$(cd "$1" && pwd)
shift
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/browser" && pwd)
for command in chromium node npm; do
    command -v $command >/dev/null || { echo "$0: $command is missing: install a package of this name" >&2; exit 1; }
done
mkdir -p "$build/view"
cd "$build/view"
rm -f ./*.mjs ./*.png
cp "$source"/* .
if ! cmp -s package-lock.json node_modules/installed; then
    npm ci --ignore-scripts --no-audit --no-fund --silent
    cp package-lock.json node_modules/installed
fi
[ $# -gt 0 ] || set -- $(cd "$source" && basename -s .test.mjs -a ./*.test.mjs)
export PROGRAM=$build/bin/hyalite
export GALLIVM_PERF=nopt LP_NATIVE_VECTOR_WIDTH=128 # lavapipe compiles faster
exec node --test --test-reporter=spec "${@/%/.test.mjs}"
