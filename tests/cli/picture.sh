#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# srp picture: pictures look as they have looked, refusals, and what may be in names and titles.
#   picture.sh --renew     replaces the golden images by what is drawn now
. "$(dirname "$0")/lib.sh"

GOLDEN=$ROOT/tests/golden
renew=${1:-}

if ! "$SRP" picture "$MODELS/cube.obj" --az 30 --el 20 -o probe.png > ../log/out 2> ../log/err; then
    if grep -qE 'OSMesa|EGL' ../log/err; then
        skip "no OpenGL: $(head -1 ../log/err)"
        finish
    fi
    fail 'srp picture draws nothing'
    finish
fi

# looks NAME ARGUMENT...: srp picture with these arguments draws picture-NAME.png as it was.
looks() {
    local name=picture-$1 told
    shift
    expect 0 picture "$@" -o "$name.png" --size "${size:-800x480}"
    silent
    prints "$name.png"
    if [ "$renew" = --renew ]; then
        "$FIGURE_COMPARE" reduce "$name.png" "$GOLDEN/$name.png" || fail "cannot write $name"
    else
        told=$("$FIGURE_COMPARE" compare "$name.png" "$GOLDEN/$name.png") || fail "$name: $told"
        echo "$name: $told"
    fi
}

looks box-wing "$MODELS/box-wing.obj" --az 35 --el 25
looks sun-shield "$MODELS/sun-shield.obj" --az 20 --el -50
looks gnss "$MODELS/gnss.obj" --az -150 --el -60 --view 240,-40
looks dish "$MODELS/dish.obj" --az 35 --el 40
looks dish-force "$MODELS/dish.obj" --az 35 --el 40 --light force
looks icosphere "$MODELS/icosphere-320.obj" --az 100 --el 90 --light incidence
# As small as pictures may be: words in brief, nothing cut.
size=300x300 looks small "$MODELS/gnss.obj" --az 35 --el 40
size=300x300 looks small-incidence "$MODELS/gnss.obj" --az 35 --el 40 --light incidence

# Numbers are those of srp force, to the digits that are shown.
for model in box-wing gnss dish sun-shield; do
    for sun in '35 25' '-150 -60' '0 90' '90.5 0.25'; do
        expect 0 force "$MODELS/$model.obj" --az "${sun% *}" --el "${sun#* }"
        awk 'function show(x) { return sprintf("%.4g", x * x > 1e-24 * size * size ? x : 0) }
            $1 == "area" { x = $4; y = $5; z = $6; size = sqrt(x * x + y * y + z * z) }
            $1 == "lit" { lit = $3 }
            $1 == "force" { force = sqrt($3 * $3 + $4 * $4 + $5 * $5) }
            END { printf "Direct light: f = (%s, %s, %s) m², |f| = %.4g m²\n", show(x), show(y), show(z), size
                  printf "force at 1 au %.4g N; lit area %.4g m²\n", force, lit }' ../log/out > numbers
        expect 0 picture "$MODELS/$model.obj" --az "${sun% *}" --el "${sun#* }" -o n.png --size 300x300
        tail -n +2 ../log/out | cmp -s - numbers || fail "expected $(cat numbers)"
    done
done

# The panel's shadow is on the box: of one face, one part is lit and one is dark.
expect 0 picture "$MODELS/box-wing.obj" --az 70 --el 15 --view 115,15 -o shadow.png
lit=$("$FIGURE_COMPARE" lightness shadow.png 1178,470)
dark=$("$FIGURE_COMPARE" lightness shadow.png 1206,460)
echo "box-wing: L* $lit in the Sun, $dark in shadow"
awk "BEGIN { exit !($lit > 55 && $dark < 30) }" || fail 'no shadow on the box'

# The pictures of the documentation are those that are drawn now.
for name in picture-dish picture-dish-force; do
    light=material
    [ "$name" = picture-dish ] || light=force
    expect 0 picture "$MODELS/dish.obj" --az 35 --el 40 -o doc.png --size 1200x675 --light "$light"
    [ "$renew" != --renew ] || cp doc.png "$ROOT/docs/figures/$name.png"
    "$FIGURE_COMPARE" reduce "$ROOT/docs/figures/$name.png" small.png
    "$FIGURE_COMPARE" compare doc.png small.png > /dev/null || fail "docs/figures/$name.png is not up to date"
done

# The comparison can fail: another Sun, another colouring.
if [ "$renew" != --renew ]; then
    expect 0 picture "$MODELS/dish.obj" --az 80 --el 40 -o other.png --size 800x480
    for other in other picture-dish-force; do
        "$FIGURE_COMPARE" compare "$other.png" "$GOLDEN/picture-dish.png" > /dev/null &&
            fail "$other looks like dish"
    done
fi

# The same command gives the same picture, of the size that was asked for.
size_of() { od -An -tu1 -j16 -N8 "$1" | awk '{ print $3 * 256 + $4 "x" $7 * 256 + $8 }'; }
expect 0 picture "$MODELS/cube.obj" --az 30 --el 20 -o a.png
expect 0 picture "$MODELS/cube.obj" --az 30 --el 20 -o b.png
cmp -s a.png b.png || fail 'the same command draws another picture'
[ "$(size_of a.png)" = 1600x900 ] || fail "the standard size is $(size_of a.png)"
for size in 300x300 1500x300 300x1500 2001x1003; do
    expect 0 picture "$MODELS/cube.obj" --az 30 --el 20 -o size.png --size "$size"
    silent
    [ "$(size_of size.png)" = "$size" ] || fail "$(size_of size.png) pixels, expected $size"
done

# Names and titles as people have them; a missing force; the Sun at the poles and below.
mkdir 'a folder'
sed 's/^usemtl .*/usemtl größe/; /^mtllib/d' "$MODELS/cube.obj" > 'a folder/Würfel & Söhne #1.obj'
long=$(printf 'a very long title %.0s' {1..40})
expect 0 picture 'a folder/Würfel & Söhne #1.obj' --material 'größe=0.1,0.2' --az 0 --el 90 -o 'a folder/ü.png'
silent
expect 0 picture "$MODELS/cube.obj" --az 0 --el -90 -o long.png --title "$long <b>&amp;"
silent
expect 0 picture "$MODELS/cube.obj" "$MODELS/dish.obj" --az 1 --el 1 -o two.png
silent
expect 0 picture "$MODELS/cube.obj" --az 1 --el 1 -o unit.png --unit mm
silent
cat > edge.obj << 'END'
v 0 0 0
v 0 1 0
v 0 0 1
usemtl sheet
f 1 2 3
END
expect 0 picture edge.obj --material sheet=0.1,0.2 --az 90 --el 0 -o edge.png --light force
silent

# A model far from the origin of the body is as large in the picture as one about it.
expect 0 picture "$MODELS/cube.obj" --az 35 --el 40 -o near.png --size 800x480 --title same
awk '$1 == "v" { printf "v %.17g %s %s\n", $2 + 1e6, $3, $4; next } { print }' "$MODELS/cube.obj" > far.obj
cp "$MODELS/cube.mtl" .
expect 0 picture far.obj --az 35 --el 40 -o far.png --size 800x480 --title same
size=$("$FIGURE_COMPARE" reduce near.png small.png && "$FIGURE_COMPARE" compare far.png small.png) || true
echo "near and far: $size"
awk '{ exit !($3 < 3) }' <<< "$size" || fail "far from the origin: $size"

# What replaces a picture is whole; what fails leaves the old one.
cp a.png keep.png
expect 1 picture none.obj --az 1 --el 1 -o keep.png
cmp -s a.png keep.png || fail 'a failed picture changed the old one'
if [ -w /dev/full ]; then
    ln -s /dev/full full.png.part
    expect 3 picture "$MODELS/cube.obj" --az 1 --el 1 -o full.png
    says 'full.png: cannot write'
    says 'No space left on device'
    [ ! -e full.png ] || fail 'half a picture is there'
fi

# Refusals.
expect 2 picture -o x.png --az 1 --el 1
says 'expected one model or more'
expect 2 picture "$MODELS/cube.obj" --az 1 --el 1
says 'where to?'
expect 2 picture "$MODELS/cube.obj" --az 1 -o x.png
says 'the direction of the Sun is missing'
expect 2 picture "$MODELS/cube.obj" --az 1 --el 91 -o x.png
for output in x.svg x .png; do
    expect 2 picture "$MODELS/cube.obj" --az 1 --el 1 -o "$output"
    says 'unknown ending'
done
expect 3 picture "$MODELS/cube.obj" --az 1 --el 1 -o none/x.png
says 'none/x.png: cannot write'
cp "$MODELS/cube.obj" cube.png
expect 2 picture cube.png --az 1 --el 1 -o cube.png
says 'input and output at once'
for size in 1600 299x300 300x5001 1e3x300 x 300x -300x300 1600x900x2 ''; do
    expect 2 picture "$MODELS/cube.obj" --az 1 --el 1 -o x.png --size "$size"
    says 'expected WIDTHxHEIGHT'
done
for view in 30 x,3 400,10 10,91; do
    expect 2 picture "$MODELS/cube.obj" --az 1 --el 1 -o x.png --view "$view"
    says 'expected AZ,EL'
done
expect 2 picture "$MODELS/cube.obj" --az 1 --el 1 -o x.png --light dark
says 'expected material, incidence or force'
expect 2 picture "$MODELS/cube.obj" --az 1 --el 1 -o x.png --title "$(printf 'a\xff')"
expect 0 picture --help
prints_not --plates
prints_not "Formats of tables"
expect 2 picture "$MODELS/cube.obj" --az 1 --el 1 -o x.png --plates "$MODELS/cube.plates"
says "unknown option '--plates'"
expect 2 picture "$MODELS/cube.obj" --az 1 --el 1 -o x.png --device gpu
says '--device gpu: expected'
GALLIUM_DRIVER=nonesuch expect 3 picture "$MODELS/cube.obj" --az 1 --el 1 -o x.png --device gl:osmesa
says 'GALLIUM_DRIVER'
[ ! -e x.png ] || fail 'a refused picture left a file'
finish
