#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# srp reoptic: the numbers of a fresh run, where they are from, refusals.
. "$(dirname "$0")/lib.sh"

wing=$MODELS/box-wing.obj
how=(--step 30 --reference '0.2,-0.4,1.1')
worn=(--material 'cells=0.11,0.07' --material 'bus=0.42,0.19')
expect 0 table "$wing" -o old.nc "${how[@]}" --basis
expect 0 table "$wing" -o fresh.spo -o fresh.txt "${how[@]}" "${worn[@]}" --mass 850

# near A B [ROWS]: the rows of numbers are the same to 1e-12 of the largest number.
near() {
    awk '$1 + 0 == $1 && NF >= 5' "$1" > a.num
    awk '$1 + 0 == $1 && NF >= 5' "$2" > b.num
    [ "$(wc -l < a.num)" -eq "${3:-91}" ] || fail "$1 has other rows than expected"
    paste a.num b.num | awk '
        { n = NF / 2; for (i = 1; i <= n; ++i) { d = $i - $(i + n); if (d < 0) d = -d
              v = $i < 0 ? -$i : $i; if (v > most) most = v; if (d > off) off = d } }
        END { exit !(off <= 1e-12 * most) }' || fail "$1 and $2 differ"
    rm a.num b.num
}

expect 0 reoptic old.nc "${worn[@]}" -o new.nc -o new.spo -o new.txt --mass 850
silent
prints 'new.spo'
prints '91 nodes'
prints 'no sampling error'
near fresh.spo new.spo
near fresh.txt new.txt
grep -q '^Center of Mass *: (0.2' new.spo || fail 'the reference point is lost'
traced=$(grep '^Traced optics hash' new.spo) || fail 'the .spo does not say what it is from'
grep -q '^# traced optics hash' new.txt || fail 'the .txt does not say what it is from'
[ "$(grep '^Optics hash' new.spo)" = "$(grep '^Optics hash' fresh.spo)" ] ||
    fail 'the optics hash is not that of the optics'
! grep -q '^Traced' fresh.spo || fail 'a fresh table says that it is not'
if command -v ncdump > /dev/null; then
    ncdump -h new.nc > ../log/out
    prints 'command_line = "srp reoptic old.nc --material cells=0.11,0.07'
    prints 'traced_command_line = "srp table '
    prints 'traced_optics_hash = "'
    prints 'mass_kg = 850.'
    prints_not 'bounce_optics_hash'
else
    skip 'no ncdump: the attributes are checked in the unit tests only'
fi

# Again, from the result, and with all of it in an MTL file that has more than that.
expect 0 reoptic new.nc --material cells=0.07,0.02 --material bus=0.3,0.25 -o back.spo
expect 0 table "$wing" -o first.spo "${how[@]}"
near first.spo back.spo
[ "$(grep '^Traced' back.spo)" = "$traced" ] || fail 'the traced optics changed'
printf 'newmtl cells\nrho_s 0.11\nrho_d 0.07\nnewmtl bus\nrho_s 0.9\nrho_d 0\nnewmtl moon\nrho_s 0\nrho_d .1\n' > worn.mtl
expect 0 reoptic old.nc --mtl worn.mtl --material bus=0.42,0.19 -o mtl.spo --title 'worn wing'
near fresh.spo mtl.spo
grep -q 'worn wing' mtl.spo || fail 'the title is missing'
expect 0 convert new.nc converted.spo
grep -q '^Traced optics hash' converted.spo || fail 'converting forgets the traced optics'

# A resumed run does not take such a table for its own.
cp new.nc again.nc.partial
expect 1 table "$wing" -o again.nc "${how[@]}" "${worn[@]}" --basis
says 'other optics than it was traced with'
rm again.nc.partial

# Sampled sums: the error is there, and larger.
expect 0 table "$wing" -o ray.nc --step 45 --method raycast --grid 64 --basis
expect 0 reoptic ray.nc "${worn[@]}" -o ray.spo
prints 'standard error up to '

# Reflected light.
expect 0 table "$wing" -o bounce.nc --step 45 --method raytrace --grid 16 --basis
expect 1 reoptic bounce.nc "${worn[@]}" -o x.nc
says 'bounce.nc: the table holds reflected light (method raytrace)'
says '--keep-bounce'
expect 0 reoptic bounce.nc "${worn[@]}" -o kept.nc -o kept.spo --keep-bounce
says 'warning: reflected light was kept as traced'
grep -q '^Reflected light *: as traced' kept.spo || fail 'the .spo does not say what was kept'
if command -v ncdump > /dev/null; then
    ncdump -h kept.nc > ../log/out
    prints 'bounce_optics_hash = "'
fi

# No reflections, nothing to keep: the numbers of a fresh run.
direct=(--step 45 --method raytrace --reflections 0 --grid 16 --reference '0.2,-0.4,1.1')
expect 0 table "$wing" -o direct.nc "${direct[@]}" --basis
expect 0 table "$wing" -o want.txt "${direct[@]}" "${worn[@]}" --mass 850
expect 0 reoptic direct.nc "${worn[@]}" -o got.nc -o got.txt --mass 850
silent
near want.txt got.txt 45
expect 0 reoptic direct.nc "${worn[@]}" --keep-bounce -o got.nc
says_not 'reflected light was kept'

# Refusals.
expect 2 reoptic old.nc --material cels=0.1,0.1 -o x.nc
says "the table has no material 'cels'; its materials are: 'bus', 'panel_back', 'cells', 'boom'"
says "did you mean 'cells'?"
expect 2 reoptic old.nc --material zinc=0.1,0.1 -o x.nc
says "'boom'"
says_not 'did you mean'
expect 1 reoptic old.nc --material cells=0.1,0.1,one-sided -o x.nc
says "old.nc: material 'cells' has two sides in the table"
expect 2 reoptic old.nc --material cells=0.7,0.4 -o x.nc
says 'rho_s + rho_d'
expect 2 reoptic old.nc --material cells -o x.nc
says 'expected NAME=RHO_S,RHO_D'
expect 2 reoptic old.nc -o x.nc
says 'no optics: --material NAME=RHO_S,RHO_D or --mtl FILE'
expect 2 reoptic old.nc "${worn[@]}"
says 'no output: -o FILE.nc'
expect 2 reoptic "${worn[@]}" -o x.nc
says 'expected one file, TABLE, found 0'
expect 2 reoptic old.nc "${worn[@]}" -o x.txt
says '--mass KG'
expect 2 reoptic old.nc "${worn[@]}" -o old.nc
says 'old.nc is input and output at once'
expect 1 reoptic fresh.spo "${worn[@]}" -o x.nc
says 'fresh.spo: the table keeps no sums per material'
says '--basis'
expect 1 reoptic none.nc "${worn[@]}" -o x.nc
says 'none.nc'
expect 1 reoptic old.nc --mtl none.mtl -o x.nc
says 'none.mtl'
printf 'newmtl moon\nrho_s 0\nrho_d .1\n' > moon.mtl
expect 1 reoptic old.nc --mtl moon.mtl -o x.nc
says 'moon.mtl: has optics for none of the materials of old.nc'
expect 3 reoptic old.nc "${worn[@]}" -o none/x.nc
says 'none/x.nc: cannot write'
! [ -e x.nc ] || fail 'a refused run left a file'
finish
