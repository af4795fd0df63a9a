# SPDX-License-Identifier: Apache-2.0
# The plugin in GMAT beside `srp propagate` on the same mission: within 10 mm over 2 days.
. "$(dirname "$0")/lib.sh"
table=$(one_wing) || exit 77
[ -x "$SRP" ] || { echo "skipped: srp is not built"; exit 77; }

for scheme in spline gmat_bilinear; do
    name=gmat_$scheme
    {
        spacecraft Sat
        attitude Sat nadir
        forces FM plugin "SRPTableFile = '$table'" "SRPInterpolation = $scheme"
        propagator Prop FM 10
        report $name Sat
        echo 'BeginMissionSequence;'
        echo 'Propagate Prop(Sat) {Sat.ElapsedDays = 2};'
    } > $name.script
    runs $name.script
    sed -e "s#file: .*#file: $table#" -e "s#interpolation: .*#interpolation: $scheme#" \
        -e 's#step: 1800 s#step: 10 s#' -e 's#columns: .*#columns: [elapsed, position, velocity]#' \
        "$ROOT/tests/orbit/gmat/geo_spad_nadir_eclipse.yaml" > mission.yaml
    "$SRP" propagate mission.yaml --report srp.csv > /dev/null || fail "srp propagate"
    # With a column for the mass.
    grep -v '^[^-0-9]' srp.csv | tr ',' ' ' | awk '{ print $0, 850 }' > srp_$scheme.txt
    apart 10 $name srp_$scheme
done
finish
