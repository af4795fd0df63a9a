#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The bar: on a terminal only, within its width, gone at the end.
. "$(dirname "$0")/lib.sh"

if ! command -v script > /dev/null; then
    skip 'no script(1) to make a terminal'
    finish
fi

args="table '$MODELS/dish.obj' -o t.spo --step 30"
# on_terminal COLUMNS: runs srp there; what the terminal sees is in ../log/out.
on_terminal() {
    last="srp $args on $1 columns"
    script -qec "stty cols $1; '$SRP' $args" /dev/null > ../log/out 2> ../log/err < /dev/null ||
        fail 'the run failed'
    tr '\r' '\n' < ../log/out | sed 's/\x1b\[K//g' > seen
}

on_terminal 100
grep -qE '^\[=* *\] +[0-9]+ %  [0-9]+ of 91 nodes' seen || fail 'no bar was drawn'
check 'the bar is too wide' awk 'length > 99 { exit 1 }' seen
# The last thing drawn is cleared: a carriage return, then "erase the line", before the results.
grep -qP '\r\x1b\[Kt\.spo' ../log/out || fail 'the bar is not cleared'

on_terminal 30
check 'too wide for 30 columns' awk '/%/ && length > 29 { exit 1 }' seen
on_terminal 4
grep -q 't.spo' seen || fail 'no result on a terminal of 4 columns'

# Not a terminal: nothing.
expect 0 table "$MODELS/dish.obj" -o t.spo --step 30
silent
finish
