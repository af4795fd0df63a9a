#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Methods on the devices of OpenGL, as users ask for them: results, tables, resuming, and what is said
# where there is no OpenGL.
. "$(dirname "$0")/lib.sh"

force=(force "$MODELS/box-wing.obj" --az 30 --el 10)

# wrong TEXT ARGUMENT...: refused as usage, saying TEXT.
wrong() {
    local text=$1
    shift
    expect 2 "$@"
    says "$text"
}

if ! "$SRP" force --help | grep -q 'gl:osmesa'; then
    skip 'this srp is built without OpenGL'
    wrong '--device gl: this srp is built without OpenGL' "${force[@]}" --method raycast --device gl
    wrong '--device gl:egl: this srp is built without OpenGL' "${force[@]}" --method raycast \
        --device gl:egl
    finish
fi

# Devices and methods that do not go together.
wrong 'method exact is not there for --device gl, only for cpu' "${force[@]}" --device gl
wrong 'method raycast is not there for --device gl:nvidia, only for cpu, gl:osmesa, gl:egl' \
    "${force[@]}" --method raycast --device gl:nvidia
wrong 'method raycast does not use --diffuse (methods that do: raytrace)' "${force[@]}" \
    --method raycast --device gl --diffuse 4

# What is missing is said, and is a failure of the machine.
GALLIUM_DRIVER=swr expect 3 "${force[@]}" --method raycast --device gl
says "GALLIUM_DRIVER is 'swr'"
expect 3 "${force[@]}" --method raycast --device gl:egl:7

# try DEVICE: results agree with the processor's to some digits.
try() {
    local device=$1 grid=(--grid 100)
    "$SRP" "${force[@]}" --method raycast --device "$device" "${grid[@]}" > out 2> err
    if [ $? -eq 3 ]; then
        skip "$device: $(tail -n 1 err)"
        return
    fi
    expect 0 "${force[@]}" --method raycast --device "$device" "${grid[@]}"
    prints "raycast ($device"
    silent
    expect 0 "${force[@]}" --method raytrace --device "$device" --diffuse 2 "${grid[@]}"
    prints "raytrace ($device"
    prints 'of it reflected'
    cp ../log/out gl
    expect 0 "${force[@]}" --method raytrace --device cpu --diffuse 2 "${grid[@]}"
    # All that is printed of f to 8 digits.
    check "$device: the force differs" diff <(grep 'area vector' gl | cut -c 1-28) \
        <(grep 'area vector' ../log/out | cut -c 1-28)

    # A table, the same for any number of threads.
    table=(table "$MODELS/box-wing.obj" -o t.nc --step 45 --method raycast --device "$device")
    expect 0 "${table[@]}" "${grid[@]}" --threads 1
    mv t.nc one.nc
    expect 0 "${table[@]}" "${grid[@]}" --threads 3
    expect 0 convert t.nc t.spo
    expect 0 convert one.nc one.spo
    check 'the table depends on threads' diff <(grep -v Created t.spo) <(grep -v Created one.spo)

    # What another device has begun does not belong to it.
    expect 0 table "$MODELS/box-wing.obj" -o t.nc.partial.nc --step 45 --method raycast "${grid[@]}"
    mv t.nc.partial.nc t.nc.partial
    expect 1 "${table[@]}" "${grid[@]}"
    says 'device'
    says '--restart discards it'
    cp one.nc t.nc.partial
    expect 0 "${table[@]}" "${grid[@]}"
    says 'going on with t.nc.partial'
    rm -f t.nc t.spo one.nc one.spo out err gl
}
try gl:osmesa
try gl:egl

finish
