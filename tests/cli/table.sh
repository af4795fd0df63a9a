#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# srp table: files, grids, titles; the same table whatever the threads.
. "$(dirname "$0")/lib.sh"

cube=$MODELS/cube.obj

expect 0 table "$cube" -o a.nc -o a.spo --output=a.txt --mass 10
silent # no bar without a terminal
prints 'a.nc'
prints 'a.spo'
prints 'a.txt'
prints '2701 nodes, steps of 5 x 5 degrees, |f| from '
prints ', no sampling error'
holds a.nc a.spo a.txt
grep -q 'Record count *: 2701' a.spo || fail 'records of a.spo'
# Node (0, 0) of the cube: f = -4 (1 - rho_s + 2 (rho_s + rho_d/3)) x.
awk '$1 == 0 && $2 == 0 && NF >= 5 { found = $3 < -6.266666 && $3 > -6.266667 }
     END { exit !found }' a.spo || fail 'node (0, 0) of a.spo'

# Grids.
expect 0 table "$cube" -o b.spo --step 30
prints '91 nodes, steps of 30 x 30 degrees'
expect 0 table "$cube" -o b.spo --az-step 40 --el-step 22.5
prints '90 nodes, steps of 40 x 22.5 degrees'
rm -f b.spo

# Threads do not matter, not even to a byte.
for threads in 1 2 3; do
    mkdir "$threads"
    expect 0 table "$MODELS/dish.obj" -o "$threads/d.spo" --step 30 --threads "$threads"
done
check 'threads change nothing' cmp -s 1/d.spo 2/d.spo
check 'threads change nothing' cmp -s 1/d.spo 3/d.spo
rm -r 1 2 3

# Title, model without files, plates, several files.
expect 0 table --method cannonball --cr 1.5 --area 2 -o ball.spo --step 45 --title 'Ball & chain'
grep -q 'Ball & chain' ball.spo || fail 'the title is missing'
expect 0 table --method nplate --plates "$MODELS/cube.plates" -o plates.spo --step 45 --basis -o p.nc
expect 0 table "$cube" -o mesh.spo --step 45
paste plates.spo mesh.spo | awk 'NF == 22 { d = $3 - $14; if (d > 1e-12 || d < -1e-12) exit 1 }' ||
    fail 'the cube and its plates differ'
expect 0 table "$cube" "$MODELS/icosphere-80.obj" -o both.nc --step 45 --basis
expect 0 table "$cube" -o ref.spo -o ref.nc --step 45 --reference 0,0.5,0 --flux 1400
# About c instead of the origin: t' = t - c x f, in the torque columns and in the head.
paste mesh.spo ref.spo | awk '
    NF == 22 && $1 + 0 == $1 {
        off = $18 - ($7 - 0.5 * $5); if (off < 0) off = -off
        mid = $19 - $8; if (mid < 0) mid = -mid
        end = $20 - ($9 + 0.5 * $3); if (end < 0) end = -end
        if (off + mid + end > 1e-12) exit 1
        moved += ($18 - $7) ^ 2; rows++
    }
    END { if (rows != 45 || moved < 1) exit 1 }' || fail 'the torque is not about the reference point'
grep -q '^Center of Mass *: (0, 0.5, 0)' ref.spo || fail 'the .spo lacks the reference point'
if command -v ncdump > /dev/null; then
    ncdump -h ref.nc > ../log/out
    prints 'reference_point_m = 0., 0.5, 0.'
else
    skip 'no ncdump'
fi

# Raycast.
expect 0 table "$MODELS/box-wing.obj" -o r.nc --step 30 --method raycast --grid 64 --seed 3
prints 'standard error up to '
expect 0 table "$cube" -o w.nc --step 30 --method raycast --window=-1.75,1.75,-1.75,1.75 --grid 64

# Wrong input: nothing is left.
rm -r ./*
expect 1 table "$MODELS/none.obj" -o a.nc
says 'none.obj: cannot open'
printf 'v 0 0 0\nf 1 1 1\n' > bad.obj
expect 1 table bad.obj -o a.nc
holds bad.obj
# One angle alone keeps the default of the other.
expect 0 table "$MODELS/cube.obj" -o az.nc --az-step 30
prints 'steps of 30 x 5 degrees'

finish
