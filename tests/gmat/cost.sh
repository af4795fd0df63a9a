# SPDX-License-Identifier: Apache-2.0
# What the plugin costs: GMAT's own run times of 30 days in GEO with its Spherical model, with its
# SPADFile and with the plugin, in turns; medians of them and of the ratios of each turn. Not a test,
# for time is not what ctest can judge:
#
#   GMAT_ROOT=... PLUGIN=... SRP=... ROOT=... bash tests/gmat/cost.sh [ROUNDS]
. "$(dirname "$0")/lib.sh"
table=$(one_wing) || exit 77
"$SRP" convert "$table" one-wing.nc > /dev/null 2>&1 || fail "srp convert"
rounds=${1-5}

# mission KIND ATTITUDE GRAVITY
mission() {
    spacecraft Sat
    attitude Sat "$2"
    [ "$1" != round ] || printf 'Sat.SRPArea = 20;\n'
    [ "$1" != spad ] || spad Sat "$table"
    forces FM "$1" "SRPTableFile = '$scratch/one-wing.nc'"
    if [ "$3" -gt 0 ]; then
        printf 'FM.PointMasses = {Sun, Luna};\nFM.PrimaryBodies = {Earth};\n'
        printf "FM.GravityField.Earth.Degree = %s;\nFM.GravityField.Earth.Order = %s;\n" "$3" "$3"
        printf "FM.GravityField.Earth.PotentialFile = 'JGM2.cof';\n"
    fi
    propagator Prop FM 120
    echo 'BeginMissionSequence;'
    echo 'Propagate Prop(Sat) {Sat.ElapsedDays = 30};'
}
median() { sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
# over KIND: the plugin's time over that of KIND in the same turn.
over() { paste plugin.times "$1.times" | awk '{ printf "%.3f\n", $1 / $2 }' | median; }

for gravity in 0 8 20; do
    for mode in inertial spinner nadir; do
        for kind in round spad plugin; do
            mission $kind $mode $gravity > $kind.script
            : > $kind.times
        done
        for ((i = 0; i < rounds; ++i)); do
            for kind in round spad plugin; do
                runs $kind.script
                sed -n 's/.*Total Run Time: \([0-9.]*\) seconds.*/\1/p' log >> $kind.times
            done
        done
        echo "$mode, gravity $gravity x $gravity | Spherical $(median < round.times) s," \
            "SPADFile $(median < spad.times) s, plugin $(median < plugin.times) s |" \
            "plugin over Spherical $(over round), over SPADFile $(over spad)"
    done
done
finish
