#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes the tables that the scripts beside this file name, from models/: .nc for the plugin, .spo for
# GMAT's own reader. Some minutes.
#
#   bash gmat_scripts/tables.sh [DIRECTORY]       default: beside this file, where scripts find them
#
# SRP names the program, default `srp`.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
out=${1:-$here}
srp=${SRP:-srp}
mkdir -p "$out"

# NAME MODEL STEP OPTION...
table() {
    local name=$1 model=$2 step=$3
    shift 3
    if [ ! -e "$out/$name.nc" ] || [ ! -e "$out/$name.spo" ]; then
        "$srp" table "$here/../models/$model.obj" -o "$out/$name.nc" -o "$out/$name.spo" --step "$step" "$@"
    fi
}

table box-wing box-wing 1
table box-wing-traced box-wing 1 --method raytrace --reflections 2
table sun-shield sun-shield 3
table dish dish 2
