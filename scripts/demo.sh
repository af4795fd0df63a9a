#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From a bare Debian 12 or Ubuntu to a first table: installs what is missing, builds, and makes the
# table of models/box-wing.obj in every format, and a figure of it.
#
#   scripts/demo.sh [DIRECTORY]     where the tables go; default build/tables
set -euo pipefail
cd "$(dirname "$0")/.."

out=${1:-build/tables}
mass=900 # [kg], for the accelerations of the .txt

# A build tree of its own, so that what it leaves out is not left out of anyone's release build.
bash scripts/install-deps.sh build
cmake --preset release -B build/demo -D SRP_BUILD_TESTS=OFF -D SRP_BUILD_BENCH=OFF
cmake --build build/demo -j "$(nproc)"
srp=build/demo/apps/cli/srp

mkdir -p "$out"
"$srp" info models/box-wing.obj
"$srp" table models/box-wing.obj --step 5 --mass "$mass" \
    -o "$out/box-wing.nc" -o "$out/box-wing.spo" -o "$out/box-wing.txt"
"$srp" plot "$out/box-wing.nc" -o "$out/box-wing.png"

cat <<END

Made from models/box-wing.obj, without a ray of sampling error:
  $out/box-wing.nc    force, moment and lit area over azimuth and elevation (NetCDF: xarray, MATLAB)
  $out/box-wing.spo   the same as GMAT and STK read it (SPAD)
  $out/box-wing.txt   accelerations of a spacecraft of $mass kg
  $out/box-wing.png   force along x, y, z and its length, as surfaces

The program is $srp; to install it: cmake --install build/demo (README.md, "Installation")
END
