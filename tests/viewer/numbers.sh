#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Numbers in the window are those of the command line, to all printed digits.
. "$(dirname "$0")/lib.sh"
start_display

# same MODEL AZ EL OPTIONS...: a direction, by the options of srp force.
same() {
    local model=$1 az=$2 el=$3 option
    shift 3
    {
        echo wait
        echo "sun $az,$el"
        echo "enter mass 731.25"
        for option in "$@"; do
            case $option in
            method=*) echo "method ${option#*=}" ;;
            material=*) echo "material ${option#*=}" ;;
            *) echo "parameter $option" ;;
            esac
        done
        echo wait
        echo wait
        for name in f-x f-y f-z f-n t-x t-y t-z f-error t-error lit-area force-x force-y force-z \
            torque-x torque-y torque-z acceleration-x acceleration-y acceleration-z; do
            echo "print $name"
        done
        echo print sun
    } > "$scratch/steps"
    view 0 --actions "$scratch/steps" "$ROOT/models/$model"
    local sun
    sun=$(value sun)
    "$SRP" force "$ROOT/models/$model" --az="${sun%,*}" --el="${sun#*,}" --mass 731.25 "${@/#/--}" > "$scratch/cli" ||
        fail "srp force $model $*"
    awk '
        /^area vector f/ { print "f-x: " $4; print "f-y: " $5; print "f-z: " $6 }
        /^  \|f\|/ { print "f-n: " $2 }
        /^  standard error/ { print (seen++ ? "t" : "f") "-error: " $3 }
        /^moment vector t/ { print "t-x: " $4; print "t-y: " $5; print "t-z: " $6 }
        /^lit area/ { print "lit-area: " $3 }
        /^force F/ { print "force-x: " $3; print "force-y: " $4; print "force-z: " $5 }
        /^torque T/ { print "torque-x: " $3; print "torque-y: " $4; print "torque-z: " $5 }
        /^acceleration a/ { print "acceleration-x: " $3; print "acceleration-y: " $4; print "acceleration-z: " $5 }
    ' "$scratch/cli" | sort > "$scratch/want"
    grep -v '^sun:' "$scratch/out" | sed 's/: */: /' | sort > "$scratch/got"
    [ "$(wc -l < "$scratch/want")" -eq 19 ] || fail "srp force prints $(wc -l < "$scratch/want") of 19 numbers"
    if ! diff "$scratch/want" "$scratch/got"; then
        fail "numbers differ: $model $az $el $*"
    fi
}

same box-wing.obj 37.25 -21.5
same box-wing.obj -171.5 88.25 reference=0.25,-1.5,0.125
same box-wing.obj 90 0 material=cells=0.31,0.17
same box-wing.obj 12.625 33 method=raycast grid=97 seed=5
same box-wing.obj -80 5 method=raytrace reflections=3 diffuse=2 grid=64
same sun-shield.obj 145 -50.5

# The command that is copied gives the same, and is shown.
printf 'wait\nsun 33.5,-12.25\nwait\ncopy-command\nprint message\nprint f-z\n' > "$scratch/steps"
view 0 --actions "$scratch/steps" "$ROOT/models/dish.obj"
line=$(value message)
[ "${line#srp force }" != "$line" ] || fail "the command is '$line'"
eval "$SRP ${line#srp }" > "$scratch/cli" || fail "the command does not run: $line"
want=$(awk '/^area vector f/ { print $6 }' "$scratch/cli")
[ "$(value f-z)" = "$want" ] || fail "f_z $(value f-z), the command gives $want"
judge
