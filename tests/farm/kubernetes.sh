#!/usr/bin/env bash
# Checks assets/farm/job.yaml by the schema of Kubernetes, and runs the commands of its pods as a kubelet would:
#
#   tests/farm/kubernetes.sh BUILD     the build folder, with the program
#
# Copies with a fault must be refused. While the merging pod waits, a pod renders each index and begins anew where 3 of
# them are killed; the picture must be that of one render, to the bit.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
needs npm npm
needs node nodejs
cp "$root"/tests/farm/kubernetes/* .
npm ci --ignore-scripts --no-audit --no-fund --silent
node validate.mjs "$root/assets/farm/job.yaml" >job.json

# refused FAULT EXPRESSION: with what sed makes of it, for this reason.
refused() {
    sed "$2" "$root/assets/farm/job.yaml" >faulty.yaml
    ! node validate.mjs faulty.yaml >/dev/null 2>faults || fail "the schema allows $2"
    grep -qF "$1" faults || fail "$2 is refused for another reason: $(<faults)"
}
refused '/spec/completionmode is unknown' 's/completionMode:/completionmode:/'
refused '/containers/0/volumeMount is unknown' 's/volumeMounts:/volumeMount:/'
refused '/spec/completions breaks type' 's/completions: 16/completions: sixteen/'
refused '/spec breaks required {"missingProperty":"template"}' '/^  template:/,/^---/d'
refused 'Map keys must be unique' 's/parallelism:/completions:/'

# of NAME EXPRESSION: a value of the job of this name.
of() { node -p "const all = JSON.parse(fs.readFileSync('job.json')); const job = all.find((o) => o.metadata.name === '$1');
                const pod = job.spec?.template.spec; const container = pod?.containers[0]; $2"; }
for job in hyalite-parts hyalite-merge; do
    [ "$(of $job container.envFrom[0].configMapRef.name)" = hyalite ]
    [ "$(of $job pod.volumes[0].persistentVolumeClaim.claimName)" = hyalite ]
    [ "$(of $job 'container.workingDir === container.volumeMounts[0].mountPath')" = true ]
    [ "$(of $job 'container.command.slice(0, -1).join(" ")')" = "bash -c" ]
done

# pod JOB [VARIABLE=VALUE...]: its command in the volume, with the ConfigMap's data, but of a scene that takes seconds.
mkdir bin volume
ln -s "$root/tests/farm/killer.sh" bin/hyalite
scene=(cornell --spp 16 --width 200 --height 120 --threads 1)
mapfile -t data < <(of hyalite 'Object.entries(job.data).map(([key, value]) => `${key}=${value}`).join("\n")')
pod() (
    command=$(of "$1" 'container.command.at(-1)')
    exec env -i -C volume PATH="$folder/bin:$PATH" PROGRAM="$PROGRAM" VICTIMS="$folder/victims" "${data[@]}" \
        ARGUMENTS="${scene[*]} --quiet" "${@:2}" bash -c "$command"
)

render_whole "${scene[@]}"
echo 3 >victims
pod hyalite-merge >merge.log 2>&1 &
merging=$!
stop() { kill "$merging" 2>/dev/null || :; }
completions=$(of hyalite-parts job.spec.completions)
tries=$(($(of hyalite-parts job.spec.backoffLimitPerIndex) + 1))
for ((index = 0; index < completions; ++index)); do
    for ((try = 1; try <= tries; ++try)); do
        pod hyalite-parts JOB_COMPLETION_INDEX="$index" 2>part.log && continue 2
    done
    fail "index $index failed $tries times: $(<part.log)"
done
is_merged() { [ ! -e volume/cat.exr.parts ]; }
wait_until 60 is_merged
wait "$merging" || fail "the merging pod failed: $(<merge.log)"
expect_whole volume/cat.exr
killed=$((3 - $(<victims)))
[ "$killed" -ge 1 ]
echo "Kubernetes: the schema agrees; $completions parts, $killed pods killed, the picture of one render"
