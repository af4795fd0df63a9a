# SPDX-License-Identifier: Apache-2.0
# What the viewer's scripts share: a virtual display, a private home, judging.
set -u
failures=0
scratch=$(mktemp -d "${TMPDIR:-/tmp}/srp-viewer.XXXXXX") || exit 1
xvfb_pid=
finish() {
    [ -z "$xvfb_pid" ] || kill "$xvfb_pid" 2>/dev/null
    rm -rf "$scratch"
}
trap finish EXIT
export HOME=$scratch XDG_CONFIG_HOME=$scratch/config XDG_DATA_HOME=$scratch/data \
    XDG_CACHE_HOME=$scratch/cache NO_AT_BRIDGE=1 GTK_A11Y=none LC_ALL=C.UTF-8
unset WAYLAND_DISPLAY
mkdir -p "$SHOTS"

fail() {
    failures=$((failures + 1))
    echo "FAILED: line ${BASH_LINENO[0]}: $1"
}

# A display of our own; 77, which ctest calls skipped, where there is none to be had.
start_display() {
    if [ -z "$XVFB" ] || [ ! -x "$XVFB" ]; then
        echo "skipped: Xvfb (package xvfb) is not there"
        exit 77
    fi
    mkfifo "$scratch/number"
    "$XVFB" -displayfd 3 -screen 0 2560x1600x24 -nolisten tcp 3> "$scratch/number" 2> "$scratch/xvfb.log" &
    xvfb_pid=$!
    if ! read -r -t 30 number < "$scratch/number"; then
        echo "skipped: Xvfb does not start: $(tail -1 "$scratch/xvfb.log")"
        exit 77
    fi
    export DISPLAY=:$number
}

# run_viewer ARGUMENTS...: what has to be in front of it (keep_loaded.c) comes with it.
run_viewer() {
    env ${VIEWER_PRELOAD:+"LD_PRELOAD=$VIEWER_PRELOAD"} timeout 300 "$VIEWER" "$@"
}

# Of the run in $scratch: the checker of leaks broke down itself, over a thread that was just coming or going as it
# stopped them all, which happens once in hundreds of ends. Its status hides the viewer's, which tells each failure in
# words, too.
is_without_verdict() {
    grep -q 'LeakSanitizer has encountered a fatal error' "$scratch/err" &&
        ! grep -qE '^srp-viewer: |^[^ ]*:[0-9]+: ' "$scratch/err"
}

# view STATUS ARGUMENTS...: runs the viewer, for two minutes at most; output in $scratch/out and err.
view() {
    local want=$1 got=0
    shift
    run_viewer "$@" > "$scratch/out" 2> "$scratch/err" || got=$?
    if [ "$want" -eq 0 ] && is_without_verdict; then
        echo "no verdict on leaks: srp-viewer $*"
        got=0
    fi
    if [ "$got" -ne "$want" ]; then
        fail "status $got, expected $want: srp-viewer $*"
        sed 's/^/  /' "$scratch/out" "$scratch/err"
    fi
    # What GTK complains of is a mistake of ours, but for the lack of a session bus.
    if grep -E 'CRITICAL|WARNING' "$scratch/err" | grep -vE 'session bus|Unable to acquire|dconf|portal|Vulkan|theme|at-spi'; then
        fail "GTK complains: srp-viewer $*"
    fi
}

# values NAME: what each `print NAME` said; value NAME: the last.
values() {
    sed -n "s/^$1: *//p" "$scratch/out"
}
value() {
    values "$1" | tail -1
}

judge() {
    if [ "$failures" -gt 0 ]; then
        echo "$failures failed"
        exit 1
    fi
    echo "all passed"
}
