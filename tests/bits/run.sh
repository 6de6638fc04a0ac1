#!/usr/bin/env bash
# Renders all pictures of cases.txt and slow.txt and compares their md5 sums:
#
#   tests/bits/run.sh PROGRAM [OPTION...]     options of `hyalite render`, such as --device cpu or --kernel stack
#
# The cost is that of a traversal with a stack: with --kernel skip-list its pictures are refused, and count as different. Set
# VK_DRIVER_FILES for another driver. Succeeds if no picture differs.
set -uo pipefail

program=$(realpath "$1") || exit 2
shift
cd "$(dirname "${BASH_SOURCE[0]}")" || exit 2
picture=$(mktemp --suffix .pfm)
trap 'rm -f "$picture"' EXIT
count=0 differing=0
while read -r wanted arguments; do
    case $wanted in '' | '#'*) continue ;; esac
    count=$((count + 1))
    : >"$picture"
    # shellcheck disable=SC2086 # arguments are words
    "$program" render $arguments -o "$picture" --quiet "$@" || true
    sum=$(md5sum <"$picture")
    if [ "${sum%% *}" != "$wanted" ]; then
        differing=$((differing + 1))
        echo "differs: $arguments: ${sum%% *} instead of $wanted"
    fi
done < <(cat cases.txt slow.txt)
echo "$differing of $count pictures differ"
[ "$differing" -eq 0 ] && [ "$count" -gt 0 ]
