#!/usr/bin/env bash
# Plants small faults one at a time (mutations.txt) and counts how many the tests catch:
#
#   tests/mutation/run.sh [FIRST [LAST]]     by line of faults, 1 being the first; all by default
#
# Works on a copy of the sources in a temporary folder. Takes about half a minute a fault. A fault that does not compile
# is not counted. Succeeds if at least 95 % are caught.
set -uo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
first=${1:-1}
last=${2:-1000000}

(cd "$root" && git ls-files -z | xargs -0 tar cf - ) | tar xf - -C "$work" || exit 2
cmake -S "$work" -B "$work/build" -DCMAKE_BUILD_TYPE=Release >/dev/null || exit 2
targets=(kernels_tests shaders_tests reference_tests packing_tests bvh_tests scene_tests import_tests film_tests image_tests
         gpu_tests images_tests embree_tests)
build() { cmake --build "$work/build" --parallel "$(nproc)" --target "${targets[@]}" assets >"$work/build.log" 2>&1; }
echo "building without faults ..."
build || { tail -n 30 "$work/build.log"; exit 2; }

export HYALITE_ASSETS=$work/build/share/hyalite
export GTEST_FAIL_FAST=1
# Else `witness` is what did not pass: a test, or a program that crashed or took longer than 10 minutes.
pass() {
    local program
    for program in "${targets[@]}"; do
        timeout 600 "$work/build/bin/$program" >"$work/test.log" 2>&1 && continue
        local status=$?
        witness=$(grep -m1 -o 'FAILED  \] [A-Za-z0-9_.]*' "$work/test.log" | cut -c11-)
        [ -n "$witness" ] || witness="the end of $program with status $status"
        return 1
    done
}
pass || { echo "the tests fail without any fault:"; tail -n 30 "$work/test.log"; exit 2; }

number=0 planted=0 caught=0
trim() { local text=$1; text=${text#"${text%%[![:space:]]*}"}; printf '%s' "${text%"${text##*[![:space:]]}"}"; }
mkdir "$work/originals"
# $1: a file, $2: its text as it stands, $3: the text in its place. Adds to `description`.
plant() {
    local file=$work/$1 text
    [ -e "$work/originals/$1" ] || (cd "$work" && cp --parents "$1" originals) || exit 2
    text=$(cat "$file"; printf x)
    text=${text%x}
    if [[ "$text" != *"$2"* ]]; then
        echo "$number  $1 does not contain: $2"
        exit 2
    fi
    printf '%s' "${text%%"$2"*}${3-}${text#*"$2"}" >"$file"
    description+="${description:+; }$1: $2 -> ${3-}"
}
while IFS= read -r line; do
    case $line in '' | '#'*) continue ;; esac
    number=$((number + 1))
    [ "$number" -ge "$first" ] && [ "$number" -le "$last" ] || continue
    IFS='|' read -r -a fields <<<"${line//\\|/$'\x01'}"
    for i in "${!fields[@]}"; do fields[i]=$(trim "${fields[i]//$'\x01'/|}"); done
    files=() description=
    for ((i = 0; i < ${#fields[@]}; i += 3)); do
        files+=("${fields[i]}")
        plant "${fields[@]:i:3}"
    done
    planted=$((planted + 1))
    if ! build; then
        planted=$((planted - 1)) verdict='does not compile: not counted'
    elif pass; then
        verdict=MISSED
    else
        caught=$((caught + 1)) verdict="caught by $witness"
    fi
    for file in "${files[@]}"; do cat "$work/originals/$file" >"$work/$file"; done
    echo "$number  $description: $verdict"
done <"$root/tests/mutation/mutations.txt"
echo "$caught of $planted faults caught"
[ $((caught * 100)) -ge $((planted * 95)) ]
