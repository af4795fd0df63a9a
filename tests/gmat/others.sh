# SPDX-License-Identifier: Apache-2.0
# Beside GMAT's SPADFile where the other tests do not go: an integrator of second order (RungeKutta68
# is Nystrom's), the Sun as central body, and the acceleration that GMAT reports of a force model.
. "$(dirname "$0")/lib.sh"
table=$(one_wing) || exit 77

for kind in spad plugin; do
    {
        spacecraft Sat
        attitude Sat nadir
        [ $kind = plugin ] || spad Sat "$table"
        forces FM $kind "SRPTableFile = '$table'" "SRPInterpolation = gmat_bilinear"
        propagator Prop FM 60 | sed 's/PrinceDormand78/RungeKutta68/'
        report nystrom_$kind Sat
        echo 'BeginMissionSequence;'
        echo 'Propagate Prop(Sat) {Sat.ElapsedDays = 2};'
    } > nystrom_$kind.script
    runs nystrom_$kind.script

    {
        echo 'Create CoordinateSystem SunEq;'
        echo 'SunEq.Origin = Sun;'
        echo 'SunEq.Axes = MJ2000Eq;'
        spacecraft Sat | sed -e 's/EarthMJ2000Eq/SunEq/' -e 's/36607.35826/1.1e8/' \
            -e 's/-20921.7237/-9.3e7/' -e 's/\.Z = 0/.Z = -4.1e7/' -e 's/1.5256345/18.3/' \
            -e 's/2.6694515/20.9/' -e 's/0.0123456/8.7/'
        attitude Sat spinner
        [ $kind = plugin ] || spad Sat "$table"
        forces FM $kind "SRPTableFile = '$table'" "SRPInterpolation = gmat_bilinear" |
            sed 's/CentralBody = Earth/CentralBody = Sun/'
        propagator Prop FM 3600
        report cruise_$kind Sat | sed 's/EarthMJ2000Eq/SunEq/g'
        echo 'BeginMissionSequence;'
        echo 'Propagate Prop(Sat) {Sat.ElapsedDays = 60};'
    } > cruise_$kind.script
    runs cruise_$kind.script
done
apart 5 nystrom_spad nystrom_plugin
apart 5 cruise_spad cruise_plugin

if ! grep -q libNewParameters startup.txt; then
    echo "skipped: this GMAT has no libNewParameters, which reports accelerations"
    finish
fi
{
    spacecraft Sat
    attitude Sat nadir
    spad Sat "$table"
    forces Theirs spad
    forces Ours plugin "SRPTableFile = '$table'" "SRPInterpolation = gmat_bilinear"
    propagator Prop Ours 60
    cat << END
Create ReportFile Push;
Push.Filename = '$scratch/push.txt';
Push.Precision = 16;
Push.WriteHeaders = false;
Push.Add = {Sat.Ours.AccelerationX, Sat.Theirs.AccelerationX, Sat.Ours.AccelerationY, Sat.Theirs.AccelerationY, Sat.Ours.AccelerationZ, Sat.Theirs.AccelerationZ};
BeginMissionSequence;
Propagate Prop(Sat) {Sat.ElapsedDays = 1};
END
} > push.script
runs push.script
awk '{ for (i = 1; i < 6; i += 2) { d = $i - $(i + 1); if (d < 0) d = -d; if (d > worst) worst = d } }
    END { printf "reported accelerations: %d rows, %.2g km/s^2 apart\n", NR, worst; exit !(NR > 100 && worst < 1e-17) }' push.txt ||
    fail "expected 1e-17 km/s^2"
finish
