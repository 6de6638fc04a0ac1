#!/usr/bin/env bash
# One picture by the ranks of mpirun, of which some are killed:
#
#   tests/farm/mpi.sh BUILD     the build folder, with the program, built with HYALITE_MPI=ON
#
# Three ranks share a picture. Then a rank is killed in the middle, and rank 0 is; the same command goes on from the
# checkpoint. The pictures must be that of one render, to the bit.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
needs mpirun openmpi-bin
needs pkill procps
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
ranks() { mpirun -n 3 --oversubscribe --bind-to none "$PROGRAM" render "$@" --threads 1; }

scene=(cornell --spp 512 --width 200 --height 120)
render_whole "${scene[@]}"
ranks "${scene[@]}" -o ranks.exr --report ranks.json >ranks.log 2>&1 || fail "$(<ranks.log)"
expect_whole ranks.exr
[ "$(grep -c '"tiles"' ranks.json)" -eq 3 ] || fail "not all ranks took part: $(<ranks.json)"

# Of the ranks' processes the one of this number.
rank_of() { pgrep -f -- "-o killed.exr" | while read -r process; do
    if tr '\0' '\n' <"/proc/$process/environ" 2>/dev/null | grep -qx "OMPI_COMM_WORLD_RANK=$1"; then echo "$process"; fi
done; }
has_begun() { [ -s film.checkpoint ]; }
killed=("${scene[@]}" -o killed.exr --checkpoint film.checkpoint --checkpoint-interval 0.5 --resume)
for rank in 2 0; do
    rm -f film.checkpoint film.checkpoint.1
    ranks "${killed[@]}" >killed.log 2>&1 &
    wait_until 60 has_begun
    kill -KILL $(rank_of "$rank") || fail "rank $rank had ended: $(<killed.log)"
    ! wait $! || fail "mpirun has not noticed that rank $rank is dead"
    ranks "${killed[@]}" >again.log 2>&1 || fail "$(<again.log)"
    grep -q 'resuming from film.checkpoint' again.log || fail "it began anew: $(<again.log)"
    expect_whole killed.exr
done
# Frames are dealt to the ranks.
ranks spheres --turntable 5 -o turn.#.png --width 32 --height 24 --spp 2 >turn.log 2>&1 || fail "$(<turn.log)"
[ "$(ls turn.?.png | wc -l)" -eq 5 ]
echo "MPI: 3 ranks, rank 2 killed, rank 0 killed, the picture of one render"
