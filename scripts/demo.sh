#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From a bare Debian 12 or Ubuntu to a first table: installs what is missing, builds, and makes the
# table of models/box-wing.obj in every format, a figure of it, and an orbit with it.
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

# The mission of a satellite in GEO, with the table in place of computing at every step.
sed -e 's/model: direct/model: table/' -e 's/file: .*/file: box-wing.nc/' \
    models/missions/geo-box-wing.yaml > "$out/geo.yaml"
"$srp" propagate "$out/geo.yaml" --oem "$out/geo.oem" --report "$out/geo.csv"

cat <<END

Made from models/box-wing.obj, without a ray of sampling error:
  $out/box-wing.nc    force, moment and lit area over azimuth and elevation (NetCDF: xarray, MATLAB)
  $out/box-wing.spo   the same as GMAT and STK read it (SPAD)
  $out/box-wing.txt   accelerations of a spacecraft of $mass kg
  $out/box-wing.png   force along x, y, z and its length, as surfaces
  $out/geo.oem        30 days in GEO with that table, as CCSDS OEM; the mission is geo.yaml
  $out/geo.csv        the same: elements, SRP acceleration, share of the Sun that is seen

The program is $srp; to install it: cmake --install build/demo (README.md, "Installation")
END
