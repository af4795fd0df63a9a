#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# srp compare: zero against itself, the paper's order of magnitude, other grids, refusals.
. "$(dirname "$0")/lib.sh"

expect 0 table "$MODELS/box-wing.obj" -o exact.nc -o exact.spo -o exact.txt --step 20 --mass 850
expect 0 table "$MODELS/box-wing.obj" -o fine.nc --step 10
expect 0 table "$MODELS/box-wing.obj" -o odd.nc --step 12
expect 0 table --method nplate --plates "$MODELS/box-wing.plates" -o plates.nc --step 20
expect 0 table --method cannonball --cr 1.25 --area 55.7 -o ball.nc --step 20

# value ROW COLUMN: a number of the first table that was printed.
value() { awk -v row="$1" -v column="$2" '$1 == row { print $column; exit }' ../log/out; }
# of_json KEY [ROW]: a number of the last JSON that was printed.
of_json() {
    awk -v key="\"$1\":" -v row="\"${2-}\":" '
        { gsub(/,/, "") } row == "\"\":" || $1 == row { on = 1 } on && $1 == key { print $2; exit }
    ' ../log/out
}
# within GOT LOW HIGH
within() {
    awk -v got="$1" -v low="$2" -v high="$3" 'BEGIN { exit !(got != "" && got >= low && got <= high) }'
}

expect 0 compare exact.nc exact.nc
silent
for row in x y z length vector; do
    for column in 2 3 4 5; do
        within "$(value $row $column)" 0 0 || fail "$row is not 0 against itself"
    done
done
expect 0 compare exact.nc exact.spo
within "$(value vector 5)" 0 0 || fail 'the .spo is not the .nc'
expect 0 compare exact.nc exact.txt --fail-above 1e-14
# Other grids: at the nodes of the finer, the coarser is interpolated.
expect 0 compare exact.nc fine.nc --fail-above 0.15
prints 'exact, 20 x 20 degrees, interpolated: bicubic'
prints 'from 614 directions, steps of 10 x 10 degrees'
prints_not '10 x 10 degrees, interpolated'
bicubic=$(value vector 3)
expect 0 compare fine.nc exact.nc --interpolation bilinear
prints 'from 614 directions'
within "$bicubic" 1e-3 "$(value vector 3)" || fail 'bicubic is not better than bilinear'
expect 0 compare exact.nc odd.nc --interpolation spline
prints 'from 422 directions, steps of 12 x 12 degrees'
expect 2 compare exact.nc fine.nc --interpolation cubic
says '--interpolation cubic: expected bilinear, bicubic or spline'
expect 0 table "$MODELS/box-wing.obj" -o rough.nc --step 180
expect 1 compare rough.nc exact.nc
says 'rough.nc: cannot be interpolated'

# Orders of magnitude of AAS 20-481, Table 5: mass 1 kg, cannonball 2.5e-4, N-plate 5.9e-6 m/s^2.
expect 0 compare exact.nc ball.nc --mass 1 --json
ball=$(awk -v d="$(of_json mean vector)" -v k="$(of_json m_s2_per_m2)" 'BEGIN { print d * k }')
expect 0 compare exact.nc plates.nc --mass 1 --json
plates=$(awk -v d="$(of_json mean vector)" -v k="$(of_json m_s2_per_m2)" 'BEGIN { print d * k }')
echo "mean difference of the acceleration: cannonball $ball, N-plate $plates m/s^2"
within "$ball" 1e-4 5e-4 || fail "cannonball is off by $ball"
within "$plates" 2e-6 1.2e-5 || fail "N-plate is off by $plates"

# The mass: from the option, else from A.
expect 0 compare exact.txt plates.nc
prints 'Accelerations of 850 kg'
expect 0 compare plates.nc exact.txt
prints_not 'Accelerations'
expect 0 compare plates.nc exact.txt --mass 12.5 --flux 1361
prints 'Accelerations of 12.5 kg, 1 au from the Sun, 1361 W/m^2'

# Moments.
expect 0 table "$MODELS/box-wing.obj" -o moved.nc --step 20 --reference 0,0,0.5
expect 0 compare exact.nc exact.nc --moment
prints 'moments [m^3]'
expect 1 compare exact.nc plates.nc --moment
says 'plates.nc: holds no moments'
expect 1 compare exact.nc moved.nc --moment
says 'moments are about (0, 0, 0.5) m, expected (0, 0, 0) m'

# A limit that is passed: a result, and status 1.
last='compare --fail-above'
"$SRP" compare exact.nc plates.nc --fail-above 0.01 > ../log/out 2> ../log/err
[ $? -eq 1 ] || fail 'status with --fail-above passed'
prints 'vector'
says 'of the mean length, more than 0.01'

# Refusals.
expect 1 compare exact.nc none.nc
says 'none.nc'
expect 2 compare exact.nc
says 'expected two tables'
expect 2 compare exact.nc plates.nc --fail-above x
says '--fail-above x: expected'
expect 2 compare exact.nc table.json
says 'unknown ending'
awk 'NF == 11 && $1 + 0 == $1 { $3 = $4 = $5 = $6 = $7 = $8 = $9 = $10 = $11 = 0 } { print }' \
    exact.spo > zero.spo
expect 1 compare exact.nc zero.spo
says 'zero.spo: the force is 0 from all directions'
awk 'function turn(x) { return x ~ /^-/ ? substr(x, 2) : "-" x }
     NF == 11 && $1 + 0 == $1 { $3 = turn($3); $4 = turn($4); $5 = turn($5) } { print }' \
    exact.spo > wrong.spo
expect 1 compare wrong.spo exact.nc
says "wrong.spo: light pulls from 100 % of the directions"
says "'srp convert --flip'"
sed '0,/^Azimuth.*/s/ Force(Z)//; s/^\( *[-0-9.]* *[-0-9.]* *[-0-9.e+]* *[-0-9.e+]*\) .*/\1/' \
    exact.spo > short.spo
expect 1 compare exact.nc short.spo
says 'short.spo'
for unused in --map '--width=900' '--view=30,30'; do
    expect 2 compare exact.nc plates.nc "$unused"
    says 'are for a figure: -o FIG'
done
finish
