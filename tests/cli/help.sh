#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# --help and --version of everything: on stdout, status 0, 80 columns.
. "$(dirname "$0")/lib.sh"

commands='info force table reoptic convert plot picture compare fit-nplate cache'

expect 0 --help
prints 'Usage: srp COMMAND'
prints 'Exit status:'
silent
cp ../log/out program
expect 0 -h
check 'srp -h is srp --help' cmp -s program ../log/out
expect 0 help
check 'srp help is srp --help' cmp -s program ../log/out

expect 0 --version
prints 'srp '
prints 'Apache-2.0'
silent
cp ../log/out version

for command in $commands; do
    grep -q "^  $command " program || fail "srp --help lacks $command"
    expect 0 "$command" --help
    silent
    prints "Usage: srp $command"
    prints 'Examples:'
    cp ../log/out help
    expect 0 "$command" -h
    check "srp $command -h" cmp -s help ../log/out
    expect 0 help "$command"
    check "srp help $command" cmp -s help ../log/out
    expect 0 "$command" --version
    check "srp $command --version" cmp -s version ../log/out
    if [ "$(awk 'length > w { w = length } END { print w }' help program)" -ge 80 ]; then
        fail "the help of $command is wider than 79 columns"
    fi
    # Help beats mistakes behind it.
    expect 0 "$command" --help --no-such-option
    expect 0 "$command" --help operand
done

# What the build has is what help names.
for method in exact raycast nplate cannonball; do
    for command in force table; do
        expect 0 "$command" --help
        grep -q "^  $method  *[a-z]" ../log/out || fail "the help of $command lacks method $method"
    done
done
expect 0 table --help
for ending in .nc .spo .txt; do
    grep -q "^  \\$ending  *[A-Za-z]" ../log/out || fail "the help lacks format $ending"
done

# Results that cannot be written are a failure of the machine.
if [ -w /dev/full ]; then
    "$SRP" --help > /dev/full 2> ../log/err
    [ $? -eq 3 ] || fail 'a full disk under stdout'
    says 'cannot write to standard output'
fi
finish
