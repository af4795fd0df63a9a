# SPDX-License-Identifier: Apache-2.0
# The Sun exactly on +Z and -Z body, and at azimuth 180: GMAT's own reader gives up, ours goes on.
. "$(dirname "$0")/lib.sh"
table=$(one_wing) || exit 77

# Body axes that follow the Sun: X of these axes is along the line from Earth to Sun, to a rounding.
mission() {
    spacecraft Sat
    cat << END
Create CoordinateSystem ToSun;
ToSun.Origin = Sat;
ToSun.Axes = ObjectReferenced;
ToSun.Primary = Sat;
ToSun.Secondary = Sun;
ToSun.$1
ToSun.YAxis = N;
Sat.Attitude = CoordinateSystemFixed;
Sat.AttitudeCoordinateSystem = ToSun;
END
    [ "$2" = plugin ] || spad Sat "$table"
    forces FM "$2" "SRPTableFile = '$table'" "SRPInterpolation = $3"
    propagator Prop FM 60
    report "$4" Sat
    echo 'BeginMissionSequence;'
    echo 'Propagate Prop(Sat) {Sat.ElapsedDays = 2};'
}

# Elsewhere GMAT's reader does its work with these axes.
mission 'XAxis = R;' spad - spad_control > spad_control.script
runs spad_control.script

for axis in 'ZAxis = R' 'ZAxis = -R' 'XAxis = -R'; do
    name=$(echo "$axis" | tr -d ' =' | tr - m)
    mission "$axis;" spad - "spad_$name" > "spad_$name.script"
    if gmat "spad_$name.script"; then
        echo "GMAT's own reader goes on at $axis"
    else
        echo "GMAT's own reader at $axis: $(grep -a 'xception' log | head -1)"
    fi
    for scheme in bicubic gmat_bilinear; do
        mission "$axis;" plugin $scheme "ours_${name}_$scheme" > "ours_${name}_$scheme.script"
        runs "ours_${name}_$scheme.script"
    done
done
finish
