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
says "c.yaml: its epoch, duration, output step"
holds 1.oem 2.oem a.yaml b.yaml c.yaml difference.csv

# ---- mistakes ----
expect 2 propagate
says "expected one file"
expect 2 propagate a.yaml b.yaml
expect 2 propagate a.yaml -o x.csv
says "--versus"
expect 2 propagate a.yaml --oem x --report x
says "twice"
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
says "surface"
check "an orbit that failed has left a file" [ ! -e falls.oem ]
expect 2 propagate a.yaml --what
expect 0 propagate --help
prints "MISSION.yaml"

# ---- the date beyond the leap seconds is warned of ----
sed "s/^epoch: .*/epoch: 2080-03-20T00:00:00 UTC/" a.yaml > late.yaml
expect 0 propagate late.yaml
says "warning: epoch"

finish
