# SPDX-License-Identifier: Apache-2.0
# What GMAT saves of a mission has all fields of the force, and runs to the same orbit.
. "$(dirname "$0")/lib.sh"
table=$(one_wing) || exit 77

{
    spacecraft Sat
    attitude Sat nadir
    forces FM plugin "SRPTableFile = '$table'" "SRPInterpolation = bilinear" \
        "SRPScaleFactor = 1.0625" "SRPShadowBodies = 'Earth, Luna'" "SRPFlux = 1361.5" \
        "SRPOnDemand = false" "SRPMaxError = 0.03125"
    propagator Prop FM 60
    report first Sat
    echo 'BeginMissionSequence;'
    echo 'Propagate Prop(Sat) {Sat.ElapsedDays = 0.25};'
} > mission.script

# Only the interactive console saves, over the script that it has run; it looks for its startup file
# in the directory that it is started in.
mkdir bin
sed "s#^ROOT_PATH.*#ROOT_PATH = $(realpath "$GMAT_ROOT")/application/#" startup.txt |
    sed "s#^\(PLUGIN *= *\)\.\./#\1$(realpath "$GMAT_ROOT")/application/#" > bin/gmat_startup_file.txt
(cd bin && printf '%s\n--save\nq\n' ../mission.script | "$(realpath "$GMAT_ROOT")/application/bin/GmatConsole") > log 2>&1 ||
    fail "interactive GMAT ends with status $?"
for line in "UserDefined = {HighFidelitySRP};" "SRPTableFile = '$table';" \
    'SRPInterpolation = ' 'SRPScaleFactor = 1.0625;' 'SRPFlux = 1361.5;' 'SRPOnDemand = false;' \
    'SRPMaxError = 0.03125;' "SRPShadowBodies = 'Earth, Luna';" 'SRPAstronomicalUnit = '; do
    grep -qF -- "$line" mission.script || fail "the saved script lacks '$line'"
done
grep -q 'Generated\|General Mission Analysis Tool' mission.script || fail "it was not saved"
sed -i "s#first\.txt#second.txt#" mission.script
runs mission.script
apart 0 first second
finish
