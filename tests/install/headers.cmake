# SPDX-License-Identifier: Apache-2.0
# Each public header compiles alone, as C11 and as C++17, without a warning.
#   cmake -D INCLUDE=... [-D DEPENDS=...] -D SCRATCH=... -D CC=... -D CXX=... -P headers.cmake
file(MAKE_DIRECTORY ${SCRATCH})
file(GLOB headers RELATIVE ${INCLUDE} ${INCLUDE}/srp/*.h ${INCLUDE}/srp/*/*.h)
if(NOT headers)
  message(FATAL_ERROR "no header in ${INCLUDE}")
endif()
set(needed "")
if(DEPENDS)
  set(needed -I ${DEPENDS})
endif()
set(warnings -Wall -Wextra -Wpedantic -Wshadow -Werror)
foreach(header IN LISTS headers)
  foreach(language c c++)
    file(WRITE ${SCRATCH}/alone.${language} "#include <${header}>\nextern int alone;\n")
    set(compiler ${CC} -std=c11)
    if(language STREQUAL "c++")
      set(compiler ${CXX} -std=c++17)
    endif()
    execute_process(
      COMMAND ${compiler} ${warnings} -fsyntax-only -I ${INCLUDE} ${needed} -x ${language}
              ${SCRATCH}/alone.${language}
      RESULT_VARIABLE status ERROR_VARIABLE message)
    if(NOT status EQUAL 0)
      message(SEND_ERROR "${header} alone as ${language}:\n${message}")
    endif()
  endforeach()
endforeach()
list(LENGTH headers count)
message(STATUS "${count} headers, each alone as C11 and as C++17")
