# SPDX-License-Identifier: Apache-2.0
# Two propagators with two spacecraft each and different tables, in one script, give what each gives
# alone.
. "$(dirname "$0")/lib.sh"
table=$(one_wing) || exit 77
box="SRPObjFile = '$ROOT/models/box-wing.obj'"

craft() {
    case $1 in
    A) spacecraft A 850; attitude A nadir ;;
    B) spacecraft B 300; attitude B inertial ;;
    C) spacecraft C 850; attitude C spinner ;;
    D) spacecraft D 120; attitude D nadir ;;
    esac
}
models() {
    forces FM1 plugin "SRPTableFile = '$table'"
    forces FM2 plugin "$box" "SRPInterpolation = bilinear" "SRPAzimuthStep = 5" \
        "SRPElevationStep = 5" "SRPScaleFactor = 1.1"
    propagator P1 FM1 60
    propagator P2 FM2 60
}
{
    for s in A B C D; do craft $s; done
    models
    for s in A B C D; do report all_$s $s; done
    echo 'BeginMissionSequence;'
    echo 'Propagate P1(A, B) P2(C, D) {A.ElapsedDays = 1};'
} > all.script
runs all.script
for s in A B C D; do
    { craft $s; models; report alone_$s $s; echo 'BeginMissionSequence;'
        case $s in A | B) p=P1 ;; *) p=P2 ;; esac
        echo "Propagate $p($s) {$s.ElapsedDays = 1};"; } > alone_$s.script
    runs alone_$s.script
    apart 0.01 all_$s alone_$s
done
finish
