#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Outputs that cannot be written: status 3, before the computing where that can be known, and no
# half-written file.
. "$(dirname "$0")/lib.sh"

cube=$MODELS/cube.obj
table=(table "$cube" --step 30)

expect 3 "${table[@]}" -o none/a.nc
says 'none/a.nc: cannot write: No such file or directory'
mkdir dir.nc
expect 3 "${table[@]}" -o dir.nc
says 'dir.nc: cannot write: is a directory'
touch file
expect 3 "${table[@]}" -o file/a.spo
says 'file/a.spo: cannot write: Not a directory'
rmdir dir.nc
rm file

# All outputs are checked first: the good one is not written.
expect 3 "${table[@]}" -o good.nc -o none/a.spo
holds

if [ "$(id -u)" -ne 0 ]; then
    mkdir locked
    chmod a-w locked
    expect 3 "${table[@]}" -o locked/a.nc
    says 'locked/a.nc: cannot write: Permission denied'
    rmdir locked
else
    skip 'root may write everywhere'
fi

# A full disk shows only when writing. What was computed is kept; the command again writes it.
if [ -c /dev/full ]; then
    for ending in nc spo txt; do
        ln -s /dev/full "full.$ending"
        expect 3 "${table[@]}" -o "full.$ending" -o good.spo --mass 10
        says "full.$ending"
        says 'to go on'
        holds "full.$ending" "full.$ending.partial" good.spo
        rm "full.$ending" good.spo
        expect 0 "${table[@]}" -o "full.$ending" -o good.spo --mass 10
        says 'going on with'
        holds "full.$ending" good.spo
        rm "full.$ending" good.spo
        expect 0 "${table[@]}" -o good.nc
        ln -s /dev/full "full.$ending"
        expect 3 convert good.nc "full.$ending" --mass 10
        rm "full.$ending" good.nc
        holds
    done
else
    skip 'no /dev/full'
fi

# A file beyond the limit of the system is a failure like a full disk: nothing half-written stays.
# ThreadSanitizer keeps its own books in files: what it watches cannot work below such a limit.
if (ulimit -f 50 && exec "$SRP" force "$MODELS/cube.obj" --az 0 --el 0 > /dev/null 2>&1); then
    for ending in nc spo; do
        last="ulimit -f 50; srp table -o lim.$ending"
        (
            ulimit -f 50
            exec "$SRP" table "$MODELS/box-wing.obj" -o "lim.$ending" --step 3 > ../log/out 2> ../log/err
        )
        got=$?
        [ "$got" -eq 3 ] || fail "exit status $got, expected 3"
        says "lim.$ending: "
        holds
    done
else
    skip 'srp does not run with a limit on the size of files'
fi

# What a link points to is written, and a pipe is written into: neither is replaced by a file.
expect 0 table "$MODELS/box-wing.obj" --step 15 -o t.nc
for output in --output --residuals --gmat; do
    mkfifo pipe
    timeout 60 cat pipe > got &
    reader=$!
    expect 0 fit-nplate t.nc --plates 6 "$output" pipe
    [ -p pipe ] || fail "$output replaced a pipe"
    [ -p pipe ] || kill "$reader"
    wait "$reader"
    [ -s got ] || fail "$output wrote nothing into a pipe"
    echo old > real
    ln -s real link
    expect 0 fit-nplate t.nc --plates 6 "$output" link
    [ -L link ] || fail "$output replaced a link"
    cmp -s got real || fail "$output: a link and a pipe differ"
    rm pipe got link real
done
echo old > real
ln -s real link.spo
expect 0 convert t.nc link.spo --mass 10
[ -L link.spo ] || fail 'a table replaced a link'
grep -q '^Motion' real || fail 'a table was not written through a link'
rm real link.spo
if "$SRP" plot t.nc -o a.png > ../log/out 2> ../log/err; then
    echo old > real
    ln -s real link.png
    expect 0 plot t.nc -o link.png
    [ -L link.png ] || fail 'a figure replaced a link'
    cmp -s a.png real || fail 'a figure was not written through a link'
    mkfifo pipe.png
    expect 3 plot t.nc -o pipe.png
    says 'pipe.png: cannot write: a figure needs a regular file'
    [ -p pipe.png ] || fail 'a figure replaced a pipe'
    rm a.png real link.png pipe.png
else
    skip 'no figures'
fi
rm t.nc
holds

# An old file stays as it was until the new one is whole; then it is replaced.
echo old > a.spo
expect 1 table none.obj -o a.spo
[ "$(cat a.spo)" = old ] || fail 'a failed run touched the old file'
expect 0 "${table[@]}" -o a.spo
grep -q '^Motion' a.spo || fail 'the old file was not replaced'
holds a.spo
finish
