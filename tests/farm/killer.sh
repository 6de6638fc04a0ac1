#!/usr/bin/env bash
# The program, of which some runs are killed at a moment that nobody chose. VICTIMS is a file with how many are left to be
# killed, PROGRAM the program.
set -u
exec 9>>"$VICTIMS.lock"
flock 9
left=$(<"$VICTIMS")
is_victim=0
if [ "$1" = render ] && [ "$left" -gt 0 ] && [ $((RANDOM % 2)) -eq 0 ]; then
    is_victim=1
    echo $((left - 1)) >"$VICTIMS"
fi
flock -u 9
if [ "$is_victim" = 0 ]; then
    exec "$PROGRAM" "$@"
fi
"$PROGRAM" "$@" &
sleep "0.$((RANDOM % 40 + 10))"
kill -KILL $! 2>/dev/null || exit 137 # it was faster: it counts as killed, and is tried again
wait $!
