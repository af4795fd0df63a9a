# SPDX-License-Identifier: Apache-2.0
# Every field wrong in turn, files that are missing or damaged: GMAT says which field, which file and
# which line in it, ends with status 1, and never crashes.
. "$(dirname "$0")/lib.sh"
good="SRPObjFile = '$ROOT/models/box-wing.obj'"

# wrong TEXT LINE...: a mission with these lines stops with this text.
wrong() {
    local text=$1
    shift
    {
        spacecraft Sat
        attitude Sat nadir
        forces FM plugin "$@"
        propagator Prop FM 60
        echo 'BeginMissionSequence;'
        echo 'Propagate Prop(Sat) {Sat.ElapsedSecs = 600};'
    } > wrong.script
    stops wrong.script "$text"
}

wrong 'SRPTableFile: not set' 'SRPScaleFactor = 1'
wrong 'SRPTableFile: nowhere.nc' "SRPTableFile = 'nowhere.nc'"
wrong 'is no name of a table' "SRPTableFile = 'table.xyz'"
wrong 'exclude each other' "$good" "SRPTableFile = 'a.nc'"
wrong 'SRPObjFile: nowhere.obj' "SRPObjFile = 'nowhere.obj'"
wrong 'SRPMtlFile: nowhere.mtl' "$good" "SRPMtlFile = 'nowhere.mtl'"
wrong 'SRPMtlFile: goes with SRPObjFile' "SRPTableFile = 'a.nc'" "SRPMtlFile = 'a.mtl'"
wrong 'SRPUnit: found 0' "$good" 'SRPUnit = 0'
wrong "SRPMethod: found 'guess'" "$good" 'SRPMethod = guess'
wrong 'SRPGrid: found 0' "$good" 'SRPGrid = 0'
wrong 'Only integer number is allowed' "$good" 'SRPGrid = 1.5'
wrong 'SRPReflections: found -1' "$good" 'SRPReflections = -1'
wrong 'SRPDiffuse: found 9999' "$good" 'SRPDiffuse = 9999'
wrong 'SRPAzimuthStep: found 0' "$good" 'SRPAzimuthStep = 0'
wrong 'SRPAzimuthStep, SRPElevationStep: ' "$good" 'SRPElevationStep = 7'
wrong 'SRPElevationStep: found 200' "$good" 'SRPElevationStep = 200'
wrong 'The allowed values are: [true false]' "$good" 'SRPOnDemand = perhaps'
wrong 'The allowed values are: [true false]' "$good" 'SRPCache = 2'
wrong 'SRPThreads: found -2' "$good" 'SRPThreads = -2'
wrong "SRPInterpolation: found 'cubic'" "$good" 'SRPInterpolation = cubic'
wrong 'SRPInterpolation: spline needs all nodes' "$good" 'SRPInterpolation = spline'
wrong 'SRPMaxError: found -1' "$good" 'SRPMaxError = -1'
wrong 'SRPScaleFactor: found -0.5' "$good" 'SRPScaleFactor = -0.5'
wrong 'SRPFlux: found 0' "$good" 'SRPFlux = 0'
wrong 'SRPAstronomicalUnit: found 1' "$good" 'SRPAstronomicalUnit = 1'
wrong "SRPShadowBodies: there is no body 'Vulcan'" "$good" "SRPShadowBodies = 'Earth, Vulcan'"
wrong 'is not permitted' "$good" 'SRPColour = 3'

# The place in the file.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 zero\nf 1 2 3\n' > bad.obj
wrong 'bad.obj:3:' "SRPObjFile = '$scratch/bad.obj'"
printf 'newmtl bus\nrho_s 0.9\nrho_d 0.9\n' > bad.mtl
wrong 'bad.mtl:' "$good" "SRPMtlFile = '$scratch/bad.mtl'"
table=$(one_wing) || exit 77
sed '2000s/.*/ 1 2 three 4 5/' "$table" > bad.spo
wrong 'bad.spo:2000:' "SRPTableFile = '$scratch/bad.spo'"
awk '/Record count/ { on = 1 } on && NF == 5 && $1 + 0 == $1 { print $1, $2, -$3, -$4, -$5; next } { print }' \
    "$table" > pull.spo
wrong 'pull towards the Sun' "SRPTableFile = '$scratch/pull.spo'"
"$SRP" table "$ROOT/models/cube.obj" -o cube.nc --step 30 > /dev/null || fail "srp table"
head -c 3000 cube.nc > short.nc
wrong 'SRPTableFile: ' "SRPTableFile = '$scratch/short.nc'"
# Some bytes in the middle are others.
cp cube.nc flipped.nc
printf 'damage' | dd of=flipped.nc bs=1 seek=$(($(wc -c < cube.nc) / 2)) conv=notrunc 2> /dev/null
wrong 'SRPTableFile: ' "SRPTableFile = '$scratch/flipped.nc'"

# No plugin at all, as with one that is of another release and does not load.
sed -i "s#^PLUGIN = ${PLUGIN%.so}#PLUGIN = $scratch/nowhere#" startup.txt
wrong 'User defined force "HighFidelitySRP" cannot be created' "$good"
if [ -e "${PLUGIN_OF_OTHER_RELEASE-}" ]; then
    sed -i "s#^PLUGIN = $scratch/nowhere#PLUGIN = ${PLUGIN_OF_OTHER_RELEASE%.so}#" startup.txt
    wrong 'User defined force "HighFidelitySRP" cannot be created' "$good"
    says 'cannot open shared object file'
else
    echo "skipped: no plugin of another release (PLUGIN_OF_OTHER_RELEASE)"
fi
finish
