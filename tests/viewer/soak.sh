#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Use without an end: all that a user does, again and again, for SRP_SOAK_MINUTES (3). No complaint of a
# sanitizer, and memory that does not grow.
. "$(dirname "$0")/lib.sh"
start_display
minutes=${SRP_SOAK_MINUTES:-3}
# Freed memory that AddressSanitizer holds back is no growth.
export ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}quarantine_size_mb=16

round() {
    local model=$1 at
    echo "open $ROOT/models/$model.obj"
    echo wait
    echo record
    for at in -170 -91 -33 0 47 122; do
        printf 'turn-z %s\nwait\nturn-y %s\nturn-x %s\n' "$at" $((at / 2)) $((-at))
    done
    printf '%s\n' wait record clear-arrows 'colouring force' wait 'colouring material' 'material bus=0.4,0.2' wait \
        material 'tab graphics' 'az-step 15' 'el-step 15' compute-table wait 'method raycast' 'parameter grid=64' \
        wait compute-table wait 'tab compare' wait 'fit 4' wait "save $scratch/soak.txt" "save $scratch/soak.png" \
        'tab graphics' "save $scratch/soak.nc" "open-table $scratch/soak.nc" wait \
        'material bus=0.3,0.1' wait reoptic wait 'show-table 1' reoptic clear-tables material 'method exact' \
        compute-table cancel wait clear-tables dark 'tab spacecraft' wait
}
{
    echo 'resize 1280 800'
    # Far more than there is time for: the clock ends it.
    for ((k = 0; k < 400; ++k)); do
        round box-wing
        round dish
        echo "note round $k"
    done
} > "$scratch/steps"
"$VIEWER" --actions "$scratch/steps" > "$scratch/out" 2> "$scratch/err" &
viewer_pid=$!
resident() { awk '/^VmRSS/ { print $2 }' "/proc/$viewer_pid/status"; }
early=
for ((k = 1; k <= 12 * minutes; ++k)); do
    sleep 5
    if ! kill -0 "$viewer_pid" 2> /dev/null; then
        fail 'the viewer ended early'
        cat "$scratch/err"
        judge
    fi
    [ "$k" -ne $((4 * minutes)) ] || early=$(resident)
done
late=$(resident)
echo "rounds: $(grep -c round "$scratch/out"), resident after a third $early KiB, at the end $late KiB"
[ "$((100 * late))" -lt "$((115 * early))" ] || fail 'memory grows'
kill "$viewer_pid"
wait "$viewer_pid" 2> /dev/null
grep -E 'ERROR: |runtime error|CRITICAL' "$scratch/err" && fail 'complaints'
judge
