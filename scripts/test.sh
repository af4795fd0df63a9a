#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds, runs the tests, and lists what was skipped and why. Exit status
# 0 when every test passed.
#
#   scripts/test.sh [--long] [PRESET]     default dev; --long: the tests labelled long as well
set -euo pipefail
cd "$(dirname "$0")/.."

which=(-LE long)
if [ "${1:-}" = --long ]; then
    which=()
    shift
fi
preset=${1:-dev}
if [ "$preset" = tsan ]; then
    which=(-LE 'long|serial') # ten times slower, and only threads are of interest
fi
jobs=$(nproc)

bash scripts/install-deps.sh build test
cmake --preset "$preset"
cmake --build --preset "$preset" -j "$jobs"

log=build/$preset/Testing/Temporary/LastTest.log
said=$(mktemp)
trap 'rm -f "$said"' EXIT
status=0
ctest --preset "$preset" -j "$jobs" "${which[@]}" --no-tests=error | tee "$said" || status=$?

echo
sort -u "$log" | grep 'skipped:' || true
[ "$status" -eq 0 ] || echo "see $log"
echo "test.sh $preset: $(grep 'tests passed' "$said")"
exit "$status"
