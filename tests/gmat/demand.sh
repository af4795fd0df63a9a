# SPDX-License-Identifier: Apache-2.0
# On demand: the first run fills the cache with a small part of the grid, the second reads it and
# traces nothing, to the same trajectory.
. "$(dirname "$0")/lib.sh"

for run in first second; do
    {
        spacecraft Sat
        attitude Sat nadir
        forces FM plugin "SRPObjFile = '$ROOT/models/box-wing.obj'" "SRPMethod = raytrace"
        propagator Prop FM 60
        report $run Sat
        echo 'BeginMissionSequence;'
        echo 'Propagate Prop(Sat) {Sat.ElapsedDays = 2};'
    } > $run.script
    runs $run.script
    grep 'directions traced' log || fail "no word of what was traced"
done
says ' 0 directions traced'
apart 0 first second
finish
