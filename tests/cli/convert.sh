#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# srp convert: there and back, signs, refusals.
. "$(dirname "$0")/lib.sh"

expect 0 table "$MODELS/dish.obj" -o a.nc -o a.spo -o a.txt --step 30 --mass 12.5 --flux 1361
expect 0 convert a.nc b.spo
silent
prints 'b.spo'
prints '91 nodes'
check 'nc to spo is the spo itself' cmp -s a.spo b.spo
expect 0 convert a.nc b.txt
check 'nc to txt is the txt itself' cmp -s a.txt b.txt
expect 0 convert a.spo c.nc
expect 0 convert c.nc c.spo

# numbers FILE: the force columns of a .spo.
numbers() { awk 'NF == 11 && $1 + 0 == $1 { print $1, $2, $3, $4, $5, $7, $8, $9 }' "$1"; }
numbers a.spo > a.num
[ "$(wc -l < a.num)" -eq 91 ] || fail 'the test reads the wrong lines'
numbers c.spo | cmp -s a.num - || fail 'spo to nc to spo changes numbers'

# The mass and the flux of the input are known, those of a .spo are not.
expect 2 convert a.spo d.txt
says '--mass KG'
expect 0 convert a.spo d.txt --mass 12.5 --flux 1361
awk '$1 + 0 == $1 && NF >= 6' d.txt > d.num
awk '$1 + 0 == $1 && NF >= 6' a.txt | cmp -s - d.num || fail 'spo to txt differs from txt'
expect 0 convert a.txt e.spo
expect 0 convert e.spo e.spo --title 'in place'
grep -q 'in place' e.spo || fail 'the title was not changed'

# Signs: light can only push.
expect 2 convert a.spo f.spo --flop
says "did you mean '--flip'?"
expect 1 convert a.spo f.spo --flip
says '--flip would make it pull'
awk 'function turn(x) { return x ~ /^-/ ? substr(x, 2) : "-" x }
     NF == 11 && $1 + 0 == $1 {
         $3 = turn($3); $4 = turn($4); $5 = turn($5); $7 = turn($7); $8 = turn($8); $9 = turn($9)
     }
     { print }' a.spo > wrong.spo
expect 1 convert wrong.spo f.spo
says 'wrong.spo: light pulls from 100 % of the directions'
says '--flip'
expect 0 convert wrong.spo f.spo --flip
numbers f.spo > f.num
paste a.num f.num | awk '{ for (i = 3; i <= 8; ++i) if ($i + 0 != $(i + 8) + 0) exit 1 }' ||
    fail 'flipping twice is not the same'
if [ -r "$SHARED/spad/SphericalModel.spo" ]; then
    expect 1 convert "$SHARED/spad/SphericalModel.spo" s.nc
    says '--flip'
    [ ! -e s.nc ] || fail 'a refused table was written'
    expect 0 convert "$SHARED/spad/SphericalModel.spo" s.nc --flip
    expect 0 convert "$SHARED/spad/One-Wing-Sat.spo" o.nc
    says 'One-Wing-Sat.spo: warning: the nodes at elevation -90 are one direction'
    says 'One-Wing-Sat.spo: warning: the nodes at elevation 90 are one direction'
    says 'One-Wing-Sat.spo: warning: forces are rounded to 0.01 m^2'
else
    skip 'no SPAD files in the shared data'
fi

# Refusals.
expect 1 convert none.nc x.spo
says 'none.nc'
echo junk > junk.nc
expect 1 convert junk.nc x.spo
says 'junk.nc'
cp junk.nc junk.spo
expect 1 convert junk.spo x.nc
says 'junk.spo:1'
cp junk.nc junk.txt
expect 1 convert junk.txt x.nc
says 'junk.txt'
mkdir dir.spo
expect 1 convert dir.spo x.nc
says 'is a directory'
head -c 2000 a.spo > half.spo
expect 1 convert half.spo x.nc
says 'half.spo'
expect 3 convert a.nc none/x.spo
says 'none/x.spo: cannot write'
! [ -e x.nc ] || fail 'a failed conversion left a file'
finish
