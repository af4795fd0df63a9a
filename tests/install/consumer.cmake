# SPDX-License-Identifier: Apache-2.0
# Installs the build to a scratch prefix and builds a project outside the tree against it, through
# the CMake package and through pkg-config.
#   cmake -D BUILD=... -D SOURCE=... -D EXAMPLE=... -D MODEL=... -D SCRATCH=... -D CC=... -D CXX=... -D PKG_CONFIG=... -P ...
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${status}): ${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
set(prefix ${SCRATCH}/prefix)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})

run(${CMAKE_COMMAND} -S ${SOURCE} -B ${SCRATCH}/cmake -G Ninja -D CMAKE_C_COMPILER=${CC}
    -D CMAKE_CXX_COMPILER=${CXX} -D CMAKE_PREFIX_PATH=${prefix} -D EXAMPLE=${EXAMPLE})
run(${CMAKE_COMMAND} --build ${SCRATCH}/cmake)
foreach(program consumer_shared consumer_static consumer_cxx)
  run(${SCRATCH}/cmake/${program})
  message(STATUS "${program}: ${output}")
endforeach()
run(${SCRATCH}/cmake/example ${MODEL})
set(example_output "${output}")

file(GLOB_RECURSE pc ${prefix}/srpcore.pc)
get_filename_component(pc_directory ${pc} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${pc_directory})
get_filename_component(library_directory ${pc_directory} DIRECTORY)
set(ENV{LD_LIBRARY_PATH} ${library_directory})
run(${PKG_CONFIG} --cflags --libs srpcore)
separate_arguments(flags UNIX_COMMAND "${output}")
run(${CC} -std=c11 -o ${SCRATCH}/consumer_pc ${SOURCE}/consumer.c ${flags} -lm)
run(${SCRATCH}/consumer_pc)
message(STATUS "consumer_pc: ${output}")
run(${CC} -std=c11 -o ${SCRATCH}/example_pc ${EXAMPLE} ${flags} -lm)
run(${SCRATCH}/example_pc ${MODEL})
if(NOT output STREQUAL example_output OR NOT output MATCHES " 180\\.0   0\\.0000 ")
  message(FATAL_ERROR "the example says ${output}through pkg-config, ${example_output}through CMake")
endif()
message(STATUS "example:\n${output}")
