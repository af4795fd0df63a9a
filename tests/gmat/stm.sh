# SPDX-License-Identifier: Apache-2.0
# The state transition matrix that GMAT integrates with the plugin's partials beside differences of
# its own trajectories with the same model: 1e-5. A light sail, in and out of the Earth's shadow.
. "$(dirname "$0")/lib.sh"
table=$(one_wing) || exit 77

start=(36607.35826 -20921.7237 0 1.5256345 2.6694515 0.0123456)
names=(X Y Z VX VY VZ)
steps=(0.5 0.5 0.5 5e-5 5e-5 5e-5)
{
    spacecraft Sat 1
    attitude Sat inertial
    others=
    for j in 0 1 2 3 4 5; do
        for sign in + -; do
            name=${names[j]}$([ $sign = + ] && echo Up || echo Down)
            spacecraft $name 1
            attitude $name inertial
            echo "$name.${names[j]} = $(echo "${start[j]} ${steps[j]}" |
                awk "{ printf \"%.12f\", \$1 $sign \$2 }");"
            others="$others, $name"
        done
    done
    forces FM plugin "SRPTableFile = '$table'" "SRPInterpolation = spline"
    propagator Prop FM 30
    propagator Other FM 30
    cat << END
Create Array Phi[6,6];
Create ReportFile Stm;
Stm.Filename = '$scratch/stm.txt';
Stm.Precision = 16;
Stm.WriteHeaders = false;
Stm.ColumnWidth = 26;
Create ReportFile Ends;
Ends.Filename = '$scratch/ends.txt';
Ends.Precision = 16;
Ends.WriteHeaders = false;
Ends.ColumnWidth = 26;
BeginMissionSequence;
Propagate Prop(Sat, 'STM') {Sat.ElapsedDays = 1};
Propagate Other(${others#, }) {XUp.ElapsedDays = 1};
Phi = Sat.OrbitSTM;
Report Stm Phi;
END
    for name in ${others//,/}; do
        printf 'Report Ends %s.EarthMJ2000Eq.X %s.EarthMJ2000Eq.Y %s.EarthMJ2000Eq.Z' "$name" "$name" "$name"
        printf ' %s.EarthMJ2000Eq.VX %s.EarthMJ2000Eq.VY %s.EarthMJ2000Eq.VZ;\n' "$name" "$name" "$name"
    done
} > stm.script
runs stm.script

# Elements of a block over the largest of it: x by x, x by v, v by x, v by v.
tr -s ' \t\n' '\n' < stm.txt | grep . > stm.list
tr -s ' \t\n' '\n' < ends.txt | grep . > ends.list
result=$(awk -v steps="${steps[*]}" '
    FNR == NR { phi[int((FNR - 1) / 6), (FNR - 1) % 6] = $1; next }
    { end[int((FNR - 1) / 6), (FNR - 1) % 6] = $1 }
    END {
        split(steps, h, " ")
        for (j = 0; j < 6; ++j) for (i = 0; i < 6; ++i) {
            slope = (end[2 * j, i] - end[2 * j + 1, i]) / (2 * h[j + 1])
            block = int(i / 3) * 2 + int(j / 3)
            d = slope - phi[i, j]; if (d < 0) d = -d
            a = phi[i, j] < 0 ? -phi[i, j] : phi[i, j]
            if (d > off[block]) off[block] = d
            if (a > size[block]) size[block] = a
        }
        for (b = 0; b < 4; ++b) if (size[b] > 0 && off[b] / size[b] > worst) worst = off[b] / size[b]
        printf "%.3g", (size[0] > 0 ? worst : 1)
    }' stm.list ends.list)
echo "state transition matrix and differences: $result"
echo "$result" | awk '{ exit !($1 <= 1e-5) }' || fail "expected 1e-5"
finish
