#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing of the packages that srpcore is built and tested with, on Debian 12 and
# Ubuntu 22.04 or 24.04. Does nothing where all are there. Works as root and through sudo.
#
#   scripts/install-deps.sh [build] [test] [ci]     default: build test
set -euo pipefail

BUILD=(gcc g++ cmake ninja-build pkg-config libc6-dev libnetcdf-dev libxxhash-dev)
# For plates that are fitted, and for figures; CMake goes on without them.
BUILD+=(libgsl-dev libplplot-dev plplot-driver-cairo)
TEST=(check libgsl-dev libpng-dev)
CI=(clang clang-format libomp-dev)
# Nice to have, and only tried when something else is missing: the yardstick of the benchmarks, a look
# into tables, rendering of manual pages, checks of SVG and PDF.
OPTIONAL=(libembree-dev netcdf-bin mandoc libxml2-utils poppler-utils)
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

main() {
    local groups=("$@") required=() missing=() wanted=("${OPTIONAL[@]}") group package
    [ ${#groups[@]} -gt 0 ] || groups=(build test)
    for group in "${groups[@]}"; do
        case $group in
        build) required+=("${BUILD[@]}") ;;
        test) required+=("${TEST[@]}") ;;
        ci)
            required+=("${CI[@]}")
            wanted+=(libclang-rt-dev) # the sanitizers' own; Ubuntu 22.04 has it inside clang
            ;;
        *)
            echo "install-deps: unknown group '$group', expected build, test or ci" >&2
            exit 2
            ;;
        esac
    done
    if ! command -v dpkg-query >/dev/null; then
        echo "install-deps: this is not Debian or Ubuntu; needed are: ${required[*]}" >&2
        exit 1
    fi

    mapfile -t missing < <(missing_of "${required[@]}")
    if [ ${#missing[@]} -eq 0 ]; then
        return
    fi
    echo "install-deps: installing ${missing[*]}"
    as_root apt-get update -qq
    as_root apt-get install -y -qq --no-install-recommends "${missing[@]}"

    for package in $(missing_of "${wanted[@]}"); do
        if ! as_root apt-get install -y -qq --no-install-recommends "$package" >/dev/null; then
            echo "install-deps: going on without $package (optional)"
        fi
    done
}

main "$@"
