#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Reports how far two runs of GMAT are apart: largest and last distance of the positions in two
# reports of the scripts beside this file (elapsed s, x y z [km], vx vy vz [km/s], ...).
#
#   bash gmat_scripts/compare.sh A.txt B.txt
#
# Rows are paired by their elapsed times, which must agree to a second; the rest is taken out along
# the velocity, since GMAT stops within microseconds, in which a satellite moves by millimetres.
set -euo pipefail
[ $# -eq 2 ] || { echo "usage: compare.sh A.txt B.txt" >&2; exit 2; }

paste -d ' ' "$1" "$2" | tr -s ' \t' ' ' | sed 's/^ //' | awk -v a="$1" -v b="$2" '
    NF % 2 != 0 || NF < 14 { printf "%s and %s: row %d has no partner\n", a, b, NR; bad = 1; exit 1 }
    {
        n = NF / 2
        dt = $(n + 1) - $1
        if (dt > 1 || dt < -1) {
            printf "%s and %s: row %d is %g s apart\n", a, b, NR, dt
            bad = 1
            exit 1
        }
        for (i = 1; i <= NF; ++i) {
            if ($i !~ /^[-+]?[0-9.]+([eE][-+]?[0-9]+)?$/) {
                printf "%s and %s: row %d holds %s\n", a, b, NR, $i
                bad = 1
                exit 1
            }
        }
        sum = 0
        for (i = 2; i <= 4; ++i) {
            d = $(n + i) - $i - dt * $(i + 3)
            sum += d * d
        }
        last = 1e6 * sqrt(sum)
        if (last > largest) { largest = last; at = $1 }
    }
    END {
        if (bad) exit 1
        if (NR == 0) { printf "%s: no rows\n", a; exit 1 }
        printf "%d rows: largest distance %.3f mm at %.0f s, last %.3f mm\n", NR, largest, at, last
    }'
