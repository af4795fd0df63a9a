#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# srp plot: figures look as they have looked, their files are valid, refusals.
#   plot.sh --renew     replaces the golden images by what is drawn now
. "$(dirname "$0")/lib.sh"

GOLDEN=$ROOT/tests/golden
renew=${1:-}

# looks NAME ARGUMENT...: srp with these arguments draws NAME.png as it was.
looks() {
    local name=$1 told
    shift
    expect 0 "$@" -o "$name.png" --width 600
    silent
    if [ "$renew" = --renew ]; then
        "$FIGURE_COMPARE" reduce "$name.png" "$GOLDEN/$name.png" || fail "cannot write $name"
    else
        told=$("$FIGURE_COMPARE" compare "$name.png" "$GOLDEN/$name.png") || fail "$name: $told"
        echo "$name: $told"
    fi
}

expect 0 table "$MODELS/box-wing.obj" -o box.nc -o box.spo --step 10
expect 0 table --method nplate --plates "$MODELS/box-wing.plates" -o plates.nc --step 10
expect 0 table --method cannonball --cr 1.3 --area 20 -o ball.nc --step 15
expect 0 table "$MODELS/sun-shield.obj" -o shield.nc --step 15
expect 0 table "$MODELS/gnss.obj" -o gnss.nc --step 30
expect 0 table "$MODELS/box-wing.obj" -o cast.nc --step 20 --method raycast --grid 32

looks box-wing plot box.nc
looks box-wing-map plot box.nc --map
looks box-wing-view plot box.nc --view 60,20
looks box-wing-plates plot box.nc plates.nc
looks box-wing-plates-map plot box.nc plates.nc --map
looks box-wing-difference compare box.nc plates.nc
looks sun-shield plot shield.nc
looks sun-shield-moment plot shield.nc --moment
looks gnss plot gnss.nc
looks cannonball plot ball.nc
looks raycast-error plot cast.nc --error
if [ -r "$SHARED/spad/One-Wing-Sat.spo" ]; then
    looks one-wing-sat plot "$SHARED/spad/One-Wing-Sat.spo"
else
    skip 'no SPAD files in the shared data'
fi
# The figures of the documentation are those that are drawn now.
expect 0 table "$MODELS/box-wing.obj" -o truth.nc --mass 850 --method raytrace --diffuse 4 --grid 64
expect 0 table --method nplate --plates "$MODELS/box-wing.plates" -o by-hand.nc
expect 0 plot truth.nc -o doc.png --width 800
"$FIGURE_COMPARE" reduce "$ROOT/docs/figures/box-wing-traced.png" small.png
"$FIGURE_COMPARE" compare doc.png small.png || fail 'docs/figures/box-wing-traced.png is not up to date'
expect 0 compare truth.nc by-hand.nc -o doc.png --width 800
"$FIGURE_COMPARE" reduce "$ROOT/docs/figures/box-wing-plates.png" small.png
"$FIGURE_COMPARE" compare doc.png small.png || fail 'docs/figures/box-wing-plates.png is not up to date'

# A figure is the same at any width, letters and lines too; and so is the view along the axes.
for kind in '' --map; do
    expect 0 plot box.nc $kind -o narrow.png --width 600
    expect 0 plot box.nc $kind -o wide.png --width 2400
    "$FIGURE_COMPARE" reduce wide.png half.png && "$FIGURE_COMPARE" reduce half.png small.png
    "$FIGURE_COMPARE" compare narrow.png small.png || fail "--width changes more than the size: plot $kind"
done
expect 0 plot box.nc -o along.png --width 600 --view 0,0
expect 0 plot box.nc -o beside.png --width 600 --view 0,0.01
"$FIGURE_COMPARE" reduce beside.png small.png
"$FIGURE_COMPARE" compare along.png small.png || fail '--view 0,0 draws something else'

# The comparison can fail: another view, another model, other colours.
if [ "$renew" != --renew ]; then
    for other in box-wing-view sun-shield; do
        "$FIGURE_COMPARE" compare "$other.png" "$GOLDEN/box-wing.png" > /dev/null &&
            fail "$other looks like box-wing"
    done
    "$FIGURE_COMPARE" compare box-wing-map.png "$GOLDEN/box-wing-plates-map.png" > /dev/null &&
        fail 'pages of different sizes look alike'
fi

# However fine the table is, files stay of a size that a browser opens.
expect 0 table "$MODELS/cube.obj" -o fine.nc --step 1
expect 0 plot fine.nc -o fine.svg
expect 0 plot fine.nc -o fine-map.svg --map
expect 0 plot fine.nc -o fine-map.pdf --map
for limit in fine.svg=4000000 fine-map.svg=16000000 fine-map.pdf=4000000; do
    size=$(wc -c < "${limit%=*}")
    echo "${limit%=*}: $size bytes"
    [ "$size" -lt "${limit#*=}" ] || fail "${limit%=*} has $size bytes"
done

# Formats are valid, text is text, the same command gives the same picture.
expect 0 plot box.nc -o a.svg
prints 'a.svg'
expect 0 plot box.nc -o a.pdf --map
expect 0 plot box.nc -o a.png
expect 0 plot box.nc -o b.png
cmp -s a.png b.png || fail 'the same command draws another picture'
if command -v xmllint > /dev/null; then
    xmllint --noout a.svg 2> ../log/err || fail 'the SVG is not XML'
else
    skip 'no xmllint: the SVG is checked in its ends only'
fi
[ "$(head -c 5 a.svg)" = '<?xml' ] || fail 'the SVG has no head'
grep -q '</svg>' a.svg || fail 'the SVG has no end'
if command -v pdfinfo > /dev/null; then
    pdfinfo a.pdf > info 2> ../log/err || fail 'the PDF is broken'
    silent
    grep -q '^Pages: *1$' info || fail 'the PDF has not one page'
    pdftotext a.pdf - 2> ../log/err | grep -q 'box-wing.obj, exact, 10 x 10 degrees' ||
        fail 'the PDF has no title that can be read'
    # The contour of 0 is labelled so, not by what sums of steps leave of it.
    expect 0 plot box.nc -o zero.pdf --map
    pdftotext zero.pdf words 2> ../log/err
    grep -q '[0-9]e-' words && fail 'the contour of 0 has a label beside 0'
else
    skip 'no pdfinfo: the PDF is checked in its ends only'
fi
[ "$(head -c 5 a.pdf)" = '%PDF-' ] || fail 'the PDF has no head'
expect 0 plot box.nc -o wide.png --width 2000 --title 'A #title with 50 % <signs> & "quotes"'
expect 0 plot box.nc -o quotes.svg --title 'A #title with 50 % <signs> & "quotes"'
! command -v xmllint > /dev/null || xmllint --noout quotes.svg || fail 'a title breaks the SVG'
# The standard size is 1200 pixels: bytes 16 to 23 of a PNG.
[ "$(od -An -tu1 -j16 -N4 a.png | awk '{ print $3 * 256 + $4 }')" -eq 1200 ] || fail 'not 1200 wide'

# Titles and names of any length and letters stay on the page: first smaller, then without their middle.
mkdir 'a ü'
long=$(printf 'a long title %.0s' {1..40})
expect 0 plot box.nc -o 'a ü/☀ #1.pdf' --title "Anfang ☀ $long Ende"
silent
if command -v pdftotext > /dev/null; then
    pdftotext 'a ü/☀ #1.pdf' - 2> ../log/err > words
    for word in 'Anfang' '…' 'Ende'; do
        grep -q "$word" words || fail "the long title lacks $word"
    done
    expect 0 plot box.nc -o fits.pdf --title "${long:0:120}"
    pdftotext fits.pdf - | grep -q '…' && fail 'a title that fits is cut'
fi
cp box.nc 'tä ble #d.nc'
expect 0 plot 'tä ble #d.nc' plates.nc -o two.png
silent
name=$(printf 'y%.0s' {1..251}).png # there is no room for what it is called until it is whole
expect 3 plot box.nc -o "$name"
says "$name: cannot write: "
[ "$(wc -l < ../log/err)" -eq 1 ] || fail 'more than one message'

# Tables of two by two nodes, of one value, of 0, and with a hole.
expect 0 table "$MODELS/cube.obj" -o least.nc --az-step 360 --el-step 180
for how in '' --map; do
    # shellcheck disable=SC2086
    expect 0 plot least.nc -o least.png $how
    silent
done
expect 0 table --method cannonball --cr 0 --area 2 -o none.nc --step 30
expect 1 plot none.nc -o x.png
says 'none.nc: the force is 0 from all directions'
expect 0 convert box.nc hole.txt --mass 3
sed -i '40s/[^ ]*$/nan/' hole.txt
expect 1 plot hole.txt -o x.png
says "hole.txt:40:"

# What replaces a figure is whole; what fails leaves the old one.
cp a.png keep.png
expect 1 plot none.nc -o keep.png
cmp -s a.png keep.png || fail 'a failed plot changed the figure'
if [ -w /dev/full ]; then
    ln -s /dev/full full.png.part
    expect 3 plot box.nc -o full.png
    says 'full.png: the figure could not be written'
    [ ! -e full.png ] || fail 'half a figure is there'
fi

# Refusals.
expect 2 plot box.nc
says '-o FIG.png, .svg or .pdf'
expect 2 plot -o a.png
says 'expected one table or two'
expect 2 plot box.nc box.nc box.nc -o a.png
says 'expected one table or two, found 3'
expect 2 plot box.nc -o a.jpg
says 'a.jpg: unknown ending (formats of figures: .png, .svg, .pdf)'
expect 2 plot box.nc -o .png
expect 3 plot box.nc -o none/a.png
says 'none/a.png: cannot write'
for view in 30 30,86 30,-1 x,3 400,10; do
    expect 2 plot box.nc -o x.png --view "$view"
    says "--view $view: expected AZ,EL"
done
expect 2 plot box.nc -o x.png --width 599
says 'a whole number from 600 to 10000'
expect 2 plot box.nc -o x.png --title "$(printf 'bad\xff')"
says '--title: byte 4 is not UTF-8'
for control in '\n' '\t' '\x7f'; do
    expect 2 plot box.nc -o x.png --title "$(printf "a${control}b")"
    says '--title: byte 2 is a control character'
done
expect 0 plot box.nc -o UPPER.PNG
cmp -s UPPER.PNG a.png || fail 'an ending in capitals draws another picture'
expect 2 plot box.nc -o x.png --map --view 30,30
says '--view is for surfaces'
expect 2 plot box.nc -o x.png --width 20
says 'a whole number from 600 to 10000'
expect 1 plot plates.nc -o x.png --moment
says 'plates.nc: holds no moments'
expect 1 plot box.spo -o x.png --error
says 'box.spo: holds no standard errors'
expect 2 compare box.nc plates.nc -o x.txt
says 'formats of figures'
cp box.nc table.png
expect 2 plot box.nc table.png -o x.png
says 'unknown ending (formats of tables'
[ ! -e x.png ] || fail 'a refused plot left a file'
finish
