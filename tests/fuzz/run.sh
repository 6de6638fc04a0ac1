#!/usr/bin/env bash
# Runs each harness for some seconds, one after the other, and fails if one finds anything:
#
#   tests/fuzz/run.sh BUILD_FOLDER SECONDS [FORMAT...]     all formats unless some are named
#
# Inputs that reach new code are kept in BUILD_FOLDER/corpus/FORMAT, from where the next run goes on; what is found
# is in BUILD_FOLDER/finds, and the harness reads it again as BUILD_FOLDER/bin/fuzz_FORMAT FILE.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1
seconds=$2
formats=("${@:3}")
if [ ${#formats[@]} -eq 0 ]; then
    for seeds in "$here"/corpus/*; do
        formats+=("$(basename "$seeds")")
    done
fi

# In memory where there is such a folder: files are most of a harness's work. A harness that is stopped by a find leaves
# its own behind.
memory=/dev/shm
TMPDIR=$([ -w $memory ] && mktemp -d -p $memory || mktemp -d)
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT

# Freed memory is used again soon, or each input would touch new pages.
export ASAN_OPTIONS=quarantine_size_mb=16${ASAN_OPTIONS:+:$ASAN_OPTIONS}
export UBSAN_OPTIONS=print_stacktrace=1${UBSAN_OPTIONS:+:$UBSAN_OPTIONS}

found=0
mkdir -p "$build/finds"
for format in "${formats[@]}"; do
    log=$build/finds/$format.log
    mkdir -p "$build/corpus/$format"
    words=()
    case $format in
    mtl) words=("-dict=$here/mtl.words") ;;
    obj) words=("-dict=$here/obj.words") ;;
    ies) words=("-dict=$here/ies.words") ;;
    gltf) words=("-dict=$here/gltf.words") ;;
    ply) words=("-dict=$here/ply.words") ;;
    stl) words=("-dict=$here/stl.words") ;;
    baseline | part | scene) words=("-dict=$here/json.words") ;;
    esac
    if "$build/bin/fuzz_$format" -max_total_time="$seconds" -rss_limit_mb=1024 -timeout=30 -max_len=4096 \
        -print_final_stats=1 -artifact_prefix="$build/finds/$format-" "${words[@]}" \
        "$build/corpus/$format" "$here/corpus/$format" >"$log" 2>&1; then
        inputs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
        echo "$format: nothing found in $seconds s, $inputs inputs"
    else
        found=1
        echo "$format: FOUND, see $log:"
        grep -m 3 -E 'ERROR|runtime error|broken promise|Test unit written' "$log" || tail -n 3 "$log"
    fi
done
exit $found
