#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# srp cache, and srp table --cache: the same table, from what is remembered.
. "$(dirname "$0")/lib.sh"

export XDG_CACHE_HOME=$PWD/../home
kept=$XDG_CACHE_HOME/srpcore
wing=$MODELS/box-wing.obj

expect 0 cache path
prints "$kept"
expect 0 cache list
prints "0 files, 0 bytes in $kept"
check 'looking makes no directory' test ! -e "$kept"

# Not used unless asked for.
expect 0 table "$wing" -o plain.txt --mass 850 --step 30
check 'a plain run keeps nothing' test ! -e "$kept"

expect 0 table "$wing" -o a.txt --mass 850 --step 30 --cache
silent
check 'the same table' cmp -s plain.txt a.txt
expect 0 table "$wing" -o b.txt --mass 850 --step 30 --cache
says '91 of 91 nodes come from the cache'
check 'the same table again' cmp -s plain.txt b.txt
expect 0 cache list
prints 'exact (cpu), 91 of 91 nodes'
prints '1 files, '

# Other optics, method or sums are another table.
expect 0 table "$wing" -o c.txt --mass 850 --step 30 --cache --material cells=0.1,0.1
says_not 'from the cache'
expect 0 table "$wing" -o d.nc --step 30 --cache --basis
says_not 'from the cache'
expect 0 cache list
prints '3 files, '

# Interrupted, damaged, full: the run ends well.
file=$(find "$kept" -name '*.nc' | LC_ALL=C sort | head -1)
for name in "$kept"/*.nc; do
    printf 'x' | dd of="$name" bs=1 seek=400 conv=notrunc 2> /dev/null
done
expect 0 table "$wing" -o e.txt --mass 850 --step 30 --cache
says 'warning: the file is damaged: its bytes do not match their checksum; it is set aside as '
check 'damage shows in no number' cmp -s plain.txt e.txt
expect 0 cache list
prints 'set aside'
prints 'cannot be read: the file is damaged'
test -n "$file" || fail 'no file in the cache'

expect 0 table --method cannonball --cr 1.5 --area 2 -o h.nc --step 30 --cache
expect 0 table --method cannonball --cr 1.5 --area 3 -o i.nc --step 30 --cache
says_not 'from the cache'
expect 0 cache clear
prints '6 files removed'
expect 0 cache list
prints '0 files, '

# A cache that cannot be written is read; a directory in the place of its lock stops root as well.
expect 0 table "$wing" -o j.txt --mass 850 --step 30 --cache
expect 0 table "$wing" -o k.nc --step 30 --cache --basis
rm "$kept/lock"
mkdir "$kept/lock"
expect 0 table "$wing" -o l.txt --mass 850 --step 30 --cache
says '91 of 91 nodes come from the cache'
says_not 'warning'
check 'the same table from a cache that cannot be written' cmp -s plain.txt l.txt
expect 0 table "$wing" -o m.txt --mass 850 --step 45 --cache
says 'warning: the run goes on without the cache'
[ "$(grep -c warning ../log/err)" -eq 1 ] || fail 'more than one warning'
rmdir "$kept/lock"

# What is interrupted is remembered, whatever the next run calls its output, and where the step is
# for srp to choose. The work grows until the signal comes in time.
interrupt() {
    last="timeout -s INT 1.5 srp table $* ${work[*]}"
    timeout --foreground --preserve-status -s INT 1.5 "$SRP" table "$@" "${work[@]}" \
        > ../log/out 2> ../log/err
    grep -q 'to go on:' ../log/err
}
for grid in 512 2048 8192 16384 32768; do
    work=("$wing" --method raycast --grid "$grid" --cache)
    rm -f n.nc n.nc.partial p.nc
    interrupt -o n.nc --step=15 && interrupt -o p.nc --max-error=1e-9 --check=2 && break
done
says 'nodes of this step are in the cache; to go on:'
check 'a partial file where the step is chosen' test ! -e p.nc.partial
interrupt -o o.nc --step=15
says 'of 325 nodes come from the cache'
rm -f o.nc.partial

echo plain > file
XDG_CACHE_HOME=$PWD/file/below
expect 0 table "$wing" -o f.txt --mass 850 --step 30 --cache
says 'Not a directory'
says 'warning: the run goes on without the cache'
check 'no cache shows in no number' cmp -s plain.txt f.txt
[ "$(grep -c . ../log/err)" -eq 2 ] || fail 'more than one complaint'
expect 3 cache clear
says 'Not a directory'
unset XDG_CACHE_HOME
HOME='' expect 0 table "$wing" -o g.txt --mass 850 --step 30 --cache
says 'neither XDG_CACHE_HOME nor HOME'
HOME='' expect 1 cache list
expect 0 cache list --directory "$PWD/nowhere"
prints '0 files, '

expect 2 cache
says 'expected one of list, clear and path'
expect 2 cache list clear
expect 2 cache empty
says "'empty': expected list, clear or path"

finish
