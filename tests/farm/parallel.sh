#!/usr/bin/env bash
# Runs assets/farm/parallel.sh:
#
#   tests/farm/parallel.sh BUILD     the build folder, with the program
#
# A picture is rendered in 16 parts on 2 workers of GNU parallel, while 5 renders are killed; it must be that of one
# render, to the bit, each of TIMES times (1).
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
needs parallel parallel
export VICTIMS=$folder/victims HYALITE=$root/tests/farm/killer.sh JOBS=2 RETRIES=8
scene=(cornell --spp 16 --width 200 --height 120 --threads 1)
render_whole "${scene[@]}"
for ((i = 1; i <= ${TIMES:-1}; ++i)); do
    echo 5 >"$VICTIMS"
    "$root/assets/farm/parallel.sh" 16 parts.exr "${scene[@]}" 2>parallel.log || { cat parallel.log; exit 1; }
    expect_whole parts.exr
    [ ! -e parts.exr.parts ]
    killed=$((5 - $(<"$VICTIMS")))
    echo "GNU parallel, time $i: 16 parts, $killed renders killed, the picture of one render"
    [ "$killed" -ge 1 ]
done
