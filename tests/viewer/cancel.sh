#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What takes long can be stopped, and holds up nobody who closes the window.
. "$(dirname "$0")/lib.sh"
start_display

# in_seconds LIMIT STATUS ARGUMENTS...: view, which must take less.
in_seconds() {
    local limit=$1 began=$SECONDS
    shift
    view "$@"
    [ $((SECONDS - began)) -lt "$limit" ] || fail "took $((SECONDS - began)) s, expected less than $limit"
}

# 64 plates to 16,000 directions take minutes: cancelled early, later and again, then closed meanwhile.
"$SRP" table "$ROOT/models/box-wing.obj" --step 2 -o "$scratch/fine.nc" > "$scratch/table.log" 2>&1 ||
    fail "srp table: $(cat "$scratch/table.log")"
cat > "$scratch/steps" << END
wait
tab compare
open-table $scratch/fine.nc
wait
fit 0
expect message Plates to fit 0: expected a whole number from 1 to 64
fit -1
expect message Plates to fit -1: expected a whole number from 1 to 64
fit 65
expect message Plates to fit 65: expected a whole number from 1 to 64
fit 4294967297
expect message Plates to fit 4294967297: expected a whole number from 1 to 64
fit 1.5
expect message Plates to fit 1.5: expected a whole number from 1 to 64
fit abc
expect message Plates to fit abc: expected a whole number from 1 to 64
expect plates-count 8
fit 64
expect plates-count 64
expect fit-progress Fitting …
pause 1.2
print fit-progress
cancel
expect fit-progress Cancelling …
wait
expect message The fit was cancelled.
fit 64
pause 4
cancel
fit 1
wait
expect message 1 plate fitted
fit 64
pause 0.5
END
in_seconds 100 0 --actions "$scratch/steps" "$ROOT/models/cube.obj"
value fit-progress | grep -q '^Fitting … [1-9][0-9]* s$' || fail "progress is '$(value fit-progress)'"

# What waits behind a fit says so; what is not wanted any more is said of both.
"$SRP" table "$ROOT/models/box-wing.obj" --step 10 -o "$scratch/coarse.nc" > "$scratch/table.log" 2>&1 ||
    fail "srp table: $(cat "$scratch/table.log")"
cat > "$scratch/steps" << END
az-step 30
el-step 30
wait
tab compare
open-table $scratch/coarse.nc
wait
fit 64
pause 0.3
compute-table
expect progress Waiting for the fit …
cancel
wait
expect message The fit was cancelled.
expect message The table was cancelled.
expect compare-b
print table
END
in_seconds 60 0 --actions "$scratch/steps" "$ROOT/models/cube.obj"
value table | grep -q '^1: coarse.nc' || fail "the table shown is '$(value table)'"

# With the tables goes what is being made of them; a table that is computed comes, and took its own time.
cat >> "$scratch/steps" << END
fit 64
pause 0.3
clear-tables
wait
expect message The fit was cancelled.
note forgotten
print compare-a
print compare-b
open-table $scratch/coarse.nc
wait
fit 64
pause 0.3
compute-table
pause 1.5
clear-tables
wait
print message
print table
print compare-a
print compare-b
END
in_seconds 60 0 --actions "$scratch/steps" "$ROOT/models/cube.obj"
sed -n '/^forgotten/,$p' "$scratch/out" > "$scratch/after"
printf '%s: \n' compare-a compare-b | diff - <(sed -n '2,3p' "$scratch/after") || fail 'a table that was forgotten is compared'
value message | grep -q '^Table 1: cube.obj.*computed in 0\.[0-9]* s\.$' || fail "of the table: '$(value message)'"
for list in table compare-a; do
    value $list | grep -q '^1: cube.obj' || fail "$list is '$(value $list)'"
done
[ -z "$(value compare-b)" ] || fail "the only table is compared with itself: '$(value compare-b)'"

# One direction, which cannot be interrupted, takes seconds: it is said that its end is waited for.
cat > "$scratch/steps" << END
method raytrace
parameter grid=768
parameter diffuse=8
wait
tab graphics
compute-table
pause 1
cancel
expect progress Cancelling …
wait
expect message The table was cancelled.
parameter grid=32
parameter diffuse=1
az-step 0.5
el-step 0.5
wait
compute-table
pause 1
compute-table
pause 2
expect progress directions
print message
END
view 0 --actions "$scratch/steps" "$ROOT/models/dish.obj"
[ -z "$(value message)" ] || fail "of a table that a newer one replaces: $(value message)"

# Or minutes: the program ends without it, all is remembered, and its status is as ever.
cat > "$scratch/steps" << END
method raytrace
wait
parameter diffuse=8
parameter grid=8192
note closed
pause 1
END
in_seconds 100 0 --remember --actions "$scratch/steps" "$ROOT/models/dish.obj"
grep -q '^closed$' "$scratch/out" || fail 'what was printed is lost'
grep -rq 'grid=8192\|grid.*8192' "$XDG_CONFIG_HOME/srpcore" || fail 'the state was not saved'
echo 'no-such-step' >> "$scratch/steps"
in_seconds 100 1 --actions "$scratch/steps" "$ROOT/models/dish.obj"
judge
