#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The man page is clean and has every option that --help has.
. "$(dirname "$0")/lib.sh"

expect 0 help --man
silent
cp ../log/out srp.1
check 'the built page is this one' cmp -s srp.1 "$MANUAL"
if command -v mandoc > /dev/null; then
    # Against the base system alone; "unknown manual" would need our own page installed.
    mandoc -T lint -W warning srp.1 > lint 2>&1 || fail "mandoc: $(head -3 lint)"
    mandoc -T ascii srp.1 | sed 's/.\x08//g' > page || fail 'mandoc cannot format the page'
else
    skip 'no mandoc: the man page is checked in its source only'
    sed 's/^\.Sh //; s/\\-/-/g; s/Fl -/--/; s/Fl /-/' srp.1 > page
fi

for command in info force table reoptic convert plot picture compare fit-nplate; do
    expect 0 "$command" --help
    grep -oE -- '^ {2,6}(-[a-z], )?--[a-z-]+' ../log/out | grep -oE -- '--[a-z-]+' > options
    [ "$(wc -l < options)" -ge 3 ] || fail "no options found in the help of $command"
    while read -r option; do
        grep -qE -- "(^|[^a-z-])$option([^a-z-]|\$)" page || fail "the man page lacks $option"
    done < options
done
for text in 'EXIT STATUS' EXAMPLES METHODS 'FILE FORMATS'; do
    grep -q "^$text" page || fail "the man page lacks the section $text"
done
finish
