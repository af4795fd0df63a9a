#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What is typed: taken as it is, or refused with words, and then what was there before is back. What the window
# shows is always what it computes with.
. "$(dirname "$0")/lib.sh"
start_display

# refused WIDGET TEXT WORDS BEFORE: steps that type this, look for the words, and for what was there before.
refused() {
    printf 'enter %s %s\nexpect message %s\nprint %s\nnote %s: %s\n' "$1" "$2" "$3" "$1" "want $1" "$4"
}

cat > "$scratch/fine.obj" << END
mtllib fine.mtl
usemtl cells
v 0 0 0
v 1 0 0
v 0 1.5 0
f 1 2 3
END
printf 'newmtl cells\nrho_s 0.07123456\nrho_d 0.02\n' > "$scratch/fine.mtl"
{
    echo wait
    refused rho-s-cells 0,4 'ρ specular of cells 0,4: expected a number from 0 to 1, with a decimal point' 0.07123456
    refused rho-s-cells 7 'ρ specular of cells 7: expected' 0.07123456
    refused rho-s-cells 0.99 'rho_s + rho_d is 1.01' 0.07123456
    refused rho-d-cells '' 'ρ diffuse of cells : expected' 0.02
    refused rho-d-cells 0x1 'ρ diffuse of cells 0x1: expected' 0.02
    cat << END
enter rho-d-cells 0.03
expect message 
copy-command
expect message cells=0.07123456,0.03
enter rho-s-cells 0.0712345678
wait
print rho-s-cells
note want rho-s-cells: 0.0712345678
copy-command
expect message cells=0.0712345678,0.03
material
wait
print rho-d-cells
note want rho-d-cells: 0.02
sun 30,5
END
    refused sun 30,95 'Sun 30,95: expected AZ,EL' 30,5
    refused sun 1e400,5 'Sun 1e400,5: expected' 30,5
    refused sun nan,nan 'Sun nan,nan: expected' 30,5
    refused sun '' 'expected AZ,EL' 30,5
    echo enter mass 850.5
    refused mass 850,5 'Mass 850,5: expected' 850.5
    echo enter reference 1,2,3
    refused reference 1,2 'expected' 1,2,3
    echo method raycast
    echo enter grid 64
    refused grid 64,5 'Grid 64,5: expected' 64
    refused az-step 7,5 'Step az 7,5: expected a number from 0.5 to 90' 10
    refused az-step 0.05 'Step az 0.05: expected' 10
    refused el-step -0.3 'Step el -0.3: expected' 10
    cat << END
enter az-step 7.5
print message
print az-step
note want az-step: 7.5
az-step 0.05
expect message expected a step from 0.5 to 90 degrees
print az-step
note want az-step: 7.5
END
    refused plates-count 2,5 'Plates to fit 2,5: expected a whole number from 1 to' 8
    refused plates-count 2.5 'Plates to fit 2.5: expected a whole number' 8
    echo 'enter plates-count 5'
    echo 'print plates-count'
    echo 'note want plates-count: 5'
} > "$scratch/steps"
view 0 --actions "$scratch/steps" "$scratch/fine.obj"
[ -z "$(value message)" ] || fail "what was refused is still said: $(value message)"
checked=0
while read -r got && read -r want; do
    [ "want $got" = "$want" ] || fail "after what was refused: $got, expected ${want#want }"
    checked=$((checked + 1))
done < <(grep -vE '^message:' "$scratch/out")
[ "$checked" -eq 22 ] || fail "$checked of 22 looks at what is shown"

# Keys, which leave no entry, act on what is typed there.
cat > "$scratch/steps" << END
wait
type mass 777
copy-command
expect message --mass 777
type az-step 15
type el-step 45
compute-table
wait
expect message 15° × 45°
type rho-s-bus 0,4
reset-view
expect message with a decimal point
expect rho-s-bus 0.
note taken
END
view 0 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"

# Mass and reference point are the spacecraft's: they stay when it is read again, and go when another one is
# opened, unless they were typed for that one, before there was any or since it was asked for.
cat > "$scratch/steps" << END
enter mass 850
enter reference 1,2,3
parameter area=7
parameter cr=1.2
open $ROOT/models/box-wing.obj
wait
expect mass 850
reload
wait
open $ROOT/models/box-wing.obj
wait
expect mass 850
expect reference 1,2,3
expect acceleration-x e-
open $ROOT/models/sun-shield.obj
wait
print mass
print reference
method cannonball
wait
expect message needs Cr and Area
method exact
wait
expect acceleration-x —
enter mass 6200
open $ROOT/models/cube.obj
enter mass 12
wait
expect model-name cube.obj
expect mass 12
END
view 0 --actions "$scratch/steps"
[ -z "$(value mass)$(value reference)" ] || fail 'mass and reference point of the spacecraft before'

# A slow method has three digits, too.
printf '%s\n' 'method raytrace' 'parameter grid=256' 'parameter diffuse=16' wait 'pause 0.5' wait 'print speed-words' > "$scratch/steps"
view 0 --actions "$scratch/steps" "$ROOT/models/dish.obj"
value speed-words | grep -qE '^(0\.[0-9]{3}|[0-9]\.[0-9]{2}|[0-9]{2}\.[0-9]|[0-9]{3,}) directions/s' || fail "the speed is '$(value speed-words)'"

# Recording begins with what is shown now, also where that is still being computed.
printf '%s\n' 'method raycast' wait 'turn-z 40' record wait 'expect arrows 1 arrow' 'turn-z 50' wait 'expect arrows 2 arrows' record \
    clear-arrows record 'expect arrows 1 arrow' record clear-arrows 'type sun 5,5' record wait 'expect arrows 1 arrow' \
    > "$scratch/steps"
view 0 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"

# A file is called by its name on a button, underscores and all.
printf '1\n0 0 1 1 0.5 0.2\n' > "$scratch/my_pl'ates _x.plates"
printf '%s\n' wait 'method nplate' "plates $scratch/my_pl'ates _x.plates" "expect choose-plates my_pl'ates _x.plates" \
    'plates' 'expect choose-plates Plates' > "$scratch/steps"
view 0 --actions "$scratch/steps" "$ROOT/models/cube.obj"

# The keyboard shows where it is, in the picture, too; and the picture stays.
cat > "$scratch/steps" << END
resize 1280 800
wait
focus sun
wait
screenshot $SHOTS/elsewhere.png
focus scene
wait
screenshot $SHOTS/focus.png
focus sun
wait
screenshot $SHOTS/elsewhere-again.png
END
view 0 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"
cmp -s "$SHOTS/elsewhere.png" "$SHOTS/elsewhere-again.png" || fail 'the window is another one after the keyboard was in the picture'
"$CHECK" "$SHOTS/elsewhere.png" 1280 800 200 195 600 40 3 1 || fail 'no picture'
if "$CHECK" "$SHOTS/elsewhere.png" 1280 800 200 195 600 40 4 1; then fail 'a frame without the keyboard'; fi
"$CHECK" "$SHOTS/focus.png" 1280 800 200 195 600 40 4 1 || fail 'no frame where the keyboard is'
"$CHECK" "$SHOTS/focus.png" 1280 800 20 300 800 380 20 0.985 || fail 'where the keyboard is there is no picture'
judge
