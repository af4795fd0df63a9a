# SPDX-License-Identifier: Apache-2.0
# What the plugin costs: GMAT's own run times of 30 days in GEO with its Spherical model, with its
# SPADFile and with the plugin, in turns; medians and ratios. Not a test, for time is not what ctest
# can judge:
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

for gravity in 0 8 20; do
    for mode in nadir inertial; do
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
        echo "$mode, gravity $gravity x $gravity:" \
            "$(median < round.times) $(median < spad.times) $(median < plugin.times)" |
            awk '{ n = NF; printf "%s | Spherical %.2f s, SPADFile %.2f s, plugin %.2f s | plugin over Spherical %.2f, over SPADFile %.2f\n",
                $1 " " $2 " " $3 " " $4 " " $5, $(n - 2), $(n - 1), $n, $n / $(n - 2), $n / $(n - 1) }'
    done
done
finish
