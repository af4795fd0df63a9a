#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# srp force: numbers of known cases, every method and option, text and JSON.
. "$(dirname "$0")/lib.sh"

# value KEY [INDEX]: a number of the last JSON on stdout.
value() {
    sed -n "s/^ *\"$1\": *//p" ../log/out | head -1 | tr -d '[],' | awk -v i="${2:-1}" '{ print $i }'
}
# near GOT WANT [RELATIVE]: with an absolute floor for zeros.
near() {
    awk -v a="$1" -v b="$2" -v r="${3:-1e-12}" 'BEGIN {
        d = a - b; if (d < 0) d = -d; m = b < 0 ? -b : b; exit !(a != "" && d <= r * m + 1e-15) }'
}
same() { near "$@" || fail "got $1, expected $2"; }

# Cannonball: f = -Cr A s; P = 1367/c (AU/r)^2.
expect 0 force --method cannonball --cr 1.8 --area 20 --az 0 --el 0 --mass 850 --json
silent
same "$(value f_m2 1)" -36
same "$(value lit_area_m2)" 20
same "$(value pressure_n_m2)" 4.5598211813e-06 1e-10
same "$(value force_n 1)" "$(awk 'BEGIN { print -36 * 1367 / 299792458 }' OFMT=%.17g)" 1e-5
same "$(value acceleration_m_s2 1)" -1.931218382668e-07 1e-9
prints_not '"t_m3"' # a method without moments gives none
prints_not '-0,'
expect 0 force --method cannonball --cr 1.8 --area 20 --az 0 --el 0
prints_not '-0.000'
expect 0 force --method cannonball --cr 1.8 --area 20 --az 90 --el 0 --distance-au 2 --flux 1400 --json
same "$(value f_m2 1)" 0
same "$(value f_m2 2)" -36
same "$(value pressure_n_m2)" "$(awk 'BEGIN { printf "%.17g", 1400 / 299792458 / 4 }')"
prints_not '"mass_kg"'

# Cube, edge 2, Sun on +X: f = -4 (1 - rho_s + 2 (rho_s + rho_d/3)) x.
for model in "--method nplate --plates $MODELS/cube.plates" "$MODELS/cube.obj"; do
    # shellcheck disable=SC2086
    expect 0 force $model --az 0 --el 0 --json
    silent
    same "$(value f_m2 1)" -6.2666666666666666
    same "$(value lit_area_m2)" 4
    same "$(value f_error_m2)" 0
done

# Moments: t' = t - d x f. The same force off the centre turns.
expect 0 force "$MODELS/cube.obj" --az 0 --el 0 --reference 0,0.5,0 --json
same "$(value t_m3 1)" 0
same "$(value t_m3 3)" -3.1333333333333333
same "$(value reference_m 2)" 0.5

# Optics from the command line; units; several files.
expect 0 force "$MODELS/cube.obj" --az 0 --el 0 --material surface=0,0 --json
same "$(value f_m2 1)" -4
expect 0 force "$MODELS/cube.obj" --az 0 --el 0 --unit cm --json
same "$(value f_m2 1)" -6.2666666666666666e-4
awk '$1 == "v" { $2 += 10 } { print }' "$MODELS/cube.obj" > far.obj
cp "$MODELS/cube.mtl" .
expect 0 force "$MODELS/cube.obj" far.obj --az 90 --el 0 --json
same "$(value f_m2 2)" -12.533333333333333
expect 0 force "$MODELS/cube.obj" far.obj --az 0 --el 0 --json
same "$(value f_m2 1)" -6.2666666666666666 # one in the shadow of the other

# Sums per material.
expect 0 force "$MODELS/box-wing.obj" --az 20 --el 35 --basis
prints 'Sums per material'
prints 'panel_back: rho_s 0.05, rho_d 0.35'
expect 0 force "$MODELS/cube.obj" --az 0 --el 0 --basis --json
same "$(value a_m2)" 4
prints '"name": "surface"'

# Text.
expect 0 force "$MODELS/cube.obj" --az 0 --el 0 --mass 10
prints 'method             exact (cpu)'
prints 'area vector f      -6.266666667e+00'
prints '(no sampling)'
prints 'torque T'
prints 'acceleration a'
prints '1367 W/m^2 at 1 au'

# Raycast: every option of the lattice; the error is an estimate; the seed is part of the result.
expect 0 force "$MODELS/box-wing.obj" --az 20 --el 35 --json
exact=$(value f_m2 1)
ray=(force "$MODELS/box-wing.obj" --az 20 --el 35 --method raycast --json)
expect 0 "${ray[@]}" --grid 512
same "$(value f_m2 1)" "$exact" 5e-3
check 'an error is estimated' awk -v e="$(value f_error_m2)" 'BEGIN { exit !(e > 0) }'
cp ../log/out first
expect 0 "${ray[@]}" --grid 512 --threads 1
check 'threads do not change the result' cmp -s first ../log/out
expect 0 "${ray[@]}" --grid 512 --seed 7
! cmp -s first ../log/out || fail 'the seed has no effect'
expect 0 "${ray[@]}" --pixel 0.05
same "$(value f_m2 1)" "$exact" 2e-2
expect 0 "${ray[@]}" --window=-11,11,-11,11 --grid 256
silent
same "$(value samples)" 65536
expect 0 "${ray[@]}" --window=-11,11,-5,5 --columns 220 --rows 100
says 'the model reaches 9.'
says '--window may miss parts of it'
same "$(value samples)" 22000
# The tolerance: f_error <= REL |f|, or it is said that it was missed.
expect 0 "${ray[@]}" --tolerance 1e-3
silent
prints '"tolerance_missed": false'
check 'the tolerance is kept' awk -v e="$(value f_error_m2)" -v x="$(value f_m2 1)" \
    -v y="$(value f_m2 2)" -v z="$(value f_m2 3)" \
    'BEGIN { exit !(e > 0 && e <= 1e-3 * sqrt(x * x + y * y + z * z)) }'
expect 0 "${ray[@]}" --tolerance 1e-12
says 'warning: the tolerance was not reached'
prints '"tolerance_missed": true'

# At the ends of what options take, every number is still one.
finite() { ! grep -iqE '[^a-z](inf|nan|null)' ../log/out || fail 'a result is not finite'; }
for mass in 1e-30 1e30; do
    for scale in "--unit 1e29" "--unit 1e-70"; do
        for distance in 1e-30 1e30; do
            # shellcheck disable=SC2086
            expect 0 force "$MODELS/dish.obj" $scale --az 20 --el 35 --mass $mass \
                --distance-au $distance --flux 1e30 --reference 1e30,-1e30,1e30
            finite
        done
    done
done
expect 0 force --method cannonball --cr 1e30 --area 1e30 --az 20 --el 35 --mass 1e-30 --flux 1e30 --json
finite

# A triangle too large to be multiplied is refused, not dropped beside others.
printf 'v 0 0 0\nv 1e160 0 0\nv 0 1e160 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 4 5\n' > vast.obj
expect 1 force vast.obj --az 0 --el 90 --material ''=0,0
says "vast.obj:2:3: x of the vertex is 1e+160 m, expected at most 1e+30 m: is its unit right?"
expect 1 info vast.obj
says 'vast.obj:2:3: '
expect 1 info "$MODELS/cube.obj" --unit 1e100
says 'is its unit right?'

# Wrong input.
expect 1 force "$MODELS/none.obj" --az 0 --el 0
says 'none.obj: cannot open'
cat > naked.obj <<'END'
usemtl gold
v 0 0 0
v 1 0 0
v 0 1 0
f 1 2 3
END
expect 1 force naked.obj --az 0 --el 0
says "gold"
says "--material"
expect 0 force naked.obj --az 0 --el 90 --material gold=0,0 --json
same "$(value f_m2 3)" -0.5
expect 0 force naked.obj --az 0 --el -90 --material gold=0.5,0,one-sided --json # lit from behind
same "$(value f_m2 3)" 0.5
same "$(value back_area_m2)" 0.5
expect 0 force naked.obj --az 0 --el 90 --material gold=0,0 --material silver=0,0
says 'silver' # no face has it
finish
