# SPDX-License-Identifier: Apache-2.0
# The plugin with GMAT's own interpolation beside GMAT's SPADFile: the same trajectory within 5 mm
# over 2 days in GEO, eclipses included, for an inertial, a nadir pointing and a spinning spacecraft.
. "$(dirname "$0")/lib.sh"
table=$(one_wing) || exit 77

# pair ATTITUDE Bilinear|Bicubic
pair() {
    local kind name
    for kind in spad plugin; do
        name=$1_$2_$kind
        {
            spacecraft Sat
            attitude Sat "$1"
            [ $kind = plugin ] || spad Sat "$table" | sed "s/Bilinear/$2/"
            forces FM $kind "SRPTableFile = '$table'" "SRPInterpolation = gmat_${2,,}"
            propagator Prop FM
            report "$name" Sat
            echo 'BeginMissionSequence;'
            echo 'Propagate Prop(Sat) {Sat.ElapsedDays = 2};'
        } > "$name.script"
        runs "$name.script"
    done
    apart 5 "$1_$2_spad" "$1_$2_plugin"
}
pair inertial Bilinear
pair nadir Bilinear
pair spinner Bilinear
# A cubic look-up of GMAT's cannot go near the south pole of the table.
pair inertial Bicubic
finish
