#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A long table is saved every half minute, in the cache as well where it may use that: what is killed
# without warning can go on from there.
. "$(dirname "$0")/lib.sh"

export XDG_CACHE_HOME=$PWD/../home
work=("$MODELS/gnss.obj" --step 1 --method raycast --grid 4096 --cache)
args=(table -o t.nc "${work[@]}")
last="srp ${args[*]}"
"$SRP" "${args[@]}" > ../log/out 2> ../log/err &
job=$!
for ((second = 0; second < 90; ++second)); do
    sleep 1
    [ -z "$(find "$XDG_CACHE_HOME" -name '*.nc' 2> /dev/null)" ] || break
done
kill -KILL "$job"
wait "$job" 2> /dev/null
check 'nothing was saved within 90 s' test -e t.nc.partial
check 'saved too early' test "$second" -ge 25

timeout --foreground --preserve-status -s INT 5 "$SRP" "${args[@]}" > ../log/out 2> ../log/err
[ $? -eq 130 ] || fail 'the second run did not end by SIGINT'
says 'going on with t.nc.partial'
says 'interrupted'

# Another output knows nothing of t.nc.partial.
timeout --foreground --preserve-status -s INT 5 "$SRP" table -o u.nc "${work[@]}" \
    > ../log/out 2> ../log/err
says 'nodes come from the cache'
says_not 'going on with'
rm -f u.nc.partial t.nc.*.tmp # of the killed run, if it was just writing
holds t.nc.partial
finish
