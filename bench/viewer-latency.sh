#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From a slider to the picture with the new arrow: the median of 60 moves of srp-viewer under Xvfb, by its
# action and (where xdotool is) by the pointer, beside the time of `srp force` for the same model, in one run.
#   bench/viewer-latency.sh [BUILD-FOLDER]      default: build/release
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
build=${1:-$top/build/release}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export HOME=$scratch GTK_A11Y=none NO_AT_BRIDGE=1
{
    printf 'resize 1280 800\nwait\npause 1\n'
    for ((k = 0; k < 60; ++k)); do
        printf 'turn-z %s\nwait\n' $((3 * k - 90))
    done
    echo print latency
} > "$scratch/steps"
printf '%s\n' 'resize 1280 800' wait 'pause 1' 'note ready' 'pause 9' 'print latency' > "$scratch/pause"
# Takes the knob of the last slider along.
cat > "$scratch/drag" << 'END'
viewer=$1 model=$2 scratch=$3
"$viewer" --actions "$scratch/pause" "$model" > "$scratch/out" 2> "$scratch/log" &
until grep -q ready "$scratch/out"; do sleep 0.1; done
eval "$(xdotool getwindowgeometry --shell "$(xdotool search --name srp-viewer | tail -1)")"
xdotool mousemove $((X + 376)) $((Y + 752)) mousedown 1
for ((k = 1; k <= 60; ++k)); do
    xdotool mousemove $((X + 376 + 4 * k)) $((Y + 752))
    sleep 0.1
done
xdotool mouseup 1
wait
sed -n 's/^latency: /by the pointer: /p' "$scratch/out"
END
for model in box-wing gnss; do
    path=$top/models/$model.obj
    printf '%s: ' "$model"
    xvfb-run -a -s '-screen 0 1920x1200x24' "$build/apps/viewer/srp-viewer" --actions "$scratch/steps" "$path" 2> "$scratch/log" |
        sed 's/^latency: //'
    if command -v xdotool > /dev/null; then
        : > "$scratch/out"
        xvfb-run -a -s '-screen 0 1920x1200x24' bash -eu "$scratch/drag" "$build/apps/viewer/srp-viewer" "$path" "$scratch"
    fi
    for ((k = 0; k < 5; ++k)); do
        began=$(date +%s%N)
        "$build/apps/cli/srp" force "$path" --az 33 --el 20 > "$scratch/out"
        echo $((($(date +%s%N) - began) / 1000))
    done | sort -n | sed -n '3s/$/ microseconds of srp force, files included (median of 5)/p'
done
