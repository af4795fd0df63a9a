#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs every libFuzzer target from its kept corpus. Inputs found on the way stay in build/fuzz/found,
# an input that breaks something in build/fuzz/broken; copy the latter, made small, into
# tests/fuzz/corpus/NAME. Exit status 0 when nothing broke.
#
#   scripts/fuzz.sh [SECONDS [NAME...]]     default 60 seconds each, all targets
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-60}
shift || true
cmake --preset fuzz
cmake --build --preset fuzz -j "$(nproc)"
if [ $# -eq 0 ]; then
    for program in build/fuzz/tests/fuzz/fuzz_*; do
        [ -x "$program" ] && [ -f "$program" ] && set -- "$@" "${program##*/fuzz_}"
    done
fi

# Leaks of libraries that are not ours, as for the tests.
export LSAN_OPTIONS=suppressions=$PWD/tests/sanitizer/lsan.supp:print_suppressions=0
status=0
for name in "$@"; do
    found=build/fuzz/found/$name broken=build/fuzz/broken/$name
    mkdir -p "$found" "$broken"
    words=()
    [ -f "tests/fuzz/$name.dict" ] && words=("-dict=tests/fuzz/$name.dict")
    if "build/fuzz/tests/fuzz/fuzz_$name" -max_total_time="$seconds" -max_len=4096 -timeout=10 \
        -rss_limit_mb=2048 -print_final_stats=1 "${words[@]}" -artifact_prefix="$broken/" \
        "$found" "tests/fuzz/corpus/$name" >"$found.log" 2>&1; then
        runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$found.log")
        echo "fuzz.sh: $name: clean after $seconds s, $runs inputs"
    else
        tail -n 40 "$found.log"
        echo "fuzz.sh: $name: broken, see $broken"
        status=1
    fi
done
exit "$status"
