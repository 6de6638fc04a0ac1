#!/usr/bin/env bash
# A prolog of Slurm that gives no job to a node whose devices compute wrongly. In slurm.conf:
#
#   Prolog=/etc/slurm/slurm-prolog.sh
#
# Slurm drains a node whose prolog fails, and queues the job again. HYALITE names the program, MINUTES how long all devices
# compute beside each other (0.5), and REPORTS the folder of the reports (/var/log/hyalite).
set -euo pipefail
report=${REPORTS:-/var/log/hyalite}/${SLURM_JOB_ID:-none}.json
mkdir -p "${report%/*}"
if ! "${HYALITE:-hyalite}" verify --device "${DEVICE:-all}" --minutes "${MINUTES:-0.5}" --quiet --report "$report" >"${report%.json}.txt" 2>&1; then
    logger -t hyalite -p daemon.err "$(tail -n 1 "${report%.json}.txt"): $report" 2>/dev/null || :
    exit 1
fi
rm "$report" "${report%.json}.txt"
