#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The completion of bash loads and offers commands, options, values and files.
. "$(dirname "$0")/lib.sh"

expect 0 help --completion
silent
cp ../log/out srp.bash
check 'the built script is this one' cmp -s srp.bash "$COMPLETION"
last='source srp.bash'
# shellcheck disable=SC1091
. ./srp.bash 2> ../log/err || fail 'the script does not load'
silent
complete -p srp > /dev/null 2>&1 || fail 'no completion is registered'

# offers EXPECTED WORD...: completing the last word gives these, in any order.
offers() {
    local want=$1 got
    shift
    COMP_WORDS=("$@")
    COMP_CWORD=$(($# - 1))
    last="complete: $*"
    _srp
    got=$(printf '%s\n' ${COMPREPLY[@]+"${COMPREPLY[@]}"} | LC_ALL=C sort | tr '\n' ' ')
    [ "${got% }" = "$want" ] || fail "offers '${got% }', expected '$want'"
}

offers 'info' srp in
offers 'convert' srp conv
offers 'cache compare convert' srp c
offers 'clear list path' srp cache ''
offers 'clear' srp cache c
offers 'table' srp help t
offers '--distance-au' srp force --dis
offers '--step' srp table --st
offers '--mass --material --max-error --max-grid --method' srp table --m
offers '--help' srp convert --he
offers 'cannonball' srp force --method ca
offers 'cannonball' srp force --method = ca
offers 'exact' srp table --method e
offers 'cm' srp info --unit c
offers '' srp force --az ''
mkdir sub
touch a.obj b.obj c.nc d.plates
offers 'a.obj b.obj c.nc sub' srp info ''
offers 'a.obj' srp table a
offers 'c.nc' srp convert c
offers 'c.nc sub' srp reoptic ''
offers '--mass --material --mtl' srp reoptic --m
offers 'a.obj b.obj c.nc d.plates srp.bash sub' srp reoptic --mtl ''
offers 'd.plates' srp force --plates d
offers 'a.obj b.obj c.nc d.plates srp.bash sub' srp table -o ''
offers 'd.plates' srp force --plates = d
offers '' srp nocommand ''

# Every option of every command.
for command in info force table reoptic convert plot picture compare fit-nplate cache; do
    expect 0 "$command" --help
    grep -oE -- '^ {2,6}(-[a-z], )?--[a-z-]+' ../log/out | grep -oE -- '--[a-z-]+' > options
    while read -r option; do
        COMP_WORDS=(srp "$command" "$option")
        COMP_CWORD=2
        _srp
        printf '%s\n' ${COMPREPLY[@]+"${COMPREPLY[@]}"} | grep -qx -- "$option" ||
            fail "completion of $command lacks $option"
    done < options
done
finish
