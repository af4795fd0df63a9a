# SPDX-License-Identifier: Apache-2.0
# The plugin with GMAT's own interpolation beside GMAT's SPADFile: the same trajectory within 5 mm
# over 2 days in GEO, eclipses included, for an inertial, a nadir pointing and a spinning spacecraft.
. "$(dirname "$0")/lib.sh"
table=$(one_wing) || exit 77

for mode in inertial nadir spinner; do
    for kind in spad plugin; do
        name=${mode}_$kind
        {
            spacecraft Sat
            attitude Sat $mode
            [ $kind = plugin ] || spad Sat "$table"
            forces FM $kind "SRPTableFile = '$table'" "SRPInterpolation = gmat_bilinear"
            propagator Prop FM
            report $name Sat
            echo 'BeginMissionSequence;'
            echo 'Propagate Prop(Sat) {Sat.ElapsedDays = 2};'
        } > $name.script
        runs $name.script
    done
    apart 5 ${mode}_spad ${mode}_plugin
done
finish
