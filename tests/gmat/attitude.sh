# SPDX-License-Identifier: Apache-2.0
# Attitudes that the plugin asks for once a step, and those that it must not: beside GMAT's SPADFile,
# which asks at each stage, on the same table.
. "$(dirname "$0")/lib.sh"
table=$(one_wing) || exit 77

still() { attitude Sat spinner | sed '/AngularVelocity[XYZ]/d; s/= 0.92736;/= 0.927361849549570;/'; }
in_axes() {
    cat << END
Create CoordinateSystem Axes;
Axes.Origin = Earth;
Axes.Axes = $1;
END
    [ "$1" != ObjectReferenced ] ||
        printf 'Axes.XAxis = V;\nAxes.YAxis = N;\nAxes.Primary = Earth;\nAxes.Secondary = Sat;\n'
    printf 'Sat.Attitude = CoordinateSystemFixed;\nSat.AttitudeCoordinateSystem = Axes;\n'
}
# same NAME ATTITUDE [LINE]: 6 hours four times over, LINE after each of them.
same() {
    local name=$1 how=$2 line=${3-} kind
    for kind in spad plugin; do
        {
            spacecraft Sat
            $how
            [ "$kind" = plugin ] || spad Sat "$table"
            forces FM "$kind" "SRPTableFile = '$table'" 'SRPInterpolation = gmat_bilinear'
            propagator Prop FM 60
            report "${name}_$kind" Sat
            printf 'Create Variable I;\nBeginMissionSequence;\nFor I = 1:1:4;\n'
            printf '  Propagate Prop(Sat) {Sat.ElapsedSecs = 21600};\n  %b\nEndFor;\n' "$line"
        } > "${name}_$kind.script"
        runs "${name}_$kind.script"
    done
    apart 0 "${name}_spad" "${name}_plugin"
}
same fixed 'in_axes MJ2000Eq'
same ecliptic 'in_axes MJ2000Ec'
same body_fixed 'in_axes BodyFixed'
same velocity 'in_axes ObjectReferenced'
same still still
same spun still 'If I == 2\n  Sat.AngularVelocityZ = 0.15;\n  EndIf;'
same turned still 'Sat.Quaternion = [0.5 0.5 0.5 0.5];'
# What is changed is seen: these are other orbits than that at rest.
for name in spun turned; do
    cmp -s still_plugin.txt ${name}_plugin.txt && fail "$name: nothing has changed"
done
finish
