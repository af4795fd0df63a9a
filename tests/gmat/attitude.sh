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
precessing() {
    cat << END
Sat.Attitude = PrecessingSpinner;
Sat.NutationReferenceVectorX = 0;
Sat.NutationReferenceVectorY = 0.1;
Sat.NutationReferenceVectorZ = 1;
Sat.BodySpinAxisX = 0;
Sat.BodySpinAxisY = 0;
Sat.BodySpinAxisZ = 1;
Sat.InitialPrecessionAngle = 10;
Sat.PrecessionRate = 0.5;
Sat.NutationAngle = 15;
Sat.InitialSpinAngle = 20;
Sat.SpinRate = 1;
END
}
three_axis() { attitude Sat spinner | sed 's/= Spinner/= ThreeAxisKinematic/'; }
commandable() { attitude Sat nadir | sed 's/= Nadir/= CommandableNadir/'; }
of_file() { # a slow turn about a turning axis
    cat > turn.aem << END
CCSDS_AEM_VERS = 1.0
CREATION_DATE = 2024-03-01T00:00:00
ORIGINATOR = srpcore

META_START
OBJECT_NAME = Sat
OBJECT_ID = 1
CENTER_NAME = Earth
REF_FRAME_A = EME2000
REF_FRAME_B = SC_BODY_1
ATTITUDE_DIR = A2B
TIME_SYSTEM = UTC
START_TIME = 2024-03-19T00:00:00.000
USEABLE_START_TIME = 2024-03-19T00:00:00.000
USEABLE_STOP_TIME = 2024-03-22T00:00:00.000
STOP_TIME = 2024-03-22T00:00:00.000
ATTITUDE_TYPE = QUATERNION
QUATERNION_TYPE = LAST
INTERPOLATION_METHOD = Linear
INTERPOLATION_DEGREE = 1
META_STOP

DATA_START
2024-03-19T00:00:00.000 0 0 0 1
2024-03-20T12:00:00.000 0 0 0.6 0.8
2024-03-22T00:00:00.000 0.6 0 0 0.8
DATA_STOP
END
    printf "Sat.Attitude = CCSDS-AEM;\nSat.AttitudeFileName = '%s/turn.aem';\n" "$scratch"
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
same true_of_epoch 'in_axes TOEEq'
same precessing precessing
same three_axis three_axis
same of_file of_file
if [ -e "$GMAT_ROOT/src/base/attitude/CommandableNadirPointing.hpp" ]; then
    same commandable commandable
else
    echo "skipped: this release has no CommandableNadirPointing"
fi
same still still
same spun still 'If I == 2\n  Sat.AngularVelocityZ = 0.15;\n  EndIf;'
same turned still 'Sat.Quaternion = [0.5 0.5 0.5 0.5];'
# What is changed is seen: these are other orbits than that at rest.
for name in spun turned; do
    cmp -s still_plugin.txt ${name}_plugin.txt && fail "$name: nothing has changed"
done
finish
