#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# An interrupted table leaves its nodes, says how to go on, and the same command ends with the same
# table as an uninterrupted one; what does not belong to it is refused.
. "$(dirname "$0")/lib.sh"

# interrupt SIGNAL: a run ended by this signal in the midst. Sets `args` to its arguments. Grows the
# work until the signal comes in time.
interrupt() {
    local signal=$1 grid
    for grid in 512 2048 8192 16384 32768; do
        args=(table "$MODELS/box-wing.obj" -o t.nc -o t.spo --step 15 --method raycast --grid "$grid")
        last="timeout -s $signal 0.3 srp ${args[*]}"
        timeout --foreground --preserve-status -s "$signal" 0.3 "$SRP" "${args[@]}" \
            > ../log/out 2> ../log/err
        status=$?
        if [ -e t.nc.partial ]; then
            return
        fi
        rm -f t.nc t.spo
    done
    fail 'no run could be interrupted in the midst'
    finish
}

interrupt INT
[ "$status" -eq 130 ] || fail "exit status $status, expected death by SIGINT"
holds t.nc.partial
says 'interrupted'
says 'of 325 nodes are kept in t.nc.partial; to go on:'
again=$(tail -n 1 ../log/err)
cp t.nc.partial kept

# The same command goes on.
expect 0 "${args[@]}"
says 'going on with t.nc.partial'
holds kept t.nc t.spo
mkdir resumed && mv t.nc t.spo resumed
expect 0 "${args[@]}"
says_not 'going on'
check 'the resumed .nc differs' cmp -s t.nc resumed/t.nc
check 'the resumed .spo differs' cmp -s t.spo resumed/t.spo
rm -r t.nc t.spo resumed

# So does the command that was said, as it was said.
cp kept t.nc.partial
(PATH=$(dirname "$SRP"):$PATH && eval "$again" > ../log/out 2> ../log/err) || fail "cannot run: $again"
says 'going on with t.nc.partial'
rm t.nc t.spo

# A run of another model, method, parameter or grid is refused by name, and nothing is lost.
cp kept t.nc.partial
for change in --seed=1 --grid=100 --step=30 --reference=0,0,1 --material=bus=0,0 --basis; do
    # In place of what the first run said: an option is given once.
    changed=() skip=
    for word in "${args[@]}"; do
        [ -n "$skip" ] || [ "$word" = "${change%%=*}" ] || changed+=("$word")
        [ "$word" = "${change%%=*}" ] && skip=value || skip=
    done
    expect 1 "${changed[@]}" "$change"
    says 't.nc.partial'
    says '--restart discards it'
    check 'the refused file was changed' cmp -s kept t.nc.partial
done
expect 1 table "$MODELS/cube.obj" -o t.nc --step 15
says '--restart discards it'
# Threads, mass, title are no difference.
expect 0 "${args[@]}" --threads 1 --mass 5 --title other
says 'going on with'
rm t.nc t.spo

# --restart begins anew; the hint of a run with it does not repeat it.
cp kept t.nc.partial
expect 0 table "$MODELS/cube.obj" -o t.nc --step 15 --restart
says_not 'going on'
holds kept t.nc
rm t.nc
last='timeout srp ... --restart'
timeout --foreground --preserve-status -s INT 0.3 "$SRP" "${args[@]}" --restart > ../log/out 2> ../log/err
if [ -e t.nc.partial ]; then
    says_not '--restart'
fi
rm -f t.*

# Damage is refused, never half read.
head -c 1000 kept > t.nc.partial
expect 1 "${args[@]}"
says 't.nc.partial'
says '--restart discards it'
echo junk > t.nc.partial
expect 1 "${args[@]}"
says '--restart discards it'
rm t.nc.partial kept

# SIGTERM is as good.
interrupt TERM
[ "$status" -eq 143 ] || fail "exit status $status, expected death by SIGTERM"
holds t.nc.partial
finish
