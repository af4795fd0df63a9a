# SPDX-License-Identifier: Apache-2.0
# The script that `srp fit-nplate --gmat` writes runs in GMAT as it is.
. "$(dirname "$0")/lib.sh"
[ -x "$SRP" ] || { echo "skipped: srp is not built"; exit 77; }

"$SRP" table "$ROOT/models/box-wing.obj" -o box-wing.nc --step 5 > /dev/null || fail "srp table"
"$SRP" fit-nplate box-wing.nc --mesh "$ROOT/models/box-wing.obj" --mass 850 -o box-wing.plates \
    --gmat nplate.script > /dev/null 2>&1 || { echo "skipped: srp is built without GSL"; exit 77; }
gmat nplate.script
status=$?
if grep -q 'not an allowed value\|"Spherical" or "SPADFile"' log; then
    echo "skipped: this release has NPlate for testing only"
    exit 77
fi
[ $status -eq 0 ] || fail "ends with status $status"
finish
