#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# srp info: the report, its findings, its JSON.
. "$(dirname "$0")/lib.sh"

expect 0 info "$MODELS/cube.obj"
silent
prints 'cube.obj: 8 vertices, 12 triangles'
prints '2 x 2 x 2 m, from (-1, -1, -1) to (1, 1, 1)'
prints '24 m^2'
prints '8 m^3 in closed components'
prints 'Nothing to complain about.'
grep -Eq '^surface +24 +100.0% +0.5 +0.1 +.*models/cube.mtl$' ../log/out || fail 'row of the material'

# Several files are joined; units scale; --material wins and says so.
expect 0 info "$MODELS/cube.obj" "$MODELS/icosphere-80.obj"
prints 'cube.obj: 8 vertices, 12 triangles'
prints 'icosphere-80.obj: 42 vertices, 80 triangles'
prints 'together       50 vertices, 92 triangles'
expect 0 info "$MODELS/cube.obj"
prints_not 'together'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\nf 1 2 3\n' > one.obj
expect 0 info one.obj --material ''=0,0
prints 'one.obj: 3 vertices, 3 triangles'
prints '3 open edges: 1 of 1 component is not closed'
prints '1 triangle has no area; methods leave it out'
prints '1 triangle repeats another one with the same winding'
printf '1\n1 0 0 1 0 0\n' > one.plates
expect 0 info --plates one.plates
prints '1 plate, 1 m^2'
expect 0 info "$MODELS/cube.obj" --unit ft
prints '0.6096 x 0.6096 x 0.6096 m'
expect 0 info "$MODELS/cube.obj" --unit 2.5
prints '5 x 5 x 5 m'
expect 0 info "$MODELS/cube.obj" --material surface=0.25,0.125,one-sided
grep -Eq '^surface .* 0.25 +0.125 +--material \(one-sided\)$' ../log/out || fail '--material wins'
expect 0 info "$MODELS/cube.obj" --material surfaec=0,0
prints "no face has the material 'surfaec' of --material; did you mean 'surface'?"

# Whatever lies on whatever, shares add up to the whole.
expect 0 info "$MODELS/cube.obj" "$MODELS/cube.obj"
grep -Eq '^surface +24 +100.0% ' ../log/out || fail 'a cube twice is a cube'
prints 'triangles repeat another one with the same winding'
cat > sheet.obj <<'END'
v 0 0 0
v 1 0 0
v 0 1 0
usemtl cells
f 1 2 3
usemtl back
f 3 2 1
f 1 1 2
END
expect 0 info sheet.obj
grep -Eq '^cells +0.5 +50.0% ' ../log/out || fail 'share of the cells'
grep -Eq '^back +0.5 +50.0% ' ../log/out || fail 'share of the back'
prints 'components     1, 1 of them closed'
prints_not 'more than two triangles'
prints 'no area'

# A guess at the unit.
expect 0 info "$MODELS/cube.obj" --unit 1000
prints 'in millimetres it would be 2 m (--unit mm)'
expect 0 info "$MODELS/cube.obj" --unit 100
prints 'in centimetres it would be 2 m (--unit cm)'
expect 0 info "$MODELS/cube.obj" --unit mm
prints 'less than any spacecraft: check --unit'

# Findings: everything wrong at once.
cat > bad.obj <<'END'
mtllib absent.mtl
usemtl gold
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 5 0 0
v 6 0 0
v 6 1 0
v 2 2 2
f 1 2 3 4
f 5 6 7
f 5 6 7
f 7 6 5
f 1 8 8
END
expect 0 info bad.obj
prints 'open edges'
prints '1 triangle repeats another one with the same winding'
prints 'back to back with another one'
prints 'faces are mixed'
prints 'the MTL file absent.mtl does not exist'
prints "the material 'gold' has no optics: give --material 'gold=RHO_S,RHO_D'"
expect 0 info bad.obj --json
prints '"kind": "open-edges"'
prints '"kind": "missing-mtl"'
prints '"kind": "no-optics"'
prints '"rho_s": null'
prints '"source": null'

# An MTL that is there and wrong is an error, with its place.
printf 'newmtl gold\nrho_s 0.9\nrho_d 0.2\n' > absent.mtl
expect 1 info bad.obj
says 'absent.mtl:'
expect 0 info bad.obj --material gold=0.9,0.1

expect 1 info "$MODELS/none.obj"
says 'none.obj: cannot open: No such file or directory'
expect 1 info .
says 'is a directory, expected a file'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n' > index.obj
expect 1 info index.obj
says 'index.obj:4:7: '

# Two files with other optics for the same name.
sed 's/cube.mtl/a.mtl/' "$MODELS/cube.obj" > a.obj
sed 's/cube.mtl/b.mtl/' "$MODELS/cube.obj" > b.obj
printf 'newmtl surface\nrho_s 0.1\nrho_d 0.1\n' > a.mtl
printf 'newmtl surface\nrho_s 0.2\nrho_d 0.1\n' > b.mtl
expect 0 info a.obj b.obj
prints "several MTL files have different optics for the material 'surface': those of b.mtl are taken"
# ... and a scene takes them from there, too.
expect 0 force a.obj b.obj --az 0 --el 0 --basis
prints 'surface: rho_s 0.2'

# JSON of a sound model.
expect 0 info "$MODELS/box-wing.obj" --json
prints '"triangles": 60,'
prints '"name": "panel_back"'
prints '"findings": []'

# Plates.
expect 0 info --plates "$MODELS/cube.plates"
prints '6 plates, 24 m^2'
expect 0 info --plates "$MODELS/cube.plates" --json
prints '"area_m2": 4,'
printf '2\n1 0 0 1 0 0\n' > short.plates
expect 1 info --plates short.plates
says 'short.plates'

# Tables: where they are from, what they hold, how large it is; numbers are those of the other commands.
expect 0 table "$MODELS/box-wing.obj" -o t.nc -o t.spo -o t.txt --mass 850 --step 20 --method raycast --grid 32 \
    --basis --check 20 --title 'a wing'
read -r low high < <(sed -n 's/.*|f| from \([^ ]*\) to \([^ ]*\) m^2.*/\1 \2/p' ../log/out)
expect 0 compare t.nc t.spo
mean=$(sed -n 's/^mean size  A \([^ ]*\) .*/\1/p' ../log/out)
expect 0 info t.nc
silent
prints 't.nc: a table (netcdf)'
grep -qx 'title           a wing' ../log/out || fail 'the title of a table'
grep -qx 'method          raycast (cpu)' ../log/out || fail 'the method of a table'
grep -q '^command         srp table .* --title .a wing.$' ../log/out || fail 'the command of a table'
prints 'made by         srpcore '
prints 'mass            850 kg'
prints 'sunlight        1367 W/m^2 at 1 au'
prints 'forces, moments, standard errors, sums per material'
prints '19 x 10 nodes, steps of 20 x 20 degrees'
prints 'in 20 directions'
prints 'panel_back                  0.05     0.35'
read -r _ got_mean got_low got_high _ < <(grep '^|f| ' ../log/out)
[ "$got_mean $got_low $got_high" = "$mean $low $high" ] ||
    fail "|f| is $got_mean, $got_low to $got_high, elsewhere $mean, $low to $high"
grep -Eq '^standard error +0\.[0-9]+ +0\.[0-9]+ +[0-9.]+ m\^2' ../log/out || fail 'standard errors'
grep -Eq '^acceleration +1\.[0-9]+e-07 ' ../log/out || fail 'accelerations'
prints_not 'Findings'
expect 0 info t.spo
prints 'standard error  not known'
prints 'holds           forces'
prints 'mass            not stated'
expect 0 info t.txt
prints 'mass            850 kg'
expect 0 info t.nc --json
prints '"filled": 190'
prints '"mass_kg": 850,'
prints "\"largest\": ${high%?}"
! command -v python3 > /dev/null || python3 -m json.tool ../log/out > /dev/null || fail 'no JSON'
# What is odd is found; what is no table is refused.
awk 'function turn(x) { return x ~ /^-/ ? substr(x, 2) : "-" x }
     NF >= 5 && $1 + 0 == $1 { $3 = turn($3); $4 = turn($4); $5 = turn($5) } { print }' t.spo > odd.spo
expect 0 info odd.spo
prints 'light pulls from'
awk '$1 == "-180.00" && $2 == "10.00" { $6 = 99 } { print }' t.spo > column.spo
expect 0 info column.spo
grep -Eq '^- line [0-9]+: the sixth column' ../log/out || fail 'the line of a |f| that is belied'
expect 2 info t.nc t.spo
says 't.nc is a table and stands alone'
expect 2 info t.nc --unit mm
says 't.nc is a table and stands alone'
expect 1 info none.nc
says 'none.nc'
cp "$MODELS/cube.obj" cube.spo
expect 1 info cube.spo
says 'cube.spo'
# A run that was interrupted.
for grid in 512 2048 8192 32768; do
    timeout --foreground -s INT 0.3 "$SRP" table "$MODELS/box-wing.obj" -o u.nc --step 10 --method raycast \
        --grid $grid > /dev/null 2>&1
    [ ! -e u.nc.partial ] || break
done
[ -e u.nc.partial ] || fail 'no run could be interrupted in the midst'
expect 0 info u.nc.partial
prints 'u.nc.partial: a table (netcdf)'
grep -Eq 'only [0-9]+ of 703 are filled' ../log/out || fail 'what is filled'
prints_not '|f|'

# The Lunar Reconnaissance Orbiter as it comes: open, without MTL, mixed polygons.
if [ -r "$SHARED/lro/bus.obj" ]; then
    expect 0 info "$SHARED/lro/bus.obj"
    prints 'open edges'
    prints 'bus.mtl does not exist'
    prints 'faces are mixed'
    prints "the material 'foil_gold' has no optics"
else
    skip 'no LRO model in the shared data'
fi
finish
