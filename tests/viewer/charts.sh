#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The four surfaces: what turns them, together and apart, and the mark under the pointer.
. "$(dirname "$0")/lib.sh"
start_display

{
    cat << END
resize 1280 800
wait
tab graphics
az-step 10
el-step 10
compute-table
wait
END
    printf 'place chart-%d\n' 0 1 2 3
    cat << END
screenshot $SHOTS/chart-0.png
point chart-1 300,110
expect chart-pointer azimuth
screenshot $SHOTS/chart-1.png
press chart-2 Left
screenshot $SHOTS/chart-2.png
chart-view 4 60,80
screenshot $SHOTS/chart-3.png
turn-together
screenshot $SHOTS/chart-4.png
press chart-2 Up
screenshot $SHOTS/chart-5.png
chart-view 1 300,20
screenshot $SHOTS/chart-6.png
chart-view 1 660,20
screenshot $SHOTS/chart-7.png
chart-view 5 0,0
expect message a surface from 1 to 4
chart-view 1 0
expect message a surface from 1 to 4
END
} > "$scratch/steps"
view 0 --actions "$scratch/steps" "$ROOT/models/box-wing.obj"

# differ ONE OTHER CHART LEAST MOST: what differs between two pictures of a chart, within its focus ring, fits
# into a square of LEAST to MOST pixels.
differ() {
    local x y w h
    read -r x y w h <<< "$(value "place of chart-$3")"
    "$CHECK" differ "$SHOTS/chart-$1.png" "$SHOTS/chart-$2.png" $((x + 8)) $((y + 8)) $((w - 16)) $((h - 16)) "$4" "$5"
}
for chart in 0 1 2 3; do
    # Around the node and nowhere else: no line leads to the mark.
    differ 0 1 "$chart" 8 20 || fail "the mark on chart $chart is more or less than a ring"
    differ 1 2 "$chart" 100 9999 || fail "chart $chart does not turn with another one by keys"
    differ 2 3 "$chart" 100 9999 || fail "chart $chart does not turn with another one"
    # Apart, the mark is where the pointer is, and one turns alone.
    [ "$chart" -eq 1 ] && most=0 || most=20
    differ 3 4 "$chart" "$((most > 0 ? 8 : 0))" "$most" || fail "the mark on chart $chart, apart"
    [ "$chart" -eq 2 ] && most=9999 || most=0
    differ 4 5 "$chart" "$((most > 0 ? 100 : 0))" "$most" || fail "chart $chart, when another one turns alone by keys"
    [ "$chart" -eq 0 ] && most=9999 || most=0
    differ 5 6 "$chart" "$((most > 0 ? 100 : 0))" "$most" || fail "chart $chart, when the first turns alone"
    differ 6 7 "$chart" 0 0 || fail "chart $chart: a whole turn is seen"
done
judge
