# SPDX-License-Identifier: Apache-2.0
# Fails unless the generator writes exactly the files that are kept in models/.
#   cmake -D GENERATOR=... -D KEPT=... -D SCRATCH=... -P drift.cmake
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})
execute_process(COMMAND ${GENERATOR} ${SCRATCH} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${GENERATOR} failed: ${status}")
endif()

file(GLOB made RELATIVE ${SCRATCH} ${SCRATCH}/*)
file(GLOB kept RELATIVE ${KEPT} ${KEPT}/*.obj ${KEPT}/*.mtl ${KEPT}/*.plates)
if(NOT made STREQUAL kept)
  message(FATAL_ERROR "files differ\n  made: ${made}\n  kept: ${kept}")
endif()
foreach(file IN LISTS made)
  file(SHA256 ${SCRATCH}/${file} made_hash)
  file(SHA256 ${KEPT}/${file} kept_hash)
  if(NOT made_hash STREQUAL kept_hash)
    message(FATAL_ERROR "models/${file} is not what the generator writes; "
                        "run `cmake --build --preset dev --target models` and look at the difference")
  endif()
endforeach()
list(LENGTH made count)
message(STATUS "${count} files, all as kept")
