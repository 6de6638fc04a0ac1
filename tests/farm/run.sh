#!/usr/bin/env bash
# Runs the templates of assets/farm, each as its test NAME.sh in this folder says:
#
#   tests/farm/run.sh BUILD [NAME...]     the build folder, with the program; all templates, unless some are named
set -euo pipefail
[ $# -ge 1 ] || { sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "${BASH_SOURCE[0]}" >&2; exit 2; }
build=$1
shift
[ $# -gt 0 ] || set -- parallel mpi slurm image kubernetes
for name in "$@"; do
    "$(dirname "${BASH_SOURCE[0]}")/$name.sh" "$build"
done
