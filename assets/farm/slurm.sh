#!/usr/bin/env bash
# One picture in parts, by Slurm: the tasks of an array render a part each, and a job that waits for them all merges. It
# prints the numbers of both jobs. The nodes share this folder.
#
#   slurm.sh PARTS OUTPUT ARGUMENT...      slurm.sh 64 cat.exr cat --spp 1024
#
# The arguments are those of `hyalite render`. HYALITE names the program, RETRIES how often a task tries its part (3).
# Options of sbatch for the tasks alone, such as --gres=gpu:1, stand in SLURM_OPTIONS; sbatch's own variables, such as
# SBATCH_ACCOUNT, count for both jobs. A task whose node fails or is wanted by others is queued again, and goes on. If one
# fails for good, the merging job is cancelled: the same command again does what is left. OUTPUT.parts has the parts, and
# what the jobs said, until the picture is there.
set -euo pipefail
[ $# -ge 3 ] || { sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "${BASH_SOURCE[0]}" >&2; exit 2; }
program=${HYALITE:-hyalite}
case $1 in
part) # the job that `sbatch` makes of this script, as the merging one below
    number=$SLURM_ARRAY_TASK_ID parts=$2 folder=$3
    shift 3
    trap RETRIES=0 TERM # Slurm takes the node: the render, which gets the signal too, first writes what it has
    for ((try = 1; try <= ${RETRIES:-3}; ++try)); do
        "$program" render "$@" --part "$number/$parts" -o "$folder/$number.part" && exit
    done
    exit 1
    ;;
merge)
    "$program" merge "$2"/*.part -o "$3"
    rm -r "$2"
    ;;
*)
    parts=$1 output=$2 folder=$2.parts
    shift 2
    mkdir -p "$folder"
    read -ra options <<<"${SLURM_OPTIONS:-}"
    array=$(sbatch --parsable --job-name=hyalite --array="1-$parts" --requeue --open-mode=append \
        --output="$folder/%a.log" "${options[@]}" "${BASH_SOURCE[0]}" part "$parts" "$folder" "$@")
    merging=$(sbatch --parsable --job-name=hyalite-merge --dependency="afterok:$array" --kill-on-invalid-dep=yes \
        --output="$folder/merge.log" "${BASH_SOURCE[0]}" merge "$folder" "$output")
    echo "$array $merging"
    ;;
esac
