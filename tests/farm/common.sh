# What the tests of the templates share. Each sources it with its arguments, of which the first is the build folder, and is
# then in a folder of its own, which is removed at the end, after its function `stop`.
set -euo pipefail
[ $# -ge 1 ] || { sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0" >&2; exit 2; }
build=$(cd "$1" && pwd)
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=$(mktemp -d)
stop() { :; }
trap 'stop; rm -rf "$folder"' EXIT
cd "$folder"
export PROGRAM=$build/bin/hyalite

fail() { echo "$0: $*" >&2; exit 1; }

# needs COMMAND PACKAGE
needs() { command -v "$1" >/dev/null || fail "$1 is missing: install the package $2"; }

# wait_until SECONDS COMMAND...: fails with the last lines of all *.log.
wait_until() {
    local end=$((SECONDS + $1))
    shift
    until "$@"; do
        [ "$SECONDS" -lt "$end" ] || fail "waited too long for $*: $(tail -n 5 ./*.log)"
        sleep 0.2
    done
}

# render_whole ARGUMENT...: the picture of one render, whole.exr.
render_whole() { "$PROGRAM" render "$@" --quiet -o whole.exr; }

# expect_whole PICTURE: it is that of one render, to the bit. All layers: the lines of pixels follow the header, which says who
# made the picture.
expect_whole() {
    local bytes=$(($(stat -c %s whole.exr) - 8192))
    "$PROGRAM" diff whole.exr "$1" >diff.log || { cat diff.log >&2; fail "$1 is another picture"; }
    cmp -s <(tail -c "$bytes" whole.exr) <(tail -c "$bytes" "$1") || fail "$1 has other layers"
}
