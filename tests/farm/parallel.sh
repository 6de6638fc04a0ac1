#!/usr/bin/env bash
# Runs assets/farm/parallel.sh:
#
#   tests/farm/parallel.sh BUILD     the build folder, with the program
#
# A picture is rendered in 16 parts on 2 workers of GNU parallel, while 5 renders are killed; it must be that of one
# render, to the bit, each of TIMES times (1). Then it is rendered in 2 parts by another machine, or what says so.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
needs parallel parallel
export VICTIMS=$folder/victims HYALITE=$root/tests/farm/killer.sh JOBS=2 RETRIES=8
scene=(cornell --spp 16 --width 200 --height 120 --layers albedo,normal,depth --threads 1)
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

# A machine that is reached by ssh begins in the home folder, knows nothing of this shell's variables but has those of a login,
# and runs a shell's command.
export HOME=$folder/home
mkdir "$HOME"
cat >ssh <<'END'
#!/usr/bin/env bash
while [[ $1 == -* ]]; do shift; done
[ "$1" = elsewhere ] || exit 255
shift
[ "$1" != -- ] || shift
cd "$HOME" && exec env -i HOME="$HOME" PATH="$PATH" SHELL=/bin/bash bash -c "$*"
END
chmod +x ssh
HYALITE=$PROGRAM PARALLEL_OPTIONS="--ssh $folder/ssh --sshlogin 2/elsewhere" \
    "$root/assets/farm/parallel.sh" 2 elsewhere.exr "${scene[@]}" 2>parallel.log || { cat parallel.log; exit 1; }
expect_whole elsewhere.exr
echo "GNU parallel, elsewhere: 2 parts, the picture of one render"
