# SPDX-License-Identifier: Apache-2.0
# srp propagate: missions of models/, files, differences, mistakes.
. "$ROOT/tests/cli/lib.sh"
MISSIONS=$MODELS/missions
export XDG_CACHE_HOME=$PWD/../home

if ! "$SRP" --help | grep -q propagate; then
    skip "srp was built without the propagator"
    finish
fi

# ---- every mission of models/ runs, cut short where it is long ----
for mission in "$MISSIONS"/*.yaml; do
    name=$(basename "$mission" .yaml)
    case $name in
    l2-*) days=2 ;;
    cruise) days=200 ;;
    *) days=2 ;;
    esac
    sed -e "s/^duration: .*/duration: $days d/" -e "s#file: \.\./#file: $MODELS/#" \
        -e "s#file: egm96#file: $MISSIONS/egm96#" "$mission" > "$name.yaml"
    expect 0 propagate "$name.yaml" --oem "$name.oem" --report "$name.csv" --events "$name-events.csv"
    prints "steps"
    prints "impulse"
    silent
    check "$name.oem is no OEM" grep -q "^CCSDS_OEM_VERS = 2.0" "$name.oem"
    check "$name.csv has no rows" [ "$(wc -l < "$name.csv")" -gt 2 ]
done
rm -f ./*

# ---- the halo orbit stays near L2: 1.5 million km, a few hundred thousand off ----
sed -e "s#file: \.\./#file: $MODELS/#" -e "s/^duration.*/duration: 30 d/" "$MISSIONS/l2-observatory.yaml" > l2.yaml
expect 0 propagate l2.yaml --report l2.csv
awk -F, 'NR > 1 { d = sqrt($3^2 + $4^2 + $5^2); if (d < 1.2e6 || d > 1.8e6) { exit 1 } }' l2.csv ||
    fail "the observatory has left L2"
rm -f ./*

# ---- a table on demand: the second run computes nothing, and gives the same orbit ----
rm -rf "$XDG_CACHE_HOME"
sed -e "s#file: \.\./#file: $MODELS/#; s#file: egm96#file: $MISSIONS/egm96#" \
    -e "s/^duration: .*/duration: 1 d/; s/step: 2 deg/step: 6 deg/" "$MISSIONS/gps-on-demand.yaml" > gps.yaml
expect 0 propagate gps.yaml --oem 1.oem --report 1.csv
silent
check "nothing was computed" grep -q "^nodes  *[1-9][0-9]* computed, 0 from the cache, 1742 in the grid" ../log/out
check "the cache is empty" test -n "$(ls "$XDG_CACHE_HOME/srpcore")"
expect 0 propagate gps.yaml --oem 2.oem --report 2.csv
check "the cache was not read" grep -q "^nodes  *0 computed, [1-9][0-9]* from the cache" ../log/out
check "the orbits differ" cmp <(grep -v CREATION 1.oem) <(grep -v CREATION 2.oem)
awk -F, 'NR > 1 { if ($NF < last) { exit 1 } last = $NF } END { exit last == 0 }' 1.csv ||
    fail "the column of nodes does not count"
awk -F, 'NR > 1 && $NF != 0 { exit 1 }' 2.csv || fail "the second run has computed nodes"
# Not where it is not wanted; where it cannot be used, with a warning.
sed "s/interpolation: bicubic/cache: no/" gps.yaml > forgetful.yaml
expect 0 propagate forgetful.yaml
check "the cache was read" grep -q "^nodes  *[1-9][0-9]* computed, 0 from" ../log/out
XDG_CACHE_HOME=/dev/null expect 0 propagate gps.yaml
says "warning"
check "nothing was computed" grep -q "^nodes  *[1-9][0-9]* computed, 0 from" ../log/out
# The other half of --versus takes what the first has just computed.
expect 0 propagate gps.yaml --versus forgetful.yaml -o same.csv
awk -F, 'NR > 1 && $5 != 0 { exit 1 }' same.csv || fail "a table from the cache gives another orbit"
# By OpenGL, where this srp has it and there is a driver.
sed "s/interpolation: bicubic/device: gl/; s/step: 6 deg/step: 30 deg/" gps.yaml > gl.yaml
if "$SRP" force --help | grep -q "gl:osmesa"; then
    "$SRP" force "$MODELS/cube.obj" --az 10 --el 10 --method raycast --device gl > /dev/null 2>&1 &&
        expect 0 propagate gl.yaml
else
    expect 1 propagate gl.yaml
    says "gl.yaml:$(grep -n "device: gl" gl.yaml | cut -d: -f1):"
fi
rm -f ./*

# ---- the same mission gives the same bytes; the date of creation can be fixed ----
sed "s/^duration: .*/duration: 1 d/" "$MISSIONS/geo-cannonball.yaml" > a.yaml
SOURCE_DATE_EPOCH=1700000000 expect 0 propagate a.yaml --oem 1.oem
SOURCE_DATE_EPOCH=1700000000 expect 0 propagate a.yaml --oem 2.oem
check "two runs differ" cmp 1.oem 2.oem
check "the date is not that of SOURCE_DATE_EPOCH" grep -q "CREATION_DATE = 2023-11-14T22:13:20" 1.oem

# ---- differences ----
expect 0 propagate a.yaml --versus a.yaml
prints "elapsed_s,radial_m,along_m,cross_m,distance_m"
awk -F, 'NR > 1 && $5 != 0 { exit 1 }' ../log/out || fail "a mission differs from itself"
sed "s/cr: 1.3/cr: 1.6/" a.yaml > b.yaml
expect 0 propagate a.yaml --versus b.yaml -o difference.csv
awk -F, 'NR == 26 && ($5 < 1 || $5 > 1000) { exit 1 } END { exit NR != 26 }' difference.csv ||
    fail "the difference after a day is not some metres"
sed "s/step: 1 h/step: 2 h/" a.yaml > c.yaml
expect 1 propagate a.yaml --versus c.yaml
says "c.yaml: its output.step differs from that of a.yaml"
sed "s/duration: 1 d/duration: 25 h/" a.yaml > c.yaml
expect 1 propagate a.yaml --versus c.yaml
says "c.yaml: its duration differs"
sed "s/^epoch: 2024/epoch: 2023/" a.yaml > c.yaml
expect 1 propagate a.yaml --versus c.yaml
says "c.yaml: its epoch differs"
holds 1.oem 2.oem a.yaml b.yaml c.yaml difference.csv

# ---- mistakes ----
expect 2 propagate
says "expected one file"
expect 2 propagate a.yaml b.yaml
expect 2 propagate a.yaml -o x.csv
says "--versus"
expect 2 propagate a.yaml --oem x --report x
says "twice"
expect 2 propagate a.yaml --oem x --report ./x
says "twice"
expect 2 propagate a.yaml --versus b.yaml --report x -o x
says "twice"
# Never over a file that is read.
cp a.yaml kept.yaml
expect 2 propagate a.yaml --report a.yaml
says "a.yaml is input and output at once"
expect 2 propagate a.yaml --versus b.yaml -o ./b.yaml
says "input and output"
sed -e "s#file: \.\./#file: $MODELS/#; s#file: egm96.*#file: field.gfc#" "$MISSIONS/leo.yaml" > leo.yaml
cp "$MISSIONS/egm96-4.gfc" field.gfc
expect 2 propagate leo.yaml --oem field.gfc
check "an input has gone" cmp field.gfc "$MISSIONS/egm96-4.gfc"
check "the mission has gone" cmp a.yaml kept.yaml
# Disks that are full, places that cannot be written: before the work, and with a reason.
for option in --oem --report --events; do
    expect 3 propagate a.yaml $option /dev/full
    says "/dev/full: cannot write: No space left on device"
    expect 3 propagate a.yaml $option no-such-directory/x
    says "no-such-directory/x: cannot write: No such file or directory"
done
expect 3 propagate a.yaml --versus b.yaml -o /dev/full
says "No space left"
expect 3 propagate a.yaml --versus b.yaml -o no-such-directory/x
says "No such file"
# The differences, too, appear whole or not at all.
if (ulimit -f 1 && exec "$SRP" propagate a.yaml > /dev/null 2>&1); then
    last="ulimit -f 1; srp propagate a.yaml --versus b.yaml -o old.csv"
    sed "s/step: 1 h/step: 10 min/" a.yaml > fine.yaml
    sed "s/step: 1 h/step: 10 min/" b.yaml > finer.yaml
    echo old > old.csv
    (
        ulimit -f 1
        exec "$SRP" propagate fine.yaml --versus finer.yaml -o old.csv > ../log/out 2> ../log/err
    )
    got=$?
    [ "$got" -eq 3 ] || fail "exit status $got, expected 3"
    says "old.csv: cannot write: File too large"
    check "an old file is lost" [ "$(cat old.csv)" = old ]
    check "half a file is left" [ ! -e old.csv.part ]
    rm -f fine.yaml finer.yaml old.csv
else
    skip 'srp does not run with a limit on the size of files'
fi
expect 3 propagate a.yaml --report .
says "is a directory"
sed "s#^output:#&\n  events: no-such-directory/x#" a.yaml > there.yaml
expect 3 propagate there.yaml
says "there.yaml: output.events: no-such-directory/x: cannot write: No such file"
rm there.yaml
# Other things than a mission.
: > empty.yaml
expect 1 propagate empty.yaml
says "empty.yaml:1:1: expected a mapping"
expect 1 propagate .
says ".: is a directory, expected a file"
head -c 100000 /dev/urandom > noise.yaml
expect 1 propagate noise.yaml
says "noise.yaml:"
for i in $(seq 60000); do echo "key$i: 1"; done > keys.yaml
expect 1 propagate keys.yaml
says "keys.yaml:1:1: 'key1' is no key"
{ printf 'title: '; printf '[%.0s' $(seq 20000); } > deep.yaml
expect 1 propagate deep.yaml
says "deep.yaml:1: more than 10000 brackets"
# Stopped in the middle: nothing is left behind.
sed "s/^duration: .*/duration: 3000 d/; s/^output:/integrator: {max_step: 1 min}\noutput:/" a.yaml > long.yaml
"$SRP" propagate long.yaml --report long.csv --oem long.oem > ../log/out 2> ../log/err &
for _ in $(seq 300); do # until it has begun to write
    [ -z "$(find . -name '*long.oem*')" ] || break
    sleep 0.1
done
kill -TERM $!
wait $! 2> /dev/null
check "it went on" [ $? -eq 143 ]
says "interrupted"
check "it left a file" [ -z "$(find . -name '*long.csv*' -o -name '*long.oem*')" ]
rm -f x leo.yaml field.gfc kept.yaml empty.yaml noise.yaml keys.yaml deep.yaml long.yaml
expect 1 propagate no-such.yaml
says "no-such.yaml"
expect 1 propagate a.yaml --versus no-such.yaml
sed "s/cr: 1.3/cr: lots/" a.yaml > bad.yaml
expect 1 propagate bad.yaml
says "bad.yaml:$(grep -n "cr: lots" bad.yaml | cut -d: -f1):"
says "forces.radiation.cr"
expect 3 propagate a.yaml --oem no-such-directory/x.oem
sed "s/semi_major_axis: .*/semi_major_axis: 6800 km/; s/eccentricity: .*/eccentricity: 0.07/" a.yaml > falls.yaml
sed -i "s/true_anomaly: .*/true_anomaly: 180 deg/" falls.yaml
expect 1 propagate falls.yaml --oem falls.oem
says "falls.yaml: at t = "
says "surface"
check "an orbit that failed has left a file" [ ! -e falls.oem ]
expect 2 propagate a.yaml --what
expect 0 propagate --help
prints "MISSION.yaml"

# ---- what is not there is wrong input; advice is for missions ----
{ cat a.yaml; echo 'central_body: moon'; } | sed 's#^forces:#&\n  gravity: {file: x.gfc, degree: 2}#; /^central_body: earth/d' > moon.yaml
expect 1 propagate moon.yaml
says "forces.gravity"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl foil\nf 1 2 3\n' > bare.obj
sed -e "s#model: cannonball#model: direct\n    file: bare.obj#; /cr:/d; /area:/d; s#mass: .*#&\n  attitude: {mode: sun}#" a.yaml > bare.yaml
expect 1 propagate bare.yaml
says "bare.yaml:$(grep -n "file: bare.obj" bare.yaml | cut -d: -f1):"
says "under 'materials' of the mission"
says_not "--material"
sed -i "s#file: bare.obj#&\n    materials: [{name: foil, rho_s: 0.3, rho_d: 0.2}]#" bare.yaml
expect 0 propagate bare.yaml

# ---- the date beyond the leap seconds is warned of ----
sed "s/^epoch: .*/epoch: 2080-03-20T00:00:00 UTC/" a.yaml > late.yaml
expect 0 propagate late.yaml
says "warning: epoch"

finish
