# SPDX-License-Identifier: Apache-2.0
# Every script of gmat_scripts/ beside its twin. The plugin interpolates better than the twin, so that
# they are not the same: the limits say how far bilinear look-up takes these missions.
. "$(dirname "$0")/lib.sh"
[ -x "$SRP" ] || { echo "skipped: srp is not built"; exit 77; }

# Tables are made once and kept with the build.
SRP=$SRP bash "$ROOT/gmat_scripts/tables.sh" "$TABLES" > /dev/null || fail "tables.sh"
mkdir gmat_scripts
ln -s "$ROOT/models" models
cp "$ROOT"/gmat_scripts/*.script gmat_scripts/
for table in "$TABLES"/*.nc "$TABLES"/*.spo; do
    ln -s "$table" gmat_scripts/
done

# pair NAME LIMIT_MM
pair() {
    runs "gmat_scripts/$1.script"
    runs "gmat_scripts/$1_spad.script"
    apart "$2" "$1" "$1_spad"
}
pair geo_box_wing 1000
pair geo_on_demand 1000
pair geo_burn 1000
pair lunar_orbiter 100
pair l2_sun_shield 1000000
[ "$(find gmat_scripts -name '*.script' | wc -l)" -eq 10 ] || fail "a script is not run here"
finish
