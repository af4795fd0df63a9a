#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The window for everybody: each control has a name for screen readers and a way to it by keys, no key stands
# for two things, nothing is out of sight or cut in a window of 800 x 640 pixels, and screens of twice as many
# pixels get as many.
. "$(dirname "$0")/lib.sh"
start_display

# audit STEPS [SIZE]: these steps, then a look at the window.
audit() {
    printf '%s\n' "resize ${2:-800 640}" "$1" wait audit > "$scratch/steps"
    GTK_A11Y=test view 0 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"
    local controls
    controls=$(value controls)
    [ "${controls:-0}" -gt 50 ] || fail "only ${controls:-0} controls after: $1"
    [ "$(value least-width)" -le 800 ] || fail "$(value least-width) px wide at least after: $1"
    [ "$(value least-height)" -le 640 ] || fail "$(value least-height) px high at least after: $1"
}
audit ''
audit 'method raytrace'
audit $'tab graphics\naz-step 30\nel-step 30\ncompute-table'
audit $'az-step 30\nel-step 30\ncompute-table\nwait\ntab compare\nfit 4'
audit $'method nplate\nwait\nexpect message needs a file\ntab graphics'
audit $'method nplate\nwait\nexpect message needs a file\ntab compare'
audit 'tab orbit'
audit $'turn-z 1\nwait\nturn-z 2\nwait\nturn-z 3\nwait\nexpect latency ms after'
audit $'method raytrace\naz-step 30\nel-step 30\ncompute-table\nwait\ntab compare\nfit 4'
audit $'az-step 30\nel-step 30\ntab graphics\ncompute-table\nwait\nmaterial bus=0.3,0.2\nwait\nexpect reoptic New Optics'
audit $'method raycast\nwait\nexpect method-summary lattice of rays'
audit "method nplate"$'\nwait\nexpect message needs a file\nsave '"$scratch/picture.png"$'\nexpect message Saved'

# The last number, too, without scrolling, however much there is to say of a spacecraft and its method.
printf '%s\n' 'resize 800 640' 'method raytrace' 'parameter grid=64' 'parameter diffuse=1' 'enter mass 850' wait 'turn-z 1' wait \
    'expect latency ms after' 'expect extra reflected' 'place latency' 'place message' > "$scratch/steps"
view 0 --actions "$scratch/steps" "$ROOT/models/sun-shield.obj"
read -r _ top _ high <<< "$(value 'place of latency')"
read -r _ below _ <<< "$(value 'place of message')"
[ "$((top + high))" -lt "$below" ] || fail "the last number ends at $((top + high)) px, the line below it begins at $below"

for method in exact raycast raytrace; do
    audit "method $method" '1280 800'
done

cat > "$scratch/steps" << END
resize 1280 800
wait
screenshot $SHOTS/fine.png
END
view 0 --size 900x700 --tab orbit --screenshot "$SHOTS/small.png"
"$CHECK" "$SHOTS/small.png" 900 700 0 0 900 200 8 0.99 || fail '--size 900x700 is not that size'
GDK_SCALE=2 view 0 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"
"$CHECK" "$SHOTS/fine.png" 2560 1600 20 480 1680 920 25 0.985 || fail 'the fine picture does not show what it should'
judge
