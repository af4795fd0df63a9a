#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing of the packages that srpcore is built and tested with, on Debian 12 and
# Ubuntu 22.04 or 24.04. Does nothing, and asks no network, where all are there. Works as root and
# through sudo.
#
#   scripts/install-deps.sh [build] [test] [ci] [gl] [viewer]     default: build test
set -euo pipefail

BUILD=(gcc g++ cmake ninja-build pkg-config libc6-dev libnetcdf-dev libhdf5-dev libxxhash-dev)
# For plates that are fitted, figures and pictures; CMake goes on without them.
BUILD+=(libgsl-dev libplplot-dev plplot-driver-cairo libpango1.0-dev)
# The propagator: sky and time scales, mission files. Without them, too, the rest is built.
BUILD+=(liberfa-dev libcyaml-dev libyaml-dev)
TEST=(check libgsl-dev libpng-dev)
CI=(clang clang-format libomp-dev)
# Nice to have, and tried once, without a word when that fails but that it did: the yardstick of the
# benchmarks, a look into tables, rendering of manual pages, checks of SVG and PDF.
OPTIONAL=(libembree-dev netcdf-bin mandoc libxml2-utils poppler-utils)
# OpenGL: headers to build with (else --device gl is left out), and what is opened at run time (else
# it says what is missing, and its tests are skipped).
GL=(libgl-dev libegl-dev libosmesa6 libegl1 libgl1-mesa-dri)
OPTIONAL+=("${GL[@]}")
# The viewer, and a display without a screen for its tests. Without them the rest is built.
VIEWER=(libgtk-4-dev adwaita-icon-theme fonts-dejavu-core xvfb)
OPTIONAL+=("${VIEWER[@]}")
# Run-time libraries of the sanitizers and the fuzzer of clang; where there is no such package (Ubuntu
# 22.04) they come with clang itself.
OPTIONAL+=(libclang-rt-dev)

is_installed() {
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

missing_of() {
    local package
    for package in "$@"; do
        is_installed "$package" || echo "$package"
    done
}

as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        DEBIAN_FRONTEND=noninteractive "$@"
    elif command -v sudo >/dev/null; then
        sudo env DEBIAN_FRONTEND=noninteractive "$@"
    else
        echo "install-deps: packages are missing, and this is neither root nor is there sudo" >&2
        return 1
    fi
}

# Those that the lists of packages on this machine know; the others do not exist here.
known_of() {
    local package
    for package in "$@"; do
        if apt-cache policy "$package" 2>/dev/null | grep -q 'Candidate: [^(]'; then
            echo "$package"
        fi
    done
}

install_optional() {
    local missing known
    mapfile -t missing < <(missing_of "${OPTIONAL[@]}")
    mapfile -t known < <(known_of "${missing[@]}")
    if [ ${#known[@]} -gt 0 ]; then
        as_root apt-get install -y -qq --no-install-recommends "${known[@]}" >/dev/null 2>&1 || true
        mapfile -t missing < <(missing_of "${missing[@]}")
    fi
    [ ${#missing[@]} -eq 0 ] || echo "install-deps: going on without ${missing[*]} (optional)"
}

main() {
    local groups=("$@") required=() missing=() group
    [ ${#groups[@]} -gt 0 ] || groups=(build test)
    for group in "${groups[@]}"; do
        case $group in
        build) required+=("${BUILD[@]}") ;;
        test) required+=("${TEST[@]}") ;;
        ci)
            required+=("${CI[@]}")
            ;;
        gl) required+=("${GL[@]}") ;;
        viewer) required+=("${VIEWER[@]}") ;;
        *)
            echo "install-deps: unknown group '$group', expected build, test, ci, gl or viewer" >&2
            exit 2
            ;;
        esac
    done
    if ! command -v dpkg-query >/dev/null; then
        echo "install-deps: this is not Debian or Ubuntu; needed are: ${required[*]}" >&2
        exit 1
    fi

    mapfile -t missing < <(missing_of "${required[@]}")
    if [ ${#missing[@]} -gt 0 ]; then
        echo "install-deps: installing ${missing[*]}"
        as_root apt-get update -qq
        as_root apt-get install -y -qq --no-install-recommends "${missing[@]}"
    fi
    install_optional
}

main "$@"
