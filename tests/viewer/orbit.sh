#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Missions: what is shown and saved of them.
. "$(dirname "$0")/lib.sh"
"$SRP" propagate --help > /dev/null 2>&1 || { echo 'skipped: srp was built without the propagator'; exit 77; }
start_display

# mission SED FILE: an orbit of three hours, changed.
mission() {
    sed -e 's/^duration:.*/duration: 3 h/' -e 's/step: 1 h/step: 20 min/' -e "s|file: ../|file: $ROOT/models/|" \
        -e "$1" "$ROOT/models/missions/geo-box-wing.yaml" > "$scratch/$2"
}
mission '' box-wing.yaml

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
[ -L "$scratch/link.csv" ] && [ -s "$scratch/target.csv" ] || fail 'the link is replaced'
[ -L "$scratch/full.csv" ] || fail 'the link to /dev/full is replaced'
"$CHECK" "$SHOTS/orbit-identical.png" 1280 800 540 528 260 18 20 0.99 || fail 'the picture does not say that they are identical'
judge
