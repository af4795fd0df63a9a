# SPDX-License-Identifier: Apache-2.0
# The plugin exports what GMAT's loader asks for and nothing else, and links no GSL.
execute_process(COMMAND ${NM} -D --defined-only ${LIBRARY} OUTPUT_VARIABLE symbols
  COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL " [A-Za-z] [^\n]+" symbols "${symbols}")
list(TRANSFORM symbols REPLACE "^ [A-Za-z] " "")
list(SORT symbols)
if(NOT "${symbols}" STREQUAL "GetFactoryCount;GetFactoryPointer;SetMessageReceiver")
  message(SEND_ERROR "exported: ${symbols}")
endif()
execute_process(COMMAND ${READELF} -d ${LIBRARY} OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
if(dynamic MATCHES "libgsl|libplplot|libcyaml")
  message(SEND_ERROR "it links what a plugin under Apache-2.0 must not:\n${dynamic}")
endif()
if(NOT dynamic MATCHES "libGmatBase" OR NOT dynamic MATCHES "libnetcdf")
  message(SEND_ERROR "the check is blind:\n${dynamic}")
endif()
