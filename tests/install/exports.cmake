# SPDX-License-Identifier: Apache-2.0
# Every symbol that the libraries show to others begins with srp_, and the shared one is linked to
# no GSL, which is under another licence.
#   cmake -D SHARED=... -D STATIC=... -D NM=... -P exports.cmake
function(check_symbols library)
  execute_process(COMMAND ${NM} ${ARGN} -g --defined-only --format=posix ${library}
    RESULT_VARIABLE status OUTPUT_VARIABLE table ERROR_VARIABLE message)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${NM} ${library}: ${message}")
  endif()
  string(REGEX MATCHALL "[^\n]+\n" lines "${table}")
  set(count 0)
  foreach(line IN LISTS lines)
    if(line MATCHES "^([^ ]+) [A-Za-z] ")
      set(symbol ${CMAKE_MATCH_1})
      if(NOT symbol MATCHES "^srp_")
        message(SEND_ERROR "${library} exports ${symbol}")
      endif()
      math(EXPR count "${count} + 1")
    endif()
  endforeach()
  if(count LESS 20)
    message(SEND_ERROR "${library}: only ${count} symbols found, the check is blind")
  endif()
  message(STATUS "${library}: ${count} symbols, all srp_")
endfunction()

check_symbols(${SHARED} -D)
check_symbols(${STATIC})

execute_process(COMMAND ldd ${SHARED} RESULT_VARIABLE status OUTPUT_VARIABLE needed)
if(NOT status EQUAL 0 OR NOT needed MATCHES "libc\\.so")
  message(FATAL_ERROR "ldd ${SHARED} says nothing useful: ${needed}")
endif()
if(needed MATCHES "libgsl")
  message(FATAL_ERROR "${SHARED} is linked to GSL:\n${needed}")
endif()
message(STATUS "no GSL among the libraries that it is linked to")
