#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# srp fit-nplate: better than by hand, there and back, a script that GMAT can read, refusals.
. "$(dirname "$0")/lib.sh"

PLATES=$MODELS/box-wing.plates

# residual NAME: RMS [m^2] of a row of the last report ("fit, all").
residual() {
    awk -v name="$1" 'index($0, name) == 1 { sub(name, ""); print $2; exit }' ../log/out
}
# is EXPRESSION: of awk.
is() { awk "BEGIN { exit !($1) }"; }

# The traced table of the box-wing, its plates by hand and by the fit.
expect 0 table "$MODELS/box-wing.obj" -o traced.nc --step 10 --mass 850 --method raytrace \
    --diffuse 4 --grid 32
expect 0 fit-nplate traced.nc --normals "$PLATES" --against "$PLATES" --mesh "$MODELS/box-wing.obj" \
    -o fitted.plates --gmat fitted.script --residuals residuals.txt
silent
prints 'normals  6, of '
prints '2 more repeat others'
by_hand=$(residual 'against, all')
fitted=$(residual 'fit, all')
echo "traced box-wing: RMS by hand $by_hand, fitted $fitted m^2," \
    "ratio $(awk "BEGIN { print $by_hand / $fitted }")"
is "$by_hand > 2.2 * $fitted" || fail "the fit ($fitted) hardly beats the hand ($by_hand)"
is "$(residual 'fit, not shaded') < $fitted" || fail 'shadows do not show'
is "$(residual 'against, not shaded') < $by_hand / 2" || fail 'shadows do not show by hand'

# Read back: the same residual, by this program's own plates and by its own comparison.
expect 0 fit-nplate traced.nc --normals fitted.plates --against fitted.plates -o again.plates
[ "$(residual 'against, all')" = "$fitted" ] || fail 'the written plates have another residual'
[ "$(residual 'fit, all')" = "$fitted" ] || fail 'a second fit differs'
expect 0 table --method nplate --plates fitted.plates -o fitted.nc --step 10
expect 0 compare traced.nc fitted.nc
rms=$(awk '$1 == "vector" { printf "%.5g", $3; exit }' ../log/out)
[ "$rms" = "$fitted" ] || fail "compare says $rms, the fit $fitted"
# ... and by the list of residuals, whose rows are all directions once.
[ "$(grep -vc '^#' residuals.txt)" -eq $((36 * 17 + 2)) ] || fail 'the list of residuals'
awk '!/^#/ { off = $3 * $3 + $4 * $4 + $5 * $5 - $6 * $6
             if (NF != 8 || off > 1e-6 || off < -1e-6 || $8 < 0 || $8 > 1) exit 1 }' residuals.txt ||
    fail 'a row of the residuals does not add up'
is "$(awk '!/^#/ && $6 > m { m = $6 } END { print m }' residuals.txt) > 2" || fail 'no large residual'

# The script: what GMAT's Plate knows, and all of it.
for field in Type PlateNormal Area AreaCoefficient LitFraction SpecularFraction DiffuseFraction; do
    [ "$(grep -c "^Plate[1-6]\\.$field = .*;\$" fitted.script)" -eq 6 ] || fail "script: $field"
done
[ "$(grep -c '^Plate' fitted.script)" -eq 42 ] || fail 'script: a field that GMAT does not know'
grep -qx 'Create Plate Plate1 Plate2 Plate3 Plate4 Plate5 Plate6;' fitted.script ||
    fail 'script: plates are not created'
grep -qx 'Sat.AddPlates = {Plate1, Plate2, Plate3, Plate4, Plate5, Plate6};' fitted.script ||
    fail 'script: plates are not added'
for line in 'Sat.DryMass = 850;' 'FM.SRP.SRPModel = NPlate;' 'FM.SRP.Flux = 1367;' \
    'FM.SRP.Nominal_Sun = 149597870.7;' 'BeginMissionSequence;'; do
    grep -qxF "$line" fitted.script || fail "script: no $line"
done
# The same plates as in our file.
awk '/PlateNormal/ { gsub(/.*\[|\].*/, ""); normal = $0 } /\.Area = / { gsub(/;/, ""); area = $3 }
     /Specular/ { gsub(/;/, ""); spec = $3 }
     /Diffuse/ { gsub(/;/, ""); print normal, area, spec, $3 }' fitted.script > of_script
tail -n +4 fitted.plates | cmp -s - of_script || fail 'script: other plates than in the file'
if [ -n "${GMAT_CONSOLE:-}" ]; then
    "$GMAT_CONSOLE" --run "$PWD/fitted.script" > gmat.log 2>&1 || fail "GMAT: $(tail -3 gmat.log)"
else
    skip 'no GMAT (GMAT_CONSOLE): its script is checked in its text only'
fi
expect 0 fit-nplate fitted.nc --plates 6 --gmat massless.script
says 'massless.script lacks the mass (DryMass)'
! grep -q DryMass massless.script || fail 'a mass out of nowhere'
expect 0 fit-nplate fitted.nc --plates 6 --gmat heavy.script --mass 12.5
grep -qx 'Sat.DryMass = 12.5;' heavy.script || fail 'the mass is not taken'

# Where all directions are shaded there is no residual of the others, which is said.
expect 0 table "$MODELS/dish.obj" -o dish.nc --step 30
expect 0 fit-nplate dish.nc --mesh "$MODELS/dish.obj" --plates 4
prints 'fit, not shaded                   0  from everywhere'
expect 0 table "$MODELS/box-wing.obj" -o two.nc --step 180
expect 1 fit-nplate two.nc --plates 1
says 'these directions do not determine a plate'

# Normals: from the mesh, searched, from a list.
expect 0 fit-nplate traced.nc --mesh "$MODELS/box-wing.obj"
prints 'normals  6, of the mesh'
expect 0 fit-nplate traced.nc --mesh "$MODELS/box-wing.obj" --plates 2
prints 'normals  2, of the mesh, 80.8 %'
expect 0 fit-nplate traced.nc
prints 'normals  8, searched: a better set may exist'
is "$(residual 'fit, all') < $fitted" || fail 'eight searched plates are worse than six given ones'
printf '# by hand\n1 0 0\n\n-1 0 0 # back\n0 2 0\r\n0\t-3\t0\n0 0 1\n0 0 -1\n' > normals.txt
expect 0 fit-nplate traced.nc --normals normals.txt
[ "$(residual 'fit, all')" = "$fitted" ] || fail 'the same normals from a list'
# Four pairs of opposite plates: areas are not told apart, and it says so.
printf '1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n1 1 1\n-1 -1 -1\n' > pairs.txt
expect 0 fit-nplate traced.nc --normals pairs.txt
prints 'Areas of opposite plates are not told apart'
# A mesh in another unit is another shape.
expect 0 fit-nplate traced.nc --mesh "$MODELS/box-wing.obj" --unit mm --normals normals.txt
says 'warning: traced.nc is of another shape than the mesh'

# Refusals.
rm -f ./*
expect 0 table "$MODELS/box-wing.obj" -o coarse.nc -o coarse.spo --step 90
expect 1 fit-nplate coarse.nc --normals "$PLATES"
says 'coarse.nc: 6 directions give 18 numbers, too few for 6 plates'
expect 1 fit-nplate coarse.nc
says 'too few for 8 plates'
expect 0 table "$MODELS/box-wing.obj" -o good.nc -o good.spo --step 20
printf '1 0 0\n0.9999999999999 1e-8 0\n1e-8 1 0\n' > near.txt
expect 0 fit-nplate good.nc --normals near.txt
printf '1 0 0\n' > one.txt
expect 2 fit-nplate good.nc --normals one.txt --plates 3
says '--normals one.txt says how many'
expect 2 fit-nplate good.nc --shadow 0.1
says '--shadow: of which shape? --mesh MODEL.obj'
expect 2 fit-nplate good.nc --unit mm
says '--unit is that of --mesh MODEL.obj'
expect 2 fit-nplate good.nc --mass 3
says '--mass is for --gmat FILE'
expect 2 fit-nplate good.nc --normals mesh
says '--mesh MODEL.obj'
expect 1 fit-nplate good.nc --normals none.txt
says 'none.txt: cannot read'
printf '1 0 0\n0 0 0\n' > zero.txt
expect 1 fit-nplate good.nc --normals zero.txt
says 'zero.txt:2: expected the three finite numbers of a normal'
for bad in '1 0' '1 0 0 0' '1 0 x' 'nan 0 0'; do
    echo "$bad" > bad.txt
    expect 1 fit-nplate good.nc --normals bad.txt
    says 'bad.txt:1: expected the three finite numbers of a normal'
done
echo '# nothing' > empty.txt
expect 1 fit-nplate good.nc --normals empty.txt
says 'empty.txt: holds no normals'
expect 1 fit-nplate good.nc --mesh "$MODELS/box-wing.obj" --plates 60
says '--plates 60: the mesh has 6 groups'
expect 2 fit-nplate good.nc --plates 65
says 'a whole number from 1 to 64'
expect 2 fit-nplate
says 'expected one table'
expect 1 fit-nplate none.nc
expect 1 fit-nplate good.nc --mesh none.obj
says 'none.obj'
expect 1 fit-nplate good.nc --against none.plates
says 'none.plates'
expect 3 fit-nplate good.nc -o none/x.plates
says 'none/x.plates: cannot write'
expect 2 fit-nplate good.nc -o good.nc
says 'input and output at once'
expect 2 fit-nplate good.nc -o x --gmat x
says 'x is given twice'
awk 'NF == 11 && $1 + 0 == $1 { $3 = $4 = $5 = $6 = $7 = $8 = $9 = $10 = $11 = 0 } { print }' \
    good.spo > allzero.spo
expect 1 fit-nplate allzero.spo
says 'the force is 0 from all directions'
sed 's/^\( *[-0-9.]* *[-0-9.]* *[-0-9.e+]* *[-0-9.e+]*\) .*/\1/' good.spo > short.spo
expect 1 fit-nplate short.spo
says 'short.spo'
# As many plates of a mesh as can be told apart; more on request are refused with what helps.
expect 0 table "$MODELS/dish.obj" -o dish.nc --step 20
expect 0 fit-nplate dish.nc --mesh "$MODELS/dish.obj" -o dish.plates
says 'cannot be told apart in these directions: the'
says '(--plates N chooses)'
prints_not '-0.00000'
expect 1 fit-nplate dish.nc --mesh "$MODELS/dish.obj" --plates 54
says '(--plates N)'
expect 0 table "$MODELS/gnss.obj" -o gnss.nc --step 15
expect 0 fit-nplate gnss.nc --mesh "$MODELS/gnss.obj"
says 'plates are not determined (+- exceeds them)'
printf '1 0 0\n0.99999 0.004 0\n-1 0 0\n' > close.txt
expect 0 fit-nplate good.nc --normals close.txt
says 'one plate would do'
rm -f dish.plates
# A table that is not complete.
for grid in 512 2048 8192 32768; do
    timeout --foreground -s INT 0.3 "$SRP" table "$MODELS/box-wing.obj" -o t.nc --step 10 \
        --method raycast --grid $grid > /dev/null 2>&1
    [ ! -e t.nc.partial ] || break
done
mv t.nc.partial part.nc || fail 'no run could be interrupted in the midst'
expect 1 fit-nplate part.nc
says 'nodes are there, expected a complete table'
expect 1 compare part.nc good.nc
says 'part.nc: only'
[ ! -e x ] || fail 'a refused fit wrote a file'
finish
