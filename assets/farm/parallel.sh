#!/usr/bin/env bash
# One picture in parts, by GNU parallel: on the cores of this machine, or on others that it is told of. Parts that fail are
# tried again, and go on where they were.
#
#   parallel.sh PARTS OUTPUT ARGUMENT...      parallel.sh 16 cat.exr cat --spp 256
#
# The arguments are those of `hyalite render`. HYALITE names the program, JOBS how many parts a machine renders at a time
# (1: a render uses all cores), RETRIES how often a part is tried (3). Options of parallel itself, such as
# --sshloginfile for machines that share this folder, stand in PARALLEL_OPTIONS.
set -euo pipefail
[ $# -ge 3 ] || { sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "${BASH_SOURCE[0]}" >&2; exit 2; }
parts=$1
output=$2
shift 2
program=${HYALITE:-hyalite}
folder=$output.parts
mkdir -p "$folder"
read -ra options <<<"${PARALLEL_OPTIONS:-}"
seq "$parts" | parallel --quote --will-cite --jobs "${JOBS:-1}" --retries "${RETRIES:-3}" --workdir . \
    "${options[@]}" "$program" render "$@" --quiet --part "{}/$parts" -o "$folder/{}.part"
"$program" merge "$folder"/*.part -o "$output"
rm -r "$folder"
