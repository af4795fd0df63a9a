# SPDX-License-Identifier: Apache-2.0
# Writes a C file that holds text files:
#   cmake -D OUTPUT=FILE.c -D HEADER=NAME.h -D TYPE=STRUCT -D PREFIX=srp_ -D TOP=DIR
#         -D INPUTS=A.vert.glsl,B.frag.glsl -P EmbedText.cmake
# Each becomes `const TYPE PREFIX_A_vert = {"path from TOP", text}`.
set(code "/* SPDX-License-Identifier: Apache-2.0 */\n/* Made by EmbedText.cmake; edit the files that it names. */\n")
string(APPEND code "#include \"${HEADER}\"\n")
string(REPLACE "," ";" INPUTS "${INPUTS}")
foreach(input IN LISTS INPUTS)
  get_filename_component(name ${input} NAME)
  string(REGEX REPLACE "\\.glsl$" "" name ${name})
  string(MAKE_C_IDENTIFIER ${name} name)
  file(RELATIVE_PATH place ${TOP} ${input})
  file(READ ${input} bytes HEX)
  string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(APPEND code "\nstatic const char ${name}_text[] = {\n${bytes}0};\n")
  string(APPEND code "const ${TYPE} ${PREFIX}${name} = {\"${place}\", ${name}_text};\n")
endforeach()
file(WRITE ${OUTPUT} "${code}")
