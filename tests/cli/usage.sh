#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Wrong usage: status 2, a message that names the fault and what was expected, and the way to help.
. "$(dirname "$0")/lib.sh"

cube=$MODELS/cube.obj
force=(force "$cube" --az 10 --el 20)

# wrong TEXT ARGUMENT...: refused as usage, saying TEXT.
wrong() {
    local text=$1
    shift
    expect 2 "$@"
    says "$text"
    says "--help' for more information."
}

# Commands and options.
wrong 'no command given'
wrong "unknown command 'tabel', did you mean 'table'?" tabel
wrong "unknown command 'xyzzy'" xyzzy
says_not 'did you mean'
wrong "unknown option '--step'; options follow a command" --step 5
wrong "unknown command 'ifno', did you mean 'info'?" help ifno
wrong "unknown option '--gird', did you mean '--grid'?" force --gird 3
wrong "unknown option '--pixle', did you mean '--pixel'?" force --pixle=3
wrong "unknown option '--xyzzy'" force --xyzzy
says_not 'did you mean'
wrong "unknown option '-x'" force -x
# In full: what is short for one option in one command is another in the next.
wrong "unknown option '--m'" force --m 3
wrong "unknown option '--az', did you mean '--az-step'?" table "$cube" -o t.nc --az 3
wrong "unknown option '--az', did you mean '--az-step'?" table "$cube" -o t.nc --az=3
wrong "unknown option '--js', did you mean '--json'?" "${force[@]}" --js
wrong "unknown option '--mas', did you mean '--mass'?" "${force[@]}" --mas
wrong "unknown option '--jso', did you mean '--json'?" "${force[@]}" --jso=yes
wrong '--json takes no value' force --json=yes
wrong '--az needs a value: DEG' force --az
wrong '-o needs a value: FILE' table -o

# Of two values none wins without a word, in any command; lists and flags may be repeated.
wrong '--az is given twice and takes one value' "${force[@]}" --az 10
wrong '--az is given twice' "${force[@]}" --az=11 --json
wrong '--output (-o) is given twice and takes one value' plot a.nc -o a.png --output b.png
wrong '--output (-o) is given twice' compare a.nc b.nc -o a.png -o b.png
wrong '--output (-o) is given twice' picture "$cube" --az 1 --el 1 -o a.png -o b.png
wrong '--output (-o) is given twice' fit-nplate a.nc -o a.plates -o b.plates
wrong '--step is given twice' table "$cube" -o t.nc --step 5 --step 5
wrong '--unit is given twice' info "$cube" --unit mm --unit cm
expect 0 "${force[@]}" --json --json --material surface=0,0 --material surface=0.1,0.2

# Numbers, strictly.
for text in x 1x '' ' 1' 0x10 nan inf 1e999 1,5 --5; do
    wrong 'expected a number above 0' "${force[@]}" --mass "$text"
done
wrong 'expected an angle from -360 to 360 degrees' force "$cube" --az 361 --el 0
wrong 'expected an angle from -90 to 90 degrees' force "$cube" --az 0 --el -91
wrong 'expected a number above 0' "${force[@]}" --mass 0
wrong 'expected a number above 0' "${force[@]}" --mass -1
wrong 'expected a number above 0' "${force[@]}" --distance-au 0
wrong 'expected a number above 0' "${force[@]}" --flux 0
# Beyond all sense: the results would be infinite, or not a number.
wrong 'expected a number above 0 (1e-30 to 1e30)' "${force[@]}" --mass 1e-320
wrong 'expected a number above 0 (1e-30 to 1e30)' "${force[@]}" --distance-au 1e-200
wrong 'expected a number above 0 (1e-30 to 1e30)' "${force[@]}" --flux 1e300
wrong 'each up to 1e30' "${force[@]}" --reference 1e308,1e308,0
wrong 'each up to 1e30' "${force[@]}" --method raycast --window -1e308,1e308,-1,1
wrong 'expected a number not below 0 (up to 1e30)' force --method cannonball --cr 1e300 --area 1e300 \
    --az 0 --el 0
for text in 0 32769 1.5 -3 1e3 99999999999999999999; do
    wrong 'expected a whole number from 1 to 32768' "${force[@]}" --method raycast --grid "$text"
done
wrong 'expected a whole number from 1 to 1024' "${force[@]}" --threads 0
wrong 'expected a whole number from 0 to 18446744073709551615' "${force[@]}" --method raycast \
    --seed 18446744073709551616
wrong 'three numbers X,Y,Z' "${force[@]}" --reference 1,2
wrong 'three numbers X,Y,Z' "${force[@]}" --reference 1,2,3,4
wrong 'three numbers X,Y,Z' "${force[@]}" --reference 1,,3
wrong 'four numbers U0,U1,V0,V1' "${force[@]}" --method raycast --window 1,0,0,1
wrong 'four numbers U0,U1,V0,V1' "${force[@]}" --method raycast --window 0,1,0
wrong 'm, mm, cm, in, ft, or the number of metres' "${force[@]}" --unit miles
wrong 'm, mm, cm, in, ft, or the number of metres' "${force[@]}" --unit 0
wrong 'm, mm, cm, in, ft, or the number of metres' "${force[@]}" --unit -1

# Materials.
for text in gold gold= gold=1 gold=1,2,3 gold=.1,.1,onesided gold=a,b; do
    wrong 'expected NAME=RHO_S,RHO_D or NAME=RHO_S,RHO_D,one-sided' "${force[@]}" --material "$text"
done
wrong '--material surface=.7,.4: rho_s + rho_d' "${force[@]}" --material surface=.7,.4
wrong '--material surface=-.1,.4: rho_s is -0.1' "${force[@]}" --material surface=-.1,.4

# Methods, and options that the method does not use.
wrong "unknown method 'exat', did you mean 'exact'?" "${force[@]}" --method exat
wrong "unknown method 'montecarlo' (methods: cannonball, nplate, exact, raycast, raytrace)" "${force[@]}" \
    --method montecarlo
wrong 'method exact is not there for --device tpu' "${force[@]}" --device tpu
for option in --grid=64 --pixel=.1 --window=0,1,0,1 --columns=8 --rows=8 --seed=1 --tolerance=.1; do
    wrong "method exact does not use ${option%%=*} (methods that do: raycast, raytrace)" "${force[@]}" "$option"
done
for option in --reflections=1 --diffuse=4; do
    wrong "method raycast does not use ${option%%=*} (methods that do: raytrace)" "${force[@]}" \
        --method raycast "$option"
done
wrong 'expected a whole number from 0 to 100' "${force[@]}" --method raytrace --reflections 101
wrong 'expected a whole number from 0 to 1024' "${force[@]}" --method raytrace --diffuse -1
wrong 'method exact does not use --cr (methods that do: cannonball)' "${force[@]}" --cr 1
wrong 'method exact does not use --area (methods that do: cannonball)' "${force[@]}" --area 1
wrong 'method exact does not use --plates (methods that do: nplate)' "${force[@]}" --plates x
ball=(force --method cannonball --cr 1.2 --area 3 --az 0 --el 0)
plates=(force --method nplate --plates "$MODELS/cube.plates" --az 0 --el 0)
wrong 'method cannonball does not use --material' "${ball[@]}" --material a=0,0
wrong 'method cannonball does not use --unit' "${ball[@]}" --unit mm
wrong 'method cannonball does not use --reference' "${ball[@]}" --reference 0,0,1
wrong 'method nplate does not use --reference' "${plates[@]}" --reference 0,0,1
wrong 'method cannonball does not use OBJ files' "${ball[@]}" "$cube"
wrong 'method nplate does not use OBJ files' "${plates[@]}" "$cube"
wrong 'method cannonball gives no sums per material: --basis' "${ball[@]}" --basis
wrong 'method cannonball needs --cr CR and --area M2' force --method cannonball --cr 1 --az 0 --el 0
wrong 'method nplate needs --plates FILE' force --method nplate --az 0 --el 0
wrong 'method exact needs an OBJ file: MODEL.obj' force --az 0 --el 0
wrong '--az DEG --el DEG' force "$cube" --az 0

# Lattices.
ray=("${force[@]}" --method raycast)
wrong '--pixel and --grid exclude each other' "${ray[@]}" --pixel .1 --grid 8
wrong '--pixel and --window exclude each other' "${ray[@]}" --pixel .1 --window 0,1,0,1
wrong '--columns needs --window' "${ray[@]}" --columns 8
wrong '--rows needs --window' "${ray[@]}" --rows 8
wrong '--columns and --rows go together' "${ray[@]}" --window 0,1,0,1 --columns 8
wrong '--grid and --columns exclude each other' "${ray[@]}" --window 0,1,0,1 --columns 8 --rows 8 \
    --grid 8
wrong '--seed would be without effect' "${ray[@]}" --window 0,1,0,1 --seed 1

# Tables.
table=(table "$cube" -o t.nc)
wrong 'no output: -o FILE.nc' table "$cube"
wrong 't.csv: unknown ending (formats of tables: .nc, .spo, .txt)' table "$cube" -o t.csv
wrong 'unknown ending' table "$cube" -o nc
wrong 't.nc is given twice' "${table[@]}" -o t.nc
wrong './t.nc is given twice' "${table[@]}" -o ./t.nc
wrong 't.nc is given twice' "${table[@]}" -o "$PWD/t.nc"
wrong '--title: byte 4 is not UTF-8' "${table[@]}" --title $'caf\xe9'
wrong '--title: byte 1 is not UTF-8' convert a.nc b.nc --title $'\xff'
wrong 'needs the mass of the spacecraft: --mass KG' "${table[@]}" -o t.txt
wrong '--step and --az-step exclude each other' "${table[@]}" --step 5 --az-step 5
wrong '7' "${table[@]}" --step 7
wrong '0.001' "${table[@]}" --step 0.001
wrong '100' "${table[@]}" --az-step 100 --el-step 10
wrong '--basis needs an output that keeps sums per material' table "$cube" -o t.spo --basis
wrong 'method cannonball gives no sums per material' table --method cannonball --cr 1 --area 1 \
    -o t.nc --basis
cp "$MODELS/cube.plates" plates.txt
wrong 'plates.txt is input and output at once' table --method nplate --plates plates.txt \
    -o plates.txt --mass 1
rm plates.txt

# Converting.
wrong 'expected two files, IN and OUT, found 1' convert a.nc
wrong 'expected two files, IN and OUT, found 3' convert a.nc b.nc c.nc
wrong 'a.csv: unknown ending' convert a.csv b.nc
wrong 'b.csv: unknown ending' convert a.nc b.csv

# Operands without a name.
wrong 'operand 1 is empty, expected the name of a file' force --az 30 --el 20 ''
wrong 'operand 2 is empty, expected the name of a file' info "$cube" ''
wrong 'operand 2 is empty' convert a.nc ''

# Info.
wrong 'nothing given: MODEL.obj, --plates FILE or a table' info
wrong 'stands alone' info --plates "$MODELS/cube.plates" "$cube"
wrong 'stands alone' info --plates "$MODELS/cube.plates" --unit mm

holds # usage errors leave no file
finish
