#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What can go wrong does so with clear words and without a hang.
. "$(dirname "$0")/lib.sh"

# No display.
(
    unset DISPLAY
    status=0
    timeout 60 "$VIEWER" "$ROOT/models/cube.obj" > "$scratch/out" 2> "$scratch/err" || status=$?
    [ "$status" -eq 3 ] && grep -q 'there is no display' "$scratch/err"
) || fail 'without a display: status 3 and a clear message'
# What needs no display works without one.
env -u DISPLAY "$VIEWER" --version | grep -q '^srp-viewer [0-9]' || fail '--version'
env -u DISPLAY "$VIEWER" --help | grep -q -- '--screenshot' || fail '--help'
env -u DISPLAY "$VIEWER" --list-actions | grep -q '^compute-table' || fail '--list-actions'
start_display

view 2 --no-such-option
view 2 one.obj two.obj
view 2 one.obj --model two.obj
view 2 --actions "$scratch/no-such-file"
view 2 --tab sideways --screenshot "$scratch/x.png"
for size in 12 0x0 -5x800 1280x 99x800 1280x20001; do
    view 2 --size "$size" "$ROOT/models/cube.obj"
    grep -q -- "--size $size: expected WIDTHxHEIGHT" "$scratch/err" || fail "--size $size"
done
# A picture of what could not be opened is no success.
view 1 --screenshot "$scratch/x.png" "$scratch/no-such.obj"
view 1 --screenshot "$scratch/x.png" --model "$scratch/no-such.obj"

# Nor is a script of which a step was refused and nothing expected that; the steps after it are done.
printf '%s\n' 'enter mass -3' 'enter mass -4' 'expect message Mass -4' "save $scratch/no-such/x.png" \
    'enter mass 5' wait 'expect mass 5' 'note the end' > "$scratch/steps"
view 1 --actions "$scratch/steps" --tab graphics "$ROOT/models/cube.obj"
grep -q '^the end$' "$scratch/out" || fail 'a refused step ended the script'
[ "$(grep -c steps: "$scratch/err")" -eq 2 ] || fail 'not two refused steps'
grep -q 'steps:1: Mass -3: expected' "$scratch/err" || fail 'the first step was refused, and that was not said'
grep -q 'steps:4: ' "$scratch/err" || fail 'the picture cannot be written, and that was not said'

# Files that are not there, or broken, and what comes after them.
printf 'v 1 2 3\nv 1 2 x\n' > "$scratch/broken.obj"
printf 'usemtl foil\nv 0 0 0\nv 1 0 0\nv 0 1.5 0\nf 1 2 3\n' > "$scratch/bare.obj"
cat > "$scratch/steps" << END
wait
expect message no-such.obj
expect f-x —
open $scratch/broken.obj
wait
expect message broken.obj:2:
open $scratch/bare.obj
wait
expect message the material 'foil' has no optics
compute-table
expect message foil
material foil=0.25,0.125
wait
expect message 
expect lit-area e-
method nplate
wait
expect message needs a file by Choose Plates…
expect speed-words not known
expect accuracy-words not known
method cannonball
wait
expect message needs Cr and Area
parameter grid=0
expect message Grid 0: expected a whole number from 1 to 32768
enter mass -3
expect message Mass -3: expected
colouring sideways
expect message expected the colouring
enter mass -3
expect message Mass -3: expected
method exact
wait
open-table $scratch/no-such.nc
wait
expect message no-such.nc
tab graphics
save $scratch/nothing.nc
expect message There is no table yet
save $scratch/nothing.gif
expect message nothing.gif: Visualize Graphics saves the table (.nc
tab spacecraft
open $ROOT/models/box-wing.obj
wait
expect model-name box-wing.obj
expect lit-area e+
END
view 0 --actions "$scratch/steps" "$scratch/no-such.obj"

# A method or a device that is not there is refused at once, and the one before stays; so are angles out of range.
cat > "$scratch/steps" << END
wait
method raycast
method foo
expect message unknown method 'foo' (methods: cannonball, nplate, exact, raycast, raytrace)
expect method raycast
device xyz
expect message method raycast is not there for Device xyz, only for cpu
expect device cpu
parameter device=xyz
expect message Device xyz
wait
expect method raycast
expect f-x e
turn-x 17
turn-x 720
expect message Rotation about X 720: expected degrees from -180 to 180
turn-z nan
expect message Rotation about Z nan: expected
turn-x -180.5
expect message Rotation about X -180.5: expected
expect turn-x 17
material nosuch=0.1,0.1
wait
expect message no face has the given material 'nosuch'
expect f-x e
material
wait
print message
END
view 0 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"
[ -z "$(value message)" ] || fail "a material that was forgotten: $(value message)"

# What was said of the spacecraft is not lost under what comes of that.
printf '%s\n' dark 'method raytrace' wait > "$scratch/steps"
view 1 --actions "$scratch/steps" "$scratch/no-such.obj"
grep -q 'no-such.obj: cannot open' "$scratch/err" || fail "the spacecraft is not there, and that is not said: $(cat "$scratch/err")"
grep -q 'steps:3: method raytrace needs an OBJ file: open one' "$scratch/err" || fail "what the method needs: $(cat "$scratch/err")"

# An MTL that is not there is asked for; all else goes on, and another one can be given.
printf 'mtllib nowhere.mtl\nusemtl foil\nv 0 0 0\nv 1 0 0\nv 0 1.5 0\nf 1 2 3\n' > "$scratch/lost.obj"
printf 'newmtl foil\nrho_s 0.25\nrho_d 0.125\nnewmtl other\nrho_s 0\nrho_d 0\n' > "$scratch/found.mtl"
printf 'newmtl other\nrho_s 0\nrho_d 0\n' > "$scratch/other.mtl"
cat > "$scratch/steps" << END
wait
expect message nowhere.mtl does not exist: another can be taken by Find MTL
expect message the material 'foil' has no optics
expect model-facts 1 triangle
compute-table
expect message nowhere.mtl
mtl $scratch/other.mtl
expect message has optics for none
mtl $scratch/no-such.mtl
expect message no-such.mtl
mtl $scratch/found.mtl
wait
print message
expect rho-s-foil 0.25
expect f-x e
copy-command
expect message --material foil=0.25,0.125
open $ROOT/models/box-wing.obj
wait
expect f-x e+
mtl $scratch/found.mtl
expect message has optics for none of the materials of
END
view 0 --actions "$scratch/steps" "$scratch/lost.obj"
[ -z "$(value message)" ] || fail "with the MTL the message is '$(value message)'"

# However many materials, they take one line; a third line is behind More.
{
    echo 'mtllib nowhere.mtl'
    for k in 1 2 3 4 5 6 7 8 9 10; do
        printf 'usemtl skin%d\nv %d 0 0\nv %d.5 0 0\nv %d 1.5 0\nf -3 -2 -1\n' $k $k $k $k
    done
} > "$scratch/many.obj"
cat > "$scratch/steps" << END
wait
expect message the materials 'skin1', 'skin2',
expect message 'skin7' and 3 others have no optics
method cannonball
wait
expect message in Materials …
expect whole-message needs Cr and Area
END
view 0 --actions "$scratch/steps" "$scratch/many.obj"
sed -i '/skin[3-9]/,/^f/d; /skin10/,/^f/d' "$scratch/many.obj"
printf '%s\n' wait "expect message the materials 'skin1' and 'skin2' have no optics" > "$scratch/steps"
view 0 --actions "$scratch/steps" "$scratch/many.obj"

# A spacecraft that takes long and cannot be read, and another one before it has been: nothing is said of it.
# Others are opened while a table is computed, which goes on, and is of the one that it was asked for.
{
    awk 'BEGIN { for (k = 0; k < 600000; ++k) print "v", k, 1, 2 }'
    echo 'v 1 2 x'
} > "$scratch/long.obj"
cat > "$scratch/steps" << END
wait
open $scratch/long.obj
pause 0.05
open $ROOT/models/cube.obj
wait
print message
expect model-name cube.obj
expect speed-words directions/s
tab graphics
method raytrace
parameter grid=96
parameter diffuse=4
az-step 10
el-step 10
wait
compute-table
pause 0.1
open $scratch/long.obj
pause 0.05
open $ROOT/models/dish.obj
wait
screenshot $scratch/waited.png
expect table 1: cube.obj
expect model-name dish.obj
expect speed-words directions/s
compute-table
open $scratch/broken.obj
pause 1
expect message broken.obj:2:
wait
expect table dish.obj
expect model-name dish.obj
expect speed-words directions/s
expect lit-area e
END
view 0 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"
[ -z "$(value message)" ] || fail "the message is of a spacecraft that was: '$(value message)'"

# What is asked for right after the method or the optics have changed is of these.
cat > "$scratch/steps" << END
wait
az-step 30
el-step 30
tab graphics
method raycast
parameter grid=48
compute-table
wait
expect table cube.obj, raycast
open $ROOT/models/gnss.obj
compute-table
wait
expect table gnss.obj, raycast
open $ROOT/models/cube.obj
method exact
compute-table
wait
expect table cube.obj, exact
material surface=0.5,0.25
reoptic
wait
expect message re-optic of 3
method cannonball
compute-table
cancel
parameter cr=1.5
parameter area=2
wait
expect table re-optic of 3
END
view 0 --actions "$scratch/steps" "$ROOT/models/cube.obj"

# A table that is cancelled, and a window that is closed while it computes.
cat > "$scratch/steps" << END
wait
az-step 0.5
el-step 0.5
tab graphics
method raytrace
parameter diffuse=8
wait
compute-table
pause 0.7
screenshot $SHOTS/progress.png
expect progress directions
cancel
wait
expect message cancelled
compute-table
pause 0.5
END
began=$SECONDS
view 0 --actions "$scratch/steps" "$ROOT/models/dish.obj"
[ $((SECONDS - began)) -lt 120 ] || fail 'closing took too long'

# A large spacecraft is simplified while it moves, and whole again when it stands: shadows and all.
awk 'BEGIN {
    rows = 240; columns = 150
    for (i = 0; i <= rows; ++i)
        for (k = 0; k < columns; ++k) {
            t = 0.05 + 3.0 * i / rows; p = 6.283185307179586 * k / columns; r = 1 + 0.2 * sin(7 * p) * sin(5 * t)
            printf "v %.6f %.6f %.6f\n", r * sin(t) * cos(p), r * sin(t) * sin(p), r * cos(t)
        }
    for (i = 0; i < rows; ++i)
        for (k = 0; k < columns; ++k) {
            a = i * columns + k + 1; b = i * columns + (k + 1) % columns + 1
            printf "f %d %d %d\nf %d %d %d\n", a, a + columns, b + columns, a, b + columns, b
        }
}' > "$scratch/large.obj"
cat > "$scratch/steps" << END
resize 1280 800
wait
expect message the material '' has no optics
material =0.3,0.2
wait
expect model-facts 72000 triangles
camera -40,24,1
wait
screenshot $SHOTS/large-1.png
shadows
wait
screenshot $SHOTS/large-2.png
shadows
camera 30,10,1
pause 0.05
camera -40,24,1
wait
screenshot $SHOTS/large-3.png
stall
END
view 0 --actions "$scratch/steps" "$scratch/large.obj"
grep -q '^stall: [0-9]* ms$' "$scratch/out" || fail 'does not say for how long it was deaf'
cmp -s "$SHOTS/large-1.png" "$SHOTS/large-3.png" || fail 'the large spacecraft is not whole again'
! cmp -s "$SHOTS/large-1.png" "$SHOTS/large-2.png" || fail 'the large spacecraft casts no shadow'

# A method of OpenGL that is given back takes nothing from the window, which draws by OpenGL itself.
if "$SRP" force "$ROOT/models/cube.obj" --az 0 --el 0 --method raycast --device gl:osmesa > "$scratch/log" 2>&1; then
    {
        printf 'wait\ntab graphics\n'
        for width in 1248 1100 1200; do
            printf '%s\n' 'method raycast' 'device gl:osmesa' wait 'expect device gl:osmesa' 'method exact' "resize $width 800" \
                "screenshot $scratch/x.png" 'tab spacecraft' wait "screenshot $scratch/x.png" 'print trouble' 'tab graphics'
        done
    } > "$scratch/steps"
    view 0 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"
    [ -z "$(values trouble | tr -d '\n')" ] || fail "no picture after a method of OpenGL: $(value trouble)"
else
    echo "skipped: no OSMesa: $(tail -1 "$scratch/log")"
fi

# Without OpenGL, or with an old one, there is no picture, and all the rest: our words stand alone, and are not
# one word wide.
cat > "$scratch/steps" << END
resize 1280 800
wait
expect trouble No picture: it takes OpenGL 3.3
expect trouble Numbers, tables and orbits go on
print scene
screenshot $SHOTS/no-picture.png
expect lit-area e+
tab graphics
compute-table
wait
expect table cube.obj
END
for old in 'GDK_DEBUG=gl-disable GSK_RENDERER=cairo' 'MESA_GL_VERSION_OVERRIDE=2.1'; do
    (
        export $old
        view 0 --actions "$scratch/steps" "$ROOT/models/cube.obj"
        exit $failures
    ) || fail "$old"
    [ -z "$(value scene)" ] || fail "$old: GTK writes over our words: $(value scene)"
    "$CHECK" "$SHOTS/no-picture.png" 1280 800 270 380 60 200 3 0.99 || fail "$old: the words are narrow"
done
judge
