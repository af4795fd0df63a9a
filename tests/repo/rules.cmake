# SPDX-License-Identifier: Apache-2.0
# Rules of the house that a compiler does not know (CONTRIBUTING.md).
#   cmake -D ROOT=... -P rules.cmake

# Fails on lines of `files` that match `pattern`; `why` is the rule.
function(forbid pattern why)
  foreach(file IN LISTS ARGN)
    file(STRINGS ${file} hits REGEX "${pattern}")
    foreach(hit IN LISTS hits)
      file(RELATIVE_PATH name ${ROOT} ${file})
      message(SEND_ERROR "${name}: ${why}\n  ${hit}")
    endforeach()
  endforeach()
endfunction()

file(GLOB core ${ROOT}/srpcore/src/*.[ch] ${ROOT}/srpcore/include/srp/*.h)
set(portable ${core})
list(FILTER portable EXCLUDE REGEX "/platform\\.c$")
list(LENGTH core count)
if(count LESS 20)
  message(FATAL_ERROR "only ${count} files of srpcore found, the check is blind")
endif()

forbid("^ *# *include *[<\"](apps|gl|orbit|plugin|bench|models|tests)/"
       "srpcore depends on nothing above it" ${core})
forbid("^ *# *include *<(gsl|GL|EGL|embree[0-9]*|mpi)[/.]"
       "srpcore links neither GSL nor a graphics library" ${core})
file(GLOB gl ${ROOT}/gl/src/*.[ch] ${ROOT}/gl/include/srp/*.h)
list(APPEND portable ${gl})
forbid("^ *# *include *[<\"](apps|orbit|plugin|bench|models|tests)/" "gl depends on srpcore alone" ${gl})
forbid("^ *# *include *<(gsl|embree[0-9]*|mpi|X11)[/.]" "gl links no GSL and no window system" ${gl})

forbid("^ *# *include *<(unistd|fcntl|dirent|pthread|signal|dlfcn|sched|locale|xlocale|sys/[a-z]+)\\.h>"
       "what only POSIX or glibc has is in platform.c" ${portable})
forbid("(^|[^a-z_])(printf|puts|putchar|perror|exit|abort|_Exit|assert) *\\("
       "a library does not print or end the program" ${core} ${gl})
forbid("(^|[^a-z_/])(std(out|err))([^a-z_]|$)" "a library does not print" ${core} ${gl})

file(GLOB orbit ${ROOT}/orbit/src/*.[ch] ${ROOT}/orbit/include/srp/orbit/*.h)
forbid("^ *# *include *[<\"](apps|gl|plugin|bench|models|tests)/"
       "orbit depends on srpcore alone" ${orbit})
forbid("(^|[^a-z_])(printf|puts|putchar|perror|exit|abort|_Exit|assert) *\\("
       "a library does not print or end the program" ${orbit})
forbid("(^|[^a-z_/])(std(out|err))([^a-z_]|$)" "a library does not print" ${orbit})

file(GLOB plugin ${ROOT}/plugin/*.cpp ${ROOT}/plugin/*.hpp)
forbid("^ *# *include *[<\"](apps|gl|orbit|bench|models|tests|srp/orbit|srp/gl)[/.]"
       "plugin depends on srpcore alone" ${plugin})
forbid("^ *# *include *<gsl/" "plugin links no GSL" ${plugin})

file(GLOB_RECURSE sources ${ROOT}/plugin/*.[ch]pp ${ROOT}/tests/*.hpp
  ${ROOT}/srpcore/*.[ch] ${ROOT}/gl/*.[ch] ${ROOT}/orbit/*.[ch] ${ROOT}/gl/*.glsl ${ROOT}/apps/*.[ch] ${ROOT}/bench/*.[ch] ${ROOT}/models/*.[ch]
  ${ROOT}/tests/*.[ch] ${ROOT}/tests/*.cpp)
foreach(file IN LISTS sources)
  file(STRINGS ${file} head LIMIT_COUNT 1)
  if(NOT head MATCHES "SPDX-License-Identifier: Apache-2.0")
    file(RELATIVE_PATH name ${ROOT} ${file})
    message(SEND_ERROR "${name}: the first line does not name the licence")
  endif()
endforeach()
list(LENGTH sources count)
message(STATUS "${count} source files follow the rules")

# What a test or a run leaves in the root is easily added to a commit.
find_program(GIT git)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${ROOT} ls-files OUTPUT_VARIABLE tracked
    RESULT_VARIABLE status ERROR_QUIET)
  string(REPLACE "\n" ";" tracked "${tracked}")
  foreach(file IN LISTS tracked)
    if(status EQUAL 0 AND NOT file MATCHES "/|^\\.|\\.md$|^LICENSE$|^CMake(Lists\\.txt|Presets\\.json)$"
       AND NOT file STREQUAL "")
      message(SEND_ERROR "${file}: no file of the root")
    endif()
  endforeach()
endif()
