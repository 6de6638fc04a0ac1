#!/usr/bin/env bash
# Runs the templates of assets/farm:
#
#   tests/farm/run.sh BUILD [TIMES]     the build folder, with the program
#
# A picture is rendered in 16 parts on 2 workers of GNU parallel, while 5 renders are killed; it must be that of one
# render, to the bit, each of TIMES times (1).
set -euo pipefail
build=$(cd "$1" && pwd)
times=${2:-1}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export PROGRAM=$build/bin/hyalite VICTIMS=$folder/victims HYALITE=$root/tests/farm/killer.sh JOBS=2 RETRIES=8
scene=(cornell --spp 16 --width 200 --height 120 --threads 1)
"$PROGRAM" render "${scene[@]}" --quiet -o whole.exr
for ((i = 1; i <= times; ++i)); do
    echo 5 >"$VICTIMS"
    "$root/assets/farm/parallel.sh" 16 parts.exr "${scene[@]}" 2>parallel.log || { cat parallel.log; exit 1; }
    "$PROGRAM" diff whole.exr parts.exr >diff.log || { cat diff.log; exit 1; }
    [ ! -e parts.exr.parts ]
    killed=$((5 - $(<"$VICTIMS")))
    echo "GNU parallel, time $i: 16 parts, $killed renders killed, the picture of one render"
    [ "$killed" -ge 1 ]
done
