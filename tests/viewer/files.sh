#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Files that come in while the window goes on, and what each tab saves; what is said goes when it is old.
. "$(dirname "$0")/lib.sh"
start_display

"$SRP" table "$ROOT/models/cube.obj" --step 30 --mass 12.5 -o "$scratch/small.nc" -o "$scratch/small.txt" > "$scratch/log" 2>&1 ||
    fail 'srp table'

# await NOTE: until the steps that run make this note.
await() {
    until grep -q "^$1" "$scratch/out"; do sleep 0.05; done
}

# view_and_feed STATUS: runs the steps; when they note that the window hears, the pipe gets its table.
view_and_feed() {
    : > "$scratch/out"
    (
        await hears
        cat "$scratch/small.txt" > "$scratch/slow.txt"
    ) &
    local writer=$!
    view "$1" --actions "$scratch/steps" "$ROOT/models/box-wing.obj"
    kill "$writer" 2> /dev/null
}

# Tables are read in the order that they were asked for, and the first takes as long as it likes: it comes
# through a pipe when the window has shown that it hears.
mkfifo "$scratch/slow.txt"
cat > "$scratch/steps" << END
wait
tab graphics
open-table $scratch/slow.txt
open-table $scratch/small.nc
open-table $scratch/no-such.nc
expect busy Opening …
turn-z 33
pause 0.3
expect turn-z 33
expect f-x e+
note hears
wait
expect table 2: small.nc
expect message no-such.nc
print busy
show-table 1
expect table 1: slow.txt
open-table $scratch/small.txt
wait
expect table 3: small.txt
print message
END
view_and_feed 0
[ -z "$(value busy)" ] || fail "busy when all is there: $(value busy)"
! values message | grep -q no-such || fail "a message that a later table has taken back: $(values message)"

# A complaint stands until something of its kind succeeds: what else is told is told under it.
cat > "$scratch/steps" << END
wait
az-step 90
el-step 90
open-table $scratch/no-such.nc
wait
expect message no-such.nc
mass 100
compute-table
wait
expect message no-such.nc
expect message computed in
turn-x 3
save $scratch/picture.nc
expect message picture.nc: Visualize Spacecraft saves
open-table $scratch/small.nc
wait
expect message picture.nc: Visualize Spacecraft saves
tab graphics
save $scratch/picture.nc
expect message Saved
print message
END
view 0 --actions "$scratch/steps" "$ROOT/models/cube.obj"
[ "$(value message)" = "Saved $scratch/picture.nc." ] || fail "what was mended stands: $(values message)"

# Of two that were asked for together and cannot be read, both are said.
printf '%s\n' "open-table $scratch/slow.txt" "open-table $scratch/no-such.nc" "open-table $scratch/nor-this.nc" \
    'pause 0.2' 'note hears' wait 'print message' > "$scratch/steps"
view_and_feed 1
sed -n '/^message:/,$p' "$scratch/out" > "$scratch/said"
{ grep -q no-such.nc "$scratch/said" && grep -q nor-this.nc "$scratch/said"; } ||
    fail "one of two that cannot be read is not said: $(cat "$scratch/said")"

# Those that are not wanted any more do not come.
cat > "$scratch/steps" << END
wait
open-table $scratch/slow.txt
open-table $scratch/small.nc
pause 0.2
clear-tables
note hears
wait
print table
open-table $scratch/small.nc
wait
expect table 1: small.nc
END
view_and_feed 0
[ -z "$(value table)" ] || fail "there is a table that was forgotten: $(value table)"

# Nor does what was to be made of them.
cat > "$scratch/steps" << END
az-step 30
el-step 30
compute-table
wait
material bus=0.31,0.11
wait
open-table $scratch/slow.txt
reoptic
pause 0.2
clear-tables
expect message The re-optic was cancelled.
note hears
wait
print table
END
view_and_feed 0
[ -z "$(value table)" ] || fail "a table was made of one that was forgotten: $(value table)"

# A spacecraft stays until another one has been read, and where that is not wanted any more.
mkfifo "$scratch/slow.obj"
cp "$ROOT/models/cube.mtl" "$scratch/"
cat > "$scratch/steps" << END
wait
open $scratch/slow.obj
expect busy Opening …
expect model-name box-wing.obj
expect model-facts 60 triangles
turn-z 33
pause 0.3
expect f-x e+
cancel
note first
wait
print message
expect model-name box-wing.obj
open $scratch/slow.obj
compute-table
pause 0.3
note second
wait
expect model-name slow.obj
expect table slow.obj
END
: > "$scratch/out"
(
    for note in first second; do
        await "$note"
        cat "$ROOT/models/cube.obj" > "$scratch/slow.obj"
    done
) &
writer=$!
view 0 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"
kill "$writer" 2> /dev/null
[ -z "$(value message)" ] || fail "a message of what was not wanted any more: $(value message)"

# The window is closed while it reads.
"$SRP" table --method cannonball --cr 1.25 --area 2.5 --step 0.5 --mass 12.5 -o "$scratch/large.txt" > "$scratch/log" 2>&1 ||
    fail 'srp table'
printf '%s\n' wait "open-table $scratch/large.txt" "open-table $scratch/large.txt" > "$scratch/steps"
view 0 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"

# What each tab saves, and what it says of the rest.
cat > "$scratch/steps" << END
wait
dark
save $scratch/dark.png
expect message Saved
dark
save $scratch/picture.png
expect message Saved
save $scratch/other.nc
expect message other.nc: Visualize Spacecraft saves the picture of the spacecraft (.png). Visualize Graphics saves the table
az-step 30
el-step 30
compute-table
wait
tab graphics
save $scratch/cube.nc
expect message Saved
save $scratch/cube.plates
expect message Compare Graphics saves the comparison (.txt)
tab compare
expect comparison-facts Compute or open a second table
open-table $scratch/small.txt
wait
expect comparison-facts 62 directions
expect message Table 2: small.txt opened
open-table $scratch/small.nc
wait
expect compare-a 1: cube.obj
expect compare-b 3: small.nc
open-table $scratch/small.txt
wait
expect compare-b 4: small.txt
compare-b 2
wait
save $scratch/compared.txt
expect message Saved
save $scratch/compared.svg
expect message Saved
save $scratch/compared.nc
expect message compared.nc: Compare Graphics saves the comparison (.txt), its figure (.png, .svg, .pdf) or fitted plates (.plates). Visualize Graphics saves the table
save $scratch/compared.SPO
expect message Visualize Graphics saves the table
save $scratch/compared
expect message compared: Compare Graphics saves the comparison (.txt)
clear-tables
expect comparison-facts Two tables of this session, or from disk
save $scratch/nothing.txt
expect message Nothing has been compared yet
END
view 0 --actions "$scratch/steps" "$ROOT/models/cube.obj"
"$SRP" compare "$scratch/cube.nc" "$scratch/small.txt" > "$scratch/cli.txt" || fail 'srp compare'
cmp "$scratch/cli.txt" "$scratch/compared.txt" || fail 'other text than srp compare'
grep -q '<svg' "$scratch/compared.svg" || fail 'no figure of the comparison'
for file in other.nc cube.plates compared.nc compared.SPO compared nothing.txt; do
    [ ! -e "$scratch/$file" ] || fail "$file was saved"
done
read -r width height < <(od -An -tu1 -j16 -N8 "$scratch/picture.png" | awk '{ print $3 * 256 + $4, $7 * 256 + $8 }')
"$CHECK" "$scratch/picture.png" "$width" "$height" 0 0 "$width" "$height" 25 0.985 || fail 'no picture of the spacecraft'
[ "$width" -lt 1000 ] || fail 'the picture is of more than the spacecraft'

! cmp -s "$scratch/picture.png" "$scratch/dark.png" || fail 'the picture is the same in the dark'

# A file that needs a mass has that of now where the table has none, as with srp convert; the table keeps none.
cat > "$scratch/steps" << END
az-step 30
el-step 30
tab graphics
compute-table
wait
save $scratch/massless.txt
expect message needs the mass
save $scratch/massless.nc
mass 12.5
save $scratch/massive.txt
expect message Saved
save $scratch/massless-again.nc
mass 25
save $scratch/heavier.txt
expect message Saved
END
view 0 --actions "$scratch/steps" "$ROOT/models/cube.obj"
[ ! -e "$scratch/massless.txt" ] || fail 'accelerations without a mass'
cmp "$scratch/massless.nc" "$scratch/massless-again.nc" || fail 'the table has another mass after it was saved'
for mass in 12.5=massive 25=heavier; do
    "$SRP" convert "$scratch/massless.nc" "$scratch/${mass%=*}.txt" --mass "${mass%=*}" > "$scratch/log" 2>&1 || fail 'srp convert'
    cmp "$scratch/${mass%=*}.txt" "$scratch/${mass#*=}.txt" || fail "another file than srp convert --mass ${mass%=*}"
done

# Words fit numbers.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' > "$scratch/one.obj"
printf '%s\n' 'material =0.1,0.2' wait 'expect model-facts 1 triangle ·' 'print speed-words' > "$scratch/steps"
view 0 --actions "$scratch/steps" "$scratch/one.obj"
[[ $(value speed-words) =~ ^[0-9]+\ directions/s$ ]] || fail "speed: $(value speed-words)"

# Nothing moves under the pointer, when there is something to say or something is computed.
cat > "$scratch/steps" << END
wait
place turn-z
open-table $scratch/no-such.nc
wait
expect message no-such.nc
place turn-z
tab graphics
az-step 0.5
el-step 0.5
pause 0.3
place table
compute-table
expect busy Computing …
pause 0.3
place table
cancel
wait
END
view 0 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"
for widget in turn-z table; do
    [ "$(values "place of $widget" | sort -u | wc -l)" -eq 1 ] || fail "$widget moves: $(values "place of $widget")"
done

# What was said of a step goes with the next one; what is wrong stands until it is mended.
cp "$ROOT/models/dish.obj" "$scratch/mended.obj"
cp "$ROOT/models/dish.mtl" "$scratch/"
cat > "$scratch/steps" << END
wait
az-step 30
el-step 30
tab graphics
compute-table
wait
expect message computed in
open-table $scratch/small.nc
wait
expect message Table 2: small.nc opened
save $scratch/cube.txt
turn-x 3
tab compare
expect message Saved
compare-b 1
print message
compare-b 9
expect message there is no table of this number
compare-b 2
turn-x 5
expect message there is no table of this number
open $scratch/mended.obj
wait
note good
pause 2
reload
wait
expect message mended.obj:2:
compute-table
expect message mended.obj:2:
tab spacecraft
expect message mended.obj:2:
note broken
pause 2
reload
wait
print message
END
: > "$scratch/out"
(
    await good
    printf 'v 1 2 3\nv 1 2 x\n' > "$scratch/mended.obj"
    await broken
    cp "$ROOT/models/dish.obj" "$scratch/mended.obj"
) &
writer=$!
view 0 --actions "$scratch/steps" "$ROOT/models/cube.obj"
kill "$writer" 2> /dev/null
said=$(values message | tr -d '\n')
[ -z "$said" ] || fail "old words: $said"

# What is dropped on the window is what its ending says; the spacecraft stays when it is nothing of use.
echo 'not a model' > "$scratch/notes.md"
mkdir "$scratch/a folder"
cp "$scratch/small.nc" "$scratch/BIG LETTERS.NC"
printf 'newmtl nobody\nrho_s 0.25\nrho_d 0.125\n' > "$scratch/nobody.mtl"
cat > "$scratch/steps" << END
wait
drop $scratch/notes.md
expect message notes.md: expected a spacecraft (.obj)
drop '$scratch/a folder' https://example.org/x
expect message a folder: expected
expect message example.org/x: expected
drop $scratch/nobody.mtl
expect message has optics for none
expect model-name box-wing.obj
drop '$scratch/BIG LETTERS.NC' $scratch/small.txt
wait
expect table 2: small.txt
save $scratch/dropped.nc
expect message Saved
drop $ROOT/models/cube.obj $scratch/nobody.mtl $ROOT/models/dish.obj
expect message dish.obj: another file of its kind
wait
expect model-name cube.obj
drop 'no end
expect message quote
END
view 0 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"
[ -s "$scratch/dropped.nc" ] || fail 'a dropped table is not shown'
printf '%s\n' copy-command 'expect message no spacecraft' > "$scratch/steps"
view 0 --actions "$scratch/steps"

# A spacecraft that cannot be read anew stays: picture, numbers and sliders, until its file is good again.
cp "$ROOT/models/box-wing.obj" "$scratch/gone.obj"
cp "$ROOT/models/box-wing.mtl" "$scratch/"
cat > "$scratch/steps" << END
wait
note good
pause 2
reload
wait
expect message gone.obj
expect model-name gone.obj
expect model-facts 60 triangles
turn-z 33
wait
expect turn-z 33
expect message gone.obj
print f-x
note gone
pause 2
reload
wait
print message
print f-x
END
: > "$scratch/out"
(
    await good
    rm "$scratch/gone.obj"
    await gone
    cp "$ROOT/models/box-wing.obj" "$scratch/gone.obj"
) &
writer=$!
view 0 --actions "$scratch/steps" "$scratch/gone.obj"
kill "$writer" 2> /dev/null
[ -z "$(value message)" ] || fail "it is there again: $(value message)"
[[ $(value f-x) == *e* && $(values f-x | uniq | wc -l) -eq 1 ]] || fail "forces: $(values f-x)"

# Nor does a plates file that cannot be read take the place of one that has been.
: > "$scratch/empty.plates"
printf '1\n0 0 1 1 0.5 0.2\n' > "$scratch/good.plates"
cat > "$scratch/steps" << END
method nplate
plates $scratch/good.plates
wait
plates $scratch/empty.plates
plates $scratch/no-such.plates
expect message no-such.plates
wait
expect choose-plates good.plates
expect message no-such.plates
expect f-x e
expect speed-words directions/s
END
view 1 --actions "$scratch/steps" "$ROOT/models/cube.obj"
{ [ "$(grep -c plates "$scratch/err")" -eq 1 ] && grep -q 'steps:4: .*empty.plates' "$scratch/err"; } ||
    fail "the first of two bad plates files: $(cat "$scratch/err")"
judge
