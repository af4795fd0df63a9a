#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Missions: what is shown and saved is of those that are chosen, and only missions can be chosen.
. "$(dirname "$0")/lib.sh"
"$SRP" propagate --help > /dev/null 2>&1 || { echo 'skipped: srp was built without the propagator'; exit 77; }
start_display

# mission SED FILE: an orbit of three hours, changed.
mission() {
    sed -e 's/^duration:.*/duration: 3 h/' -e 's/step: 1 h/step: 20 min/' -e "s|file: ../|file: $ROOT/models/|" \
        -e "$1" "$ROOT/models/missions/geo-box-wing.yaml" > "$scratch/$2"
}
mission '' box-wing.yaml
sed -e 's/^duration:.*/duration: 3 h/' -e 's/step: 1 h/step: 20 min/' "$ROOT/models/missions/geo-cannonball.yaml" > "$scratch/ball.yaml"
mission 's/^duration:.*/duration: 9000 d/; s/step: .*/step: 1 d/' long.yaml
mission 's/semi_major_axis: .*/semi_major_axis: 6800 km/; s/eccentricity: .*/eccentricity: 0.07/
    s/true_anomaly: .*/true_anomaly: 180 deg/' falls.yaml
printf 'title: none\nepoch: [\n' > "$scratch/broken.yaml"

# What came of a run goes with its missions; those that are no missions are not chosen.
cat > "$scratch/steps" << END
resize 1280 800
tab orbit
save $scratch/early.csv
expect message There is no mission yet
mission $scratch/box-wing.yaml
wait
expect choose-mission box-wing.yaml
expect orbit-facts box-wing.yaml (exact): no result yet
save $scratch/early.csv
expect message The mission has no result yet
propagate
wait
expect orbit-end at the end, from the central body, axes MJ2000Eq: x 
expect orbit-facts box-wing.yaml (exact): 
expect orbit-facts penumbras
mission $scratch
wait
expect message $scratch: is a directory
mission $scratch/no-such.yaml
wait
expect message no-such.yaml
versus $scratch/broken.yaml
wait
expect message broken.yaml:
expect choose-mission box-wing.yaml
expect choose-versus Compare
expect orbit-end at the end
save $scratch/alone.csv
expect message Saved
versus $scratch/ball.yaml
wait
print orbit-end
print message
expect orbit-facts box-wing.yaml (exact) → ball.yaml (cannonball): no result yet
screenshot $SHOTS/orbit-chosen.png
save $scratch/early.csv
expect message The mission has no result yet
propagate
wait
expect orbit-facts box-wing.yaml (exact) → ball.yaml (cannonball): the first has 
expect orbit-end at the end: radial
screenshot $SHOTS/orbit-both.png
save $scratch/both.csv
versus 
print orbit-end
print message
expect orbit-facts box-wing.yaml (exact): no result yet
mission $scratch/ball.yaml
propagate
wait
expect orbit-facts ball.yaml (cannonball): 
expect orbit-end at the end
mission $scratch/falls.yaml
propagate
wait
expect message surface
print orbit-end
save $scratch/early.csv
expect message The mission has no result yet
END
view 0 --actions "$scratch/steps"
[ -z "$(values orbit-end | tr -d '\n')" ] || fail "the end of missions that were not run: $(values orbit-end)"
[ -z "$(values message | tr -d '\n')" ] || fail "a message of missions that were: $(values message)"
[ ! -e "$scratch/early.csv" ] || fail 'rows of missions that were not run'
head -1 "$scratch/alone.csv" | grep -q x_m || fail 'no rows of one mission'
"$SRP" propagate "$scratch/box-wing.yaml" --versus "$scratch/ball.yaml" -o "$scratch/cli.csv" || fail 'srp propagate'
cmp "$scratch/cli.csv" "$scratch/both.csv" || fail 'other rows than srp propagate'

# A file that has changed since it was chosen, so that its next run fails; a choice while a mission runs.
cp "$scratch/box-wing.yaml" "$scratch/changes.yaml"
cat > "$scratch/steps" << END
tab orbit
mission $scratch/changes.yaml
propagate
wait
expect orbit-end at the end
save $scratch/first.csv
pause 2
propagate
wait
expect message surface
print orbit-end
save $scratch/early.csv
expect message The mission has no result yet
mission $scratch/long.yaml
wait
propagate
pause 1
expect message 
mission $scratch/broken.yaml
pause 1
expect message broken.yaml
mission $scratch/ball.yaml
wait
expect message cancelled
expect orbit-facts ball.yaml (cannonball): no result yet
print orbit-end
END
(
    until [ -s "$scratch/first.csv" ]; do sleep 0.1; done
    mv "$scratch/falls.yaml" "$scratch/changes.yaml"
) &
changes=$!
view 0 --actions "$scratch/steps"
kill "$changes" 2> /dev/null
[ -z "$(values orbit-end | tr -d '\n')" ] || fail "the end of runs that failed: $(values orbit-end)"

# A run that another one replaces is not spoken of.
printf '%s\n' 'tab orbit' "mission $scratch/long.yaml" wait propagate 'pause 0.5' propagate 'pause 1.5' 'print message' \
    cancel wait 'expect message The mission was cancelled.' > "$scratch/steps"
view 0 --actions "$scratch/steps"
[ -z "$(value message)" ] || fail "while a mission runs: $(value message)"

# Orbits that are alike are said to be. Rows go where a link leads, and to a full disk they do not.
ln -s target.csv "$scratch/link.csv"
ln -s /dev/full "$scratch/full.csv"
cat > "$scratch/steps" << END
resize 1280 800
tab orbit
mission $scratch/box-wing.yaml
versus $scratch/box-wing.yaml
propagate
wait
expect orbit-facts the orbits are identical
screenshot $SHOTS/orbit-identical.png
save $scratch/link.csv
expect message Saved
save $scratch/full.csv
expect message full.csv: cannot write: No space left
save $scratch/no-such/x.csv
expect message no-such/x.csv: cannot write: No such file
END
view 0 --actions "$scratch/steps"
{ [ -L "$scratch/link.csv" ] && [ -s "$scratch/target.csv" ]; } || fail 'the link is replaced'
[ -L "$scratch/full.csv" ] || fail 'the link to /dev/full is replaced'
"$CHECK" "$SHOTS/orbit-identical.png" 1280 800 540 498 260 18 20 0.99 || fail 'the picture does not say that they are identical'
judge
