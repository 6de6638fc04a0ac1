#!/usr/bin/env bash
# Runs assets/farm/slurm.sh on a cluster of this machine alone, with daemons of its own, which end with it:
#
#   tests/farm/slurm.sh BUILD     the build folder, with the program
#
# Of the tasks of an array one is queued again in the middle, one has its render killed and tries again, and one is killed
# for good. The last one cancels the merging job, and the same command again makes the picture: that of one render, to the
# bit.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
for pair in munged:munge slurmctld:slurmctld slurmd:slurmd sbatch:slurm-client pkill:procps; do
    needs "${pair%:*}" "${pair#*:}"
done

# Before anything else, so that no command of Slurm ever means a cluster that this machine belongs to.
export SLURM_CONF=$folder/slurm.conf

# Nobody listens there now.
free_port() {
    local port
    until port=$(shuf -n 1 -i 20000-30000) && ! (: <"/dev/tcp/127.0.0.1/$port") 2>/dev/null; do :; done
    echo "$port"
}

# Jobs end before the daemons do, as they would outlive them.
daemons=()
stop() {
    [ ${#daemons[@]} -gt 0 ] || return 0
    timeout 20 scancel --full --signal=KILL --user="$(id -un)" 2>/dev/null || :
    timeout 20 scancel --user="$(id -un)" 2>/dev/null || :
    for ((i = 0; i < 50; ++i)); do
        [ -n "$(timeout 20 squeue --noheader 2>/dev/null)" ] || break
        sleep 0.2
    done
    kill "${daemons[@]}" 2>/dev/null || :
    wait
}

# start LOG COMMAND...
start() {
    "${@:2}" >"$1" 2>&1 &
    daemons+=($!)
}

# munged wants to be reached by everyone, and a key that nobody else reads.
chmod 711 .
mkdir munge spool state
(umask 077 && head -c 64 /dev/urandom >munge/key)
cat >slurm.conf <<END
ClusterName=farm
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$folder/munge/socket
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
MailProg=/bin/true
ProctrackType=proctrack/linuxproc
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0
SlurmdParameters=config_overrides
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=farm Nodes=ALL Default=YES State=UP
END
# Slurm 22.05 does without control groups of itself, and later ones where they are told to.
[[ $(slurmd -V) == *" 22."* ]] || echo CgroupPlugin=disabled >cgroup.conf
start munged.log munged --foreground --key-file="$folder/munge/key" --socket="$folder/munge/socket" \
    --pid-file="$folder/munge/pid" --seed-file="$folder/munge/seed" --log-file="$folder/munge/log" --num-threads=2
wait_until 20 test -S munge/socket
start slurmctld.log slurmctld -D
start slurmd.log slurmd -D -N "$(hostname -s)"
is_idle() { [ "$(sinfo --noheader --format=%t 2>/dev/null)" = idle ]; }
wait_until 60 is_idle

scene=(cornell --spp 1024 --width 200 --height 120 --threads 1)
render_whole "${scene[@]}"
export HYALITE=$PROGRAM
log=$folder/parts.exr.parts
submit() { read -r array merging < <("$root/assets/farm/slurm.sh" 4 "$folder/parts.exr" "${scene[@]}"); }
lines_of() { { grep -s "^$2" "$log/$1.log" || :; } | wc -l; }
is_halfway() { [ "$(lines_of "$1" task=render)" -ge 1 ]; }
is_over() { [ -z "$(squeue --noheader)" ]; }
expect_state() {
    local state
    state=$(scontrol show job "$1" | sed -n 's/.*JobState=\([A-Z]*\).*/\1/p')
    [ "$state" = "$2" ] || fail "job $1 is $state, not $2: $(tail -n 5 "$log"/*.log)"
}

submit
wait_until 60 is_halfway 1
scontrol requeue "${array}_1"
wait_until 60 is_halfway 2
pkill -KILL -f "render .* -o $log/2.part"
wait_until 60 is_halfway 3
scancel --signal=KILL --full "${array}_3"
is_free() { scontrol update JobId="${array}_1" StartTime=now 2>/dev/null; } # by itself it starts two minutes later
wait_until 60 is_free
wait_until 120 is_over
expect_state "$merging" CANCELLED
[ "$(lines_of 1 'resuming from')" -eq 1 ] || fail "the task that was queued again began anew: $(<"$log/1.log")"
[ "$(lines_of 2 device:)" -eq 2 ] || fail "a killed render was not tried again: $(<"$log/2.log")"
[ ! -e "$folder/parts.exr" ]

submit
wait_until 120 is_over
expect_state "$merging" COMPLETED
expect_whole parts.exr
[ ! -e "$log" ]
echo "Slurm: 4 parts, a task queued again, a render killed, a task lost and repeated, the picture of one render"
