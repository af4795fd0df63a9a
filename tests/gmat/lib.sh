# SPDX-License-Identifier: Apache-2.0
# Shared by the tests that run real GMAT, which ctest runs as
#   GMAT_ROOT=tree GMAT_STARTUP=file PLUGIN=libSrpCorePlugin.so SRP=srp ROOT=sources bash NAME.sh
# each in an empty directory of its own. A check that fails is reported, the test goes on. Without
# GMAT_ROOT they say skipped.
# shellcheck shell=bash disable=SC2034
set -u

SHARED=${SRP_SHARED_DATA_DIR:-$ROOT/../shared/data}
if [ -z "${GMAT_ROOT-}" ] || ! [ -x "$GMAT_ROOT/application/bin/GmatConsole" ]; then
    echo "skipped: real GMAT is not here (SRP_WITH_GMAT, GMAT_ROOT with application/bin/GmatConsole)"
    exit 77
fi
failures=0
scratch=$(mktemp -d "${TMPDIR:-/tmp}/srp-gmat.XXXXXX") || exit 1
[ -n "${KEEP-}" ] || trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1
export XDG_CACHE_HOME=$scratch/cache

startup=${GMAT_STARTUP:-$GMAT_ROOT/application/bin/gmat_startup_file.txt}
{
    grep -v '^ *\(PLUGIN\|OUTPUT_PATH\)' "$startup"
    echo "OUTPUT_PATH = $scratch/"
    if [ -e "$GMAT_ROOT/application/plugins/libNewParameters.so" ]; then
        echo "PLUGIN = ../plugins/libNewParameters"
    fi
    echo "PLUGIN = ${PLUGIN%.so}"
} > startup.txt

fail() {
    failures=$((failures + 1))
    echo "FAILED: ${0##*/}:${BASH_LINENO[${#BASH_LINENO[@]} - 2]}: $1"
    grep -a 'HighFidelitySRP\|ERROR\|xception\|failed' log 2> /dev/null | head -5 | sed 's/^/  /'
}

# gmat SCRIPT: its exit status; what it says is in ./log.
gmat() {
    local script
    script=$(realpath "$1")
    (cd "$GMAT_ROOT/application/bin" &&
        exec ./GmatConsole --startup_file "$scratch/startup.txt" --run "$script") > log 2>&1
}
runs() { gmat "$1" || fail "$1 ends with status $?"; }
# stops SCRIPT TEXT: exit status 1, with this message; no crash.
stops() {
    local got
    gmat "$1"
    got=$?
    [ "$got" -eq 1 ] || fail "$1 ends with status $got, expected 1"
    grep -qF -- "$2" log || fail "$1: the message lacks '$2'"
}
says() { grep -qF -- "$1" log || fail "no word of '$1'"; }

# apart LIMIT_MM A B: the largest distance of two reports, printed.
apart() {
    local text
    text=$(bash "$ROOT/gmat_scripts/compare.sh" "$2.txt" "$3.txt") || { fail "$text"; return; }
    echo "$2, $3: $text"
    echo "$text" | sed 's/.*largest distance \([0-9.]*\) mm.*/\1/' |
        awk -v limit="$1" '{ exit !($1 <= limit) }' || fail "expected at most $1 mm"
}

# ---- Missions ------------------------------------------------------------------------------------

# spacecraft NAME [MASS]: GEO at the equinox, an eclipse a night.
spacecraft() {
    cat << END
Create Spacecraft $1;
$1.DateFormat = UTCGregorian;
$1.Epoch = '20 Mar 2024 00:00:00.000';
$1.CoordinateSystem = EarthMJ2000Eq;
$1.DisplayStateType = Cartesian;
$1.X = 36607.35826;
$1.Y = -20921.7237;
$1.Z = 0;
$1.VX = 1.5256345;
$1.VY = 2.6694515;
$1.VZ = 0.0123456;
$1.DryMass = ${2-850};
END
}

# attitude NAME inertial|nadir|spinner
attitude() {
    case $2 in
    nadir) cat << END ;;
$1.Attitude = NadirPointing;
$1.AttitudeReferenceBody = Earth;
$1.AttitudeConstraintType = 'OrbitNormal';
$1.BodyAlignmentVectorX = 0;
$1.BodyAlignmentVectorY = 0;
$1.BodyAlignmentVectorZ = 1;
$1.BodyConstraintVectorX = 0;
$1.BodyConstraintVectorY = 1;
$1.BodyConstraintVectorZ = 0;
END
    inertial) # body axes are those of the system: GMAT takes no quaternion there
        printf '%s.Attitude = CoordinateSystemFixed;\n' "$1"
        printf '%s.AttitudeCoordinateSystem = EarthMJ2000Eq;\n' "$1"
        ;;
    *) cat << END ;;
$1.Attitude = Spinner;
$1.AttitudeDisplayStateType = Quaternion;
$1.AttitudeRateDisplayStateType = AngularVelocity;
$1.AttitudeCoordinateSystem = EarthMJ2000Eq;
$1.Q1 = 0.1;
$1.Q2 = 0.2;
$1.Q3 = -0.3;
$1.Q4 = 0.92736;
END
    esac
    if [ "$2" = spinner ]; then
        printf '%s.AngularVelocityX = 0.01;\n%s.AngularVelocityY = -0.02;\n' "$1" "$1"
        printf '%s.AngularVelocityZ = 0.15;\n' "$1"
    fi
}

# spad NAME FILE: the table of GMAT's own reader.
spad() {
    printf "%s.SPADSRPFile = '%s';\n%s.SPADSRPScaleFactor = 1;\n" "$1" "$2" "$1"
    printf '%s.SPADSRPInterpolationMethod = Bilinear;\n' "$1"
}

# forces NAME spad | forces NAME plugin LINE...
forces() {
    local name=$1 kind=$2 line
    shift 2
    printf 'Create ForceModel %s;\n%s.CentralBody = Earth;\n' "$name" "$name"
    printf '%s.PointMasses = {Earth, Sun, Luna};\n%s.Drag = None;\n' "$name" "$name"
    case $kind in
    spad) printf '%s.SRP = On;\n%s.SRP.SRPModel = SPADFile;\n' "$name" "$name" ;;
    round) printf '%s.SRP = On;\n%s.SRP.SRPModel = Spherical;\n' "$name" "$name" ;;
    plugin)
        printf '%s.SRP = Off;\n%s.UserDefined = {HighFidelitySRP};\n' "$name" "$name"
        for line in "$@"; do
            printf '%s.HighFidelitySRP.%s;\n' "$name" "$line"
        done
        ;;
    esac
}

# propagator NAME FORCES [STEP]: steps of one length, so that two runs have the same rows.
propagator() {
    cat << END
Create Propagator $1;
$1.FM = $2;
$1.Type = PrinceDormand78;
$1.InitialStepSize = ${3-30};
$1.Accuracy = 1e-12;
$1.MinStep = ${3-30};
$1.MaxStep = ${3-30};
$1.StopIfAccuracyIsViolated = false;
END
}

# report NAME SPACECRAFT: a row each step, in NAME.txt.
report() {
    cat << END
Create ReportFile $1;
$1.Filename = '$scratch/$1.txt';
$1.Precision = 16;
$1.WriteHeaders = false;
$1.ColumnWidth = 26;
$1.Add = {$2.ElapsedSecs, $2.EarthMJ2000Eq.X, $2.EarthMJ2000Eq.Y, $2.EarthMJ2000Eq.Z, $2.EarthMJ2000Eq.VX, $2.EarthMJ2000Eq.VY, $2.EarthMJ2000Eq.VZ, $2.TotalMass};
END
}

# A table of One-Wing-Sat, which GMAT brings.
one_wing() {
    local path
    for path in "$SHARED/spad/One-Wing-Sat.spo" \
        "$GMAT_ROOT/application/data/vehicle/spad/One-Wing-Sat.spo"; do
        if [ -e "$path" ]; then
            realpath "$path"
            return
        fi
    done
    echo "skipped: no One-Wing-Sat.spo" >&2
    exit 77
}

finish() {
    [ "$failures" -eq 0 ] || echo "$failures checks failed"
    [ "$failures" -eq 0 ]
    exit
}
