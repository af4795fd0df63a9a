#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The pictures of srp-viewer in the user guide, made by the program itself without a screen (Xvfb).
#   scripts/viewer-pictures.sh [SRP-VIEWER] [FOLDER] [WIDTHxHEIGHT]
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
viewer=${1:-$top/build/release/apps/viewer/srp-viewer}
folder=${2:-$top/docs/figures}
size=${3:-1280x800}
steps=$(mktemp -d)
trap 'rm -rf "$steps"' EXIT
export HOME=$steps GTK_A11Y=none NO_AT_BRIDGE=1

# picture NAME MODEL: the steps come on standard input.
picture() {
    cat > "$steps/$1"
    printf 'wait\nscreenshot %s\n' "$folder/viewer-$1.png" >> "$steps/$1"
    xvfb-run -a -s '-screen 0 2048x1280x24' "$viewer" --size "$size" --actions "$steps/$1" "$top/models/$2" 2> "$steps/log" ||
        { cat "$steps/log" >&2; exit 1; }
    echo "$folder/viewer-$1.png"
}

# turns ACTION FROM TO STEP
turns() {
    local at
    for ((at = $2; at <= $3; at += $4)); do
        printf '%s %s\nwait\n' "$1" "$at"
    done
}

{
    printf 'enter mass 850\nrecord\n'
    turns turn-z -150 150 6
    turns turn-y -60 60 6
    printf 'record\nturn-z -30\nturn-y 20\n'
} | picture spacecraft box-wing.obj

{
    printf 'enter mass 6200\nturn-z -12\nturn-y -42\ncamera -58,16,1.15\nrecord\n'
    turns turn-y -75 -15 5
    printf 'record\nturn-y -42\n'
} | picture shield sun-shield.obj

picture graphics box-wing.obj << END
tab graphics
az-step 5
el-step 5
compute-table
wait
END

picture compare box-wing.obj << END
az-step 5
el-step 5
compute-table
wait
tab compare
fit 8
wait
END

picture large sun-shield.obj << END
resize 1920 1080
az-step 5
el-step 5
compute-table
wait
tab compare
fit 12
wait
END

picture orbit box-wing.obj << END
tab orbit
mission $top/models/missions/geo-box-wing.yaml
versus $top/models/missions/geo-cannonball.yaml
propagate
wait
END
