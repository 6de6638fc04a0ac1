#!/usr/bin/env bash
# Plants small faults one at a time (mutations.txt) and counts how many the tests catch:
#
#   tests/mutation/run.sh [NUMBER|FIRST-LAST]...     by line of faults, 1 being the first; all by default
#
# Works on a copy of the sources in a temporary folder. A fault in a leaf function is planted in the CPU's copy of the
# leaves alone, and only tests that compare no twins judge it: both twins are compiled from one text, so that they agree
# on its faults. Other faults are planted in the sources, and every test that could see them judges. A fault that does
# not compile is not counted. Succeeds if at least 95 % are caught.
set -uo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
ranges=("${@:-1-1000000}")

original=$work/original # the sources may be edited while this runs
sources=$work/sources
leaves=$work/leaves
mkdir "$original" "$leaves"
(cd "$root" && git ls-files -z | xargs -0 tar cf -) | tar xf - -C "$original" || exit 2
cp -a "$original" "$sources" && cp -a "$original/shaders" "$leaves" || exit 2
cmake -S "$sources" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DHYALITE_LEAVES_ROOT="$leaves" >/dev/null || exit 2
export HYALITE_ASSETS=$work/build/share/hyalite
export GTEST_FAIL_FAST=1

leaf_folders=$(sed -n 's|^#include "\(shaders/[a-z]*\)/.*|\1|p' "$original/shaders/leaves.glsl" | sort -u)
# Tests of images/ that compare a picture with an oracle; the CPU's picture is one of them.
oracles='FlatWall*:RoundWall*:Lights.*:Shadow*:Furnace*:BallOnTheAxis*:GlassSheet*:HollowBall*:CriticalAngle*:Depth.*'
oracles+=':Silhouette*:*Plain*'

is_wanted() {
    local range
    for range in "${ranges[@]}"; do [ "$1" -ge "${range%-*}" ] && [ "$1" -le "${range#*-}" ] && return; done
    return 1
}
is_leaf() { grep -qxF "$(dirname "$1")" <<<"$leaf_folders"; }
# Prints the programs of tests that judge faults in files $*, each with a filter, those first that fail soonest.
judges() {
    local file folder
    for file; do is_leaf "$file" || break; done
    if is_leaf "$file"; then
        printf '%s\n' 'reference_tests *' 'packing_tests *' 'shaders_tests *' 'embree_tests *' "images_tests $oracles"
        return
    fi
    case $1 in
        host/*) folder=$(cut -d/ -f2 <<<"$1")_tests ;;
        *) folder=images_tests ;;
    esac
    printf '%s *\n' "$folder"
    for file in reference images kernels shaders packing bvh embree scene import film image gpu; do
        [ "${file}_tests" = "$folder" ] || printf '%s_tests *\n' "$file"
    done
}

# Says in `verdict` what became of a fault in files $*.
judge() {
    local program filter status witness
    while read -r program filter; do
        if ! cmake --build "$work/build" --parallel "$(nproc)" --target "$program" assets >"$work/build.log" 2>&1; then
            verdict='does not compile: not counted'
            return
        fi
        timeout 600 "$work/build/bin/$program" --gtest_filter="$filter" >"$work/test.log" 2>&1 && continue
        status=$?
        witness=$(grep -m1 -o 'FAILED  \] [A-Za-z0-9_./]*' "$work/test.log" | cut -c11-)
        verdict="caught by ${program%_tests}.${witness:-, which ended with status $status}"
        return
    done < <(judges "$@")
    verdict=MISSED
}

trim() { local text=$1; text=${text#"${text%%[![:space:]]*}"}; printf '%s' "${text%"${text##*[![:space:]]}"}"; }
tree_of() { if is_leaf "$1"; then echo "$leaves"; else echo "$sources"; fi; }
# $1: a file, $2: its text as it stands, $3: the text in its place. Adds to `description`.
plant() {
    local tree text
    tree=$(tree_of "$1")
    text=$(cat "$tree/$1"; printf x)
    text=${text%x}
    if [[ "$text" != *"$2"* ]]; then
        echo "$number  $1 does not contain: $2"
        exit 2
    fi
    printf '%s' "${text%%"$2"*}${3-}${text#*"$2"}" >"$tree/$1"
    description+="${description:+; }$1: $2 -> ${3-}"
}

echo "building and testing without faults ..."
for files in shaders/math/vector.glsl host/bvh/build.cpp; do
    judge "$files"
    [ "$verdict" = MISSED ] && continue
    echo "the tests fail without any fault: $verdict"
    tail -n 30 "$work/build.log" "$work/test.log"
    exit 2
done

number=0 faults=0 caught=0
while IFS= read -r line; do
    case $line in '' | '#'*) continue ;; esac
    number=$((number + 1))
    is_wanted "$number" || continue
    IFS='|' read -r -a fields <<<"${line//\\|/$'\x01'}"
    for i in "${!fields[@]}"; do fields[i]=$(trim "${fields[i]//$'\x01'/|}"); done
    files=() description=
    for ((i = 0; i < ${#fields[@]}; i += 3)); do
        files+=("${fields[i]}")
        plant "${fields[@]:i:3}"
    done
    judge "${files[@]}"
    for file in "${files[@]}"; do cat "$original/$file" >"$(tree_of "$file")/$file"; done
    echo "$number  $description: $verdict"
    case $verdict in
        caught*) faults=$((faults + 1)) caught=$((caught + 1)) ;;
        MISSED) faults=$((faults + 1)) ;;
    esac
done <"$original/tests/mutation/mutations.txt"
echo "$caught of $faults faults caught"
[ $((caught * 100)) -ge $((faults * 95)) ]
