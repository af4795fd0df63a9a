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

# compared A B FILE: all numbers of srp compare are those that were printed into FILE.
compared() {
    "$SRP" compare "$1" "$2" > "$scratch/cli" || fail "srp compare $1 $2"
    awk '
        BEGIN { split("mse rms mean largest az el", name) }
        /^\/ A/ { exit }
        $1 ~ /^(x|y|z|length|vector)$/ { for (k = 1; k <= 6; ++k) print $1 "-" name[k] ": " $(k + 1) }
        /^mean size/ { sub(",", "", $5); print "means: " $4, $7 }
    ' "$scratch/cli" | sort > "$scratch/want"
    [ "$(wc -l < "$scratch/want")" -eq 31 ] || fail "srp compare prints $(wc -l < "$scratch/want") of 31 numbers"
    sed -E 's/: +/: /; s/^comparison-facts.*of A ([^ ]+) m², of B ([^ ]+) m²/means: \1 \2/' "$3" | sort > "$scratch/got"
    diff "$scratch/want" "$scratch/got" || fail "numbers differ: srp compare $1 $2"
}

# Two tables of different steps, with a mass that was typed after the spacecraft was there; the fit of one, whose
# differences are the residuals; the first under other optics.
numbers_of() {
    local row column
    echo "note begin $1"
    for row in x y z length vector; do
        for column in mse rms mean largest az el; do
            echo "print $row-$column"
        done
    done
    echo 'print comparison-facts'
    echo "note end $1"
}
{
    cat << END
wait
az-step 15
el-step 15
tab graphics
wait
enter mass 731.25
compute-table
wait
save $scratch/fine.nc
save $scratch/fine.txt
az-step 30
el-step 30
method raycast
parameter grid=64
wait
compute-table
wait
save $scratch/coarse.nc
tab compare
compare-a 1
compare-b 2
wait
END
    numbers_of pair
    printf '%s\n' 'fit 5' wait 'expect compare-b 5 plates fitted'
    numbers_of fit
    cat << END
save $scratch/five.plates
fit 1
wait
expect compare-b 1 plate fitted
tab graphics
show-table 1
method exact
material cells=0.3125,0.171875
wait
expect table of other optics
reoptic
wait
expect message nothing traced
print table
save $scratch/reoptic.nc
reoptic
expect message not of other optics
show-table 1
expect table of other optics
method raytrace
material
wait
compute-table
wait
material cells=0.3125,0.171875
wait
reoptic
wait
expect message reflected before
END
} > "$scratch/steps"
view 0 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"
between() {
    sed -n "/^begin $1$/,/^end $1$/p" "$scratch/out" | sed '1d;$d'
}
between pair > "$scratch/pair"
between fit > "$scratch/fit"
case $(value table) in
*'of other optics'*) fail "the new table is of other optics: $(value table)" ;;
*', exact, 15° × 15°, re-optic of 1') ;;
*) fail "the new table is '$(value table)'" ;;
esac
model=$ROOT/models/box-wing.obj
"$SRP" table "$model" --step 15 --mass 731.25 -o "$scratch/cli.nc" -o "$scratch/cli.txt" > "$scratch/log" 2>&1 || fail 'srp table'
cmp "$scratch/cli.txt" "$scratch/fine.txt" || fail 'another .txt than srp table'
"$SRP" compare "$scratch/cli.nc" "$scratch/fine.nc" --fail-above 0 > "$scratch/log" 2>&1 || fail 'another .nc than srp table'
compared "$scratch/fine.nc" "$scratch/coarse.nc" "$scratch/pair"
"$SRP" table "$model" --step 15 --material cells=0.3125,0.171875 -o "$scratch/other.nc" > "$scratch/log" 2>&1 || fail 'srp table'
"$SRP" compare "$scratch/other.nc" "$scratch/reoptic.nc" --fail-above 1e-12 > "$scratch/log" 2>&1 || fail 'another table under other optics'
if "$SRP" fit-nplate "$scratch/fine.nc" --plates 5 -o "$scratch/cli.plates" > "$scratch/log" 2>&1; then
    cmp -s <(grep -v '^#' "$scratch/cli.plates") <(grep -v '^#' "$scratch/five.plates") || fail 'other plates than srp fit-nplate'
    "$SRP" table --method nplate --plates "$scratch/five.plates" --step 15 -o "$scratch/five.nc" > "$scratch/cli" 2>&1 || fail 'srp table of plates'
    compared "$scratch/fine.nc" "$scratch/five.nc" "$scratch/fit"
fi

# Tables of two spacecraft are compared with a word about it; two methods of one, and plates, without.
cat > "$scratch/steps" << END
az-step 30
el-step 30
wait
compute-table
wait
method raycast
wait
compute-table
wait
tab compare
wait
print comparison-facts
open $ROOT/models/gnss.obj
wait
compute-table
wait
compare-b 3
wait
expect comparison-facts A and B are of different shapes: cube.obj and gnss.obj.
fit 2
wait
print comparison-facts
END
view 0 --actions "$scratch/steps" "$ROOT/models/cube.obj"
[ "$(values comparison-facts | grep -c directions)" -eq 2 ] || fail 'tables were not compared'
! values comparison-facts | grep -q different || fail "one spacecraft is called two: $(values comparison-facts)"

# Tables of a quarter of a million directions are compared when somebody looks, beside the window.
"$SRP" table --method cannonball --cr 1.25 --area 2.5 --step 0.5 -o "$scratch/half.nc" > "$scratch/log" 2>&1 || fail 'srp table'
"$SRP" table --method nplate --plates "$ROOT/models/box-wing.plates" --step 1 -o "$scratch/one.nc" > "$scratch/log" 2>&1 || fail 'srp table'
{
    cat << END
wait
open-table $scratch/half.nc
open-table $scratch/one.nc
wait
expect vector-rms —
tab compare
expect comparison-facts Comparing …
expect vector-rms —
save $scratch/early.png
expect message still being compared
wait
END
    numbers_of big
} > "$scratch/steps"
view 0 --actions "$scratch/steps"
between big > "$scratch/big"
compared "$scratch/half.nc" "$scratch/one.nc" "$scratch/big"

# Missions that ask for OpenGL and for the cache run as in srp propagate, to all digits.
mission() {
    sed -e 's/^duration:.*/duration: 3 h/' -e 's/step: 1 h/step: 20 min/' -e "s|file: ../|file: $ROOT/models/|" \
        -e "s/model: direct/$1/" "$ROOT/models/missions/geo-box-wing.yaml" > "$2"
}
mission 'model: on_demand\n    method: raycast\n    device: gl\n    grid: 64\n    step: 15 deg' "$scratch/gl.yaml"
mission 'model: direct' "$scratch/direct.yaml"
if "$SRP" propagate "$scratch/direct.yaml" --versus "$scratch/gl.yaml" -o "$scratch/cli.csv" > "$scratch/log" 2>&1; then
    rm -rf "$XDG_CACHE_HOME/srpcore"
    cat > "$scratch/steps" << END
mission $scratch/direct.yaml
versus $scratch/gl.yaml
propagate
wait
expect message The mission ran
print orbit-end
tab orbit
save $scratch/viewer.csv
END
    view 0 --actions "$scratch/steps"
    cmp "$scratch/cli.csv" "$scratch/viewer.csv" || fail 'other rows than srp propagate'
    want=$(tail -1 "$scratch/cli.csv" | awk -F, '{ print "at the end: radial " $2 ", along-track " $3 ", cross-track " $4 ", distance " $5 " m" }')
    [ "$(value orbit-end)" = "$want" ] || fail "'$(value orbit-end)', srp propagate has '$want'"
    [ -n "$(ls "$XDG_CACHE_HOME/srpcore")" ] || fail 'the mission left nothing in the cache'
else
    cat "$scratch/log"
    grep -q OpenGL "$scratch/log" || fail 'srp propagate'
fi
judge
