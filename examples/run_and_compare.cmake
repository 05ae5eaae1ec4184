# SPDX-License-Identifier: MIT

# cmake -DCOMMAND="program;argument;..." -DINPUT=file -DPRINTS="regex;..." -DWRITES="file;..." -P run_and_compare.cmake
# Fails unless the command returns 0, its standard output matches every expression and it writes the files.

if(WRITES)
  file(REMOVE ${WRITES})
endif()
execute_process(COMMAND ${COMMAND} INPUT_FILE ${INPUT} OUTPUT_VARIABLE output ERROR_VARIABLE errors RESULT_VARIABLE result)
message("${output}${errors}")
if(NOT result EQUAL 0)
  message(FATAL_ERROR "The exit code is ${result}")
endif()
foreach(expression IN LISTS PRINTS)
  if(NOT output MATCHES "${expression}")
    message(FATAL_ERROR "Not printed: ${expression}")
  endif()
endforeach()
foreach(file IN LISTS WRITES)
  if(NOT EXISTS ${CMAKE_CURRENT_BINARY_DIR}/${file})
    message(FATAL_ERROR "Not written: ${file}")
  endif()
endforeach()
