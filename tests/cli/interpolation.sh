#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# srp table --check and --max-error: the error between nodes.
. "$(dirname "$0")/lib.sh"

wing=$MODELS/box-wing.obj

expect 0 table "$wing" -o a.nc --step 15 --check 200
silent
prints 'interpolation error of f in 200 directions, mean and largest:'
prints '  bilinear  '
prints '  spline    '
cp ../log/out first
expect 0 table "$wing" -o b.nc --step 15 --check 200 --threads 1
tail -n 3 ../log/out | cmp -s - <(tail -n 3 first) || fail 'threads change the errors'
# Errors go with the .nc, and only with it.
expect 0 convert a.nc c.nc
prints 'in 200 directions'
expect 0 convert a.nc c.spo
expect 0 convert c.spo d.nc
prints_not 'directions'

# A cannonball is linear in s.
expect 0 table --method cannonball --cr 1.5 --area 2 -o ball.nc --step 30 --check 50
grep -qE '  spline +[0-9.]+e-1[4-9] and' ../log/out || fail 'spline does not reproduce a sphere'
# Too coarse for all but one.
expect 0 table "$wing" -o e.nc --az-step 120 --el-step 90 --check 10
prints '  bicubic   steps are too large for it'

# The step that is asked for by its error.
expect 0 table "$wing" -o f.nc --max-error 0.05 --check 300
prints 'in 300 directions'
share=$(sed -n 's/^  bilinear .* and \([0-9.e-]*\) % of.*/\1/p' ../log/out)
awk -v x="$share" 'BEGIN { exit !(x > 0 && x <= 5) }' || fail "error of $share %, asked for 5 %"
expect 0 table "$wing" -o g.nc --max-error 0.05 --check 300 --interpolation bicubic
expect 0 table "$MODELS/cube.obj" -o h.nc --max-error 1e-9 --check 10
says 'warning: with steps of 1 degree the interpolation error is still '
prints '65341 nodes'

# Nothing is off by nothing.
expect 0 table --method cannonball --cr 0 --area 2 --max-error 0.1 --check 20 -o zero.nc
prints '(0 and 0 % of'
prints 'steps of 30 x 30 degrees'

# What excludes what.
expect 2 table "$wing" -o i.nc --max-error 0.1 --step 5
says '--max-error chooses the step: it excludes --step'
expect 2 table "$wing" -o i.nc --max-error 0.1 --el-step 5
says 'excludes --el-step'
expect 2 table "$wing" -o i.nc --interpolation spline
says '--max-error is about, which is missing'
expect 2 table "$wing" -o i.nc --max-error 0.1 --interpolation cubic
says 'expected bilinear, bicubic or spline'
expect 2 table "$wing" -o i.nc --check 0
expect 2 table "$wing" -o i.nc --check many
expect 2 table "$wing" -o i.nc --max-error=-1
check 'nothing is written by wrong usage' test ! -e i.nc

finish
