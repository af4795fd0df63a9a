#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From start to end as a user would: open, turn, record, compute, compare, save. Every step's picture is
# kept in the build tree ($SHOTS), and looked at.
. "$(dirname "$0")/lib.sh"
start_display

# seen FILE X Y W H COLOURS SHARE: this part of the picture shows something.
seen() {
    "$CHECK" "$SHOTS/$1" 1280 800 "${@:2}" || fail "$1 does not show what it should"
}

cat > "$scratch/steps" << END
resize 1280 800
wait
expect model-name box-wing.obj
expect model-facts 60 triangles
expect report Mesh is fine
expect accuracy-words no sampling error
expect lit-area e+
screenshot $SHOTS/1-open.png

turn-z 25
wait
expect turn-z 25
expect sun -2
screenshot $SHOTS/2-turn.png

expect arrows 0 arrows
record
turn-z -60
wait
turn-z -20
wait
turn-z 40
wait
turn-y -35
wait
turn-x 80
wait
record
expect arrows 6 arrows
expect record Start
wait
screenshot $SHOTS/3-arrows.png
colouring incidence
wait
screenshot $SHOTS/4-incidence.png
clear-arrows
expect arrows 0 arrows
colouring material

enter mass 850
wait
expect acceleration-x e-
material cells=0.5,0.25
wait
print f-x
material
wait

tab graphics
az-step 10
el-step 10
compute-table
wait
expect message computed in
expect table box-wing.obj, exact, 10
screenshot $SHOTS/5-table.png
save $scratch/exact.nc
expect message Saved
enter mass 900
save $scratch/exact.txt
expect message exact.txt, for the mass of 850 kg that the table was computed with.
save $scratch/exact.png
save $scratch/exact.svg
expect message Saved

method raycast
parameter grid=64
wait
expect accuracy-words from exact
expect method raycast
compute-table
wait
expect table 2: box-wing.obj, raycast grid 64, 10° × 10°
screenshot $SHOTS/6-second.png
open-table $scratch/exact.txt
wait
expect table exact.txt (box-wing.obj, 10° × 10°)
expect message Table 3: exact.txt opened

tab compare
compare-a 1
compare-b 2
wait
expect comparison-facts 614 directions
expect vector-rms e-
expect vector-mse e-
print vector-rms
print vector-largest
screenshot $SHOTS/7-compare.png
save $scratch/difference.png
expect message Saved
show-table 2
tab graphics
save $scratch/raycast.nc

tab compare
compare-a 1
fit 6
wait
expect plates-count 6
expect compare-b 6 plates fitted
expect message fitted to
print vector-rms
save $scratch/fitted.plates
wait
screenshot $SHOTS/9-fit.png

clear-tables
wait
expect vector-rms —
save $scratch/none.png
expect message Nothing has been compared yet
tab graphics
save $scratch/none.nc
expect message There is no table yet

dark
tab spacecraft
wait
screenshot $SHOTS/8-dark.png
END
view 0 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"

# The picture of the spacecraft, the numbers, surfaces.
seen 1-open.png 10 240 840 460 25 0.985
seen 2-turn.png 10 240 840 460 25 0.985
seen 3-arrows.png 10 240 840 460 60 0.985
seen 4-incidence.png 10 240 840 460 25 0.985
seen 1-open.png 870 240 400 350 8 0.97
seen 5-table.png 10 320 1260 440 60 0.95
seen 6-second.png 10 320 1260 440 60 0.95
for corner in '10 290' '440 290' '10 535' '440 535'; do
    # shellcheck disable=SC2086 # two numbers
    seen 7-compare.png $corner 410 225 40 0.95
done
seen 7-compare.png 870 290 400 230 8 0.97
seen 8-dark.png 10 240 840 460 25 0.985
for pair in '1-open 2-turn' '2-turn 3-arrows' '3-arrows 4-incidence' '1-open 8-dark' '5-table 6-second'; do
    read -r one other <<< "$pair"
    ! cmp -s "$SHOTS/$one.png" "$SHOTS/$other.png" || fail "$one and $other look the same"
done

# What was saved is what srp computes.
"$SRP" table "$ROOT/models/box-wing.obj" --step 10 -o "$scratch/cli.nc" > "$scratch/log" 2>&1 || fail 'srp table'
"$SRP" compare "$scratch/cli.nc" "$scratch/exact.nc" --fail-above 0 > "$scratch/log" 2>&1 || fail 'tables differ'
"$SRP" compare "$scratch/exact.nc" "$scratch/raycast.nc" > "$scratch/compared" || fail 'srp compare'
want=$(awk '$1 == "vector" { print $3; exit }' "$scratch/compared")
[ "$(values vector-rms | head -1)" = "$want" ] || fail "RMS $(values vector-rms | head -1), srp compare has $want"
want=$(awk '$1 == "vector" { print $5; exit }' "$scratch/compared")
[ "$(value vector-largest)" = "$want" ] || fail "largest $(value vector-largest), srp compare has $want"
"$SRP" force "$ROOT/models/box-wing.obj" --material cells=0.5,0.25 --az 0 --el 0 > /dev/null || fail 'srp force'
for file in exact.txt exact.png exact.svg difference.png; do
    [ -s "$scratch/$file" ] || fail "$file was not saved"
done

if "$SRP" fit-nplate "$scratch/exact.nc" --plates 6 -o "$scratch/cli.plates" > "$scratch/log" 2>&1; then
    cmp -s <(grep -v '^#' "$scratch/cli.plates") <(grep -v '^#' "$scratch/fitted.plates") || fail 'other plates than srp fit-nplate'
    want=$(awk '$1 == "fit," { print $4 }' "$scratch/log")
    [ "$(printf '%.5g' "$(values vector-rms | tail -1)")" = "$want" ] || fail "residual $(value vector-rms), srp fit-nplate has $want"
fi

# An orbit, and another model of sunlight, where missions are built in.
if "$SRP" propagate "$ROOT/models/missions/geo-box-wing.yaml" \
    --versus "$ROOT/models/missions/geo-cannonball.yaml" -o "$scratch/cli.csv" > "$scratch/log" 2>&1; then
    cat > "$scratch/steps" << END
resize 1280 800
tab orbit
propagate
expect message There is no mission yet
mission $ROOT/models/missions/geo-box-wing.yaml
versus $ROOT/models/missions/geo-cannonball.yaml
propagate
wait
expect message The mission ran
expect orbit-facts geo-box-wing.yaml (exact) → geo-cannonball.yaml (cannonball): 
save $scratch/viewer.nc
expect message viewer.nc: Orbit saves the rows of the orbit (.csv). Visualize Graphics saves the table
save $scratch/viewer.csv
screenshot $SHOTS/10-orbit.png
expect message Saved
mission $ROOT/models/missions/geo-cannonball.yaml
print message
mission $scratch/no-such.yaml
wait
expect message no-such.yaml
END
    view 0 --actions "$scratch/steps"
    [ -z "$(value message)" ] || fail "old words: $(value message)"
    seen 10-orbit.png 10 330 1260 440 20 0.99
    cmp "$scratch/cli.csv" "$scratch/viewer.csv" || fail 'other rows than srp propagate'
fi

# The script of the user guide.
sed -n '/^cat > steps << END$/,/^END$/p' "$ROOT/docs/user-guide.md" | sed '1d; $d' > "$scratch/steps"
(cd "$scratch" && view 0 --actions steps "$ROOT/models/box-wing.obj" && exit "$failures") || fail "the user guide's script"
for file in box-wing.nc table.png; do
    [ -s "$scratch/$file" ] || fail "the user guide's script makes no $file"
done

# A script that does not find what it expects says so.
printf 'wait\nexpect model-name no-such-model\n' > "$scratch/steps"
view 1 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"
grep -q "steps:.*says 'box-wing.obj', expected 'no-such-model'" "$scratch/err" || fail 'does not say what was expected'

# A name that no widget has is answered by those that there are.
printf 'wait\nprint moment-x\n' > "$scratch/steps"
view 1 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"
grep -qE "there is no widget 'moment-x' among (.* )?mass .* t-x .* comparison-facts " "$scratch/err" || fail 'does not say which widgets there are'

# Numbers are read whole, and whole ones are meant.
for step in 'turn-x abc' 'turn-x 1,5' 'turn-x' 'show-table 1.5' 'show-table 99999999999'; do
    printf 'wait\n%s\n' "$step" > "$scratch/steps"
    view 1 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"
    grep -q "steps:2: $step.*: expected a .*number" "$scratch/err" || fail "$step: no word that it is no number"
done

# What is remembered: nothing of the scripts above, nor of the spacecraft; method, steps, tab, style and files of one that asks.
[ ! -e "$XDG_CONFIG_HOME/srpcore/viewer.ini" ] || fail 'a script left a state'
printf '%s\n' 'wait' 'method raycast' 'parameter grid=77' 'enter mass 12.5' 'enter reference 1,2,3' 'parameter area=7' 'az-step 15' 'tab graphics' 'wait' > "$scratch/steps"
view 0 --remember --actions "$scratch/steps" "$ROOT/models/cube.obj"
printf '%s\n' 'wait' 'expect method raycast' 'expect grid 77' 'print mass' 'print reference' 'expect az-step 15' 'method exact' 'wait' 'expect message needs an OBJ file' > "$scratch/steps"
view 0 --remember --actions "$scratch/steps"
[ -z "$(value mass)$(value reference)" ] || fail 'mass and reference point of another spacecraft'
! grep -q '^area' "$XDG_CONFIG_HOME/srpcore/viewer.ini" || fail 'the area of another spacecraft'
grep -q '^files=.*models/cube.obj;' "$XDG_CONFIG_HOME/srpcore/viewer.ini" || fail 'the file is not among the recent ones'
grep -q '^tab=1' "$XDG_CONFIG_HOME/srpcore/viewer.ini" || fail 'the tab is not remembered'
printf 'v 1 2 x\n' > "$scratch/broken.obj"
printf '%s\n' wait "open $scratch/broken.obj" wait 'expect message broken.obj:1' > "$scratch/steps"
view 0 --remember --actions "$scratch/steps"
! grep -q 'broken.obj' "$XDG_CONFIG_HOME/srpcore/viewer.ini" || fail 'what cannot be opened is remembered'
# Two windows at once: what either opened is remembered.
printf '%s\n' wait 'pause 8' > "$scratch/slow"
run_viewer --remember --actions "$scratch/slow" "$ROOT/models/dish.obj" > "$scratch/log" 2>&1 &
slow=$!
echo wait > "$scratch/steps"
view 0 --remember --actions "$scratch/steps" "$ROOT/models/box-wing.obj"
kill -0 "$slow" || fail 'the other window ended too early to tell'
wait "$slow" || fail 'the other window'
for model in dish box-wing cube; do
    grep -q "^files=.*models/$model.obj;" "$XDG_CONFIG_HOME/srpcore/viewer.ini" || fail "$model is forgotten"
done
grep -q '^files=[^;]*models/dish.obj;' "$XDG_CONFIG_HOME/srpcore/viewer.ini" || fail 'the newest file is not first'
# Settings that cannot be kept are told of; a relative place is none.
: > "$scratch/file"
echo wait > "$scratch/steps"
XDG_CONFIG_HOME=$scratch/file/below view 0 --remember --actions "$scratch/steps"
[ "$(grep -c "nothing is remembered: $scratch/file/below/srpcore: " "$scratch/err")" -eq 1 ] || fail 'settings are lost without a word'
mkdir -p "$scratch/config/none/srpcore/viewer.ini"
XDG_CONFIG_HOME=$scratch/config/none view 0 --remember --actions "$scratch/steps"
[ "$(grep -c "nothing is remembered: .*viewer.ini" "$scratch/err")" -eq 1 ] || fail 'settings are lost without a word'
(cd "$scratch" && XDG_CONFIG_HOME=relative view 0 --remember --actions steps && exit "$failures") || fail 'a relative XDG_CONFIG_HOME'
[ ! -e "$scratch/relative/srpcore" ] || fail 'a relative XDG_CONFIG_HOME is taken'
[ -s "$HOME/.config/srpcore/viewer.ini" ] || fail 'without XDG_CONFIG_HOME ~/.config is not taken'
mkdir -p "$scratch/config/link/srpcore"
: > "$scratch/kept.ini"
ln -s "$scratch/kept.ini" "$scratch/config/link/srpcore/viewer.ini"
XDG_CONFIG_HOME=$scratch/config/link view 0 --remember --actions "$scratch/steps"
[ -L "$scratch/config/link/srpcore/viewer.ini" ] || fail 'a link is replaced'
grep -q '^tab=' "$scratch/kept.ini" || fail 'nothing is kept where the link leads'
printf 'not a key file\n\0\n' > "$XDG_CONFIG_HOME/srpcore/viewer.ini"
printf 'wait\nexpect method exact\n' > "$scratch/steps"
view 0 --remember --actions "$scratch/steps" "$ROOT/models/cube.obj"
judge
