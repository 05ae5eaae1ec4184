# SPDX-License-Identifier: MIT

# Compiles a wrong program and looks for its sentences, those of its comments "// error: ...", in what the compiler says.

separate_arguments(options NATIVE_COMMAND "${OPTIONS}")
file(STRINGS ${FLAGS} flags)
file(READ ${PROGRAM} program)
string(REGEX MATCHALL "// error: [^\n]*(\n *// [^\n]*)*" comments "${program}")
execute_process(COMMAND ${COMPILER} ${options} ${flags} -fsyntax-only ${PROGRAM}
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(result EQUAL 0)
  message(SEND_ERROR "The program compiles.")
endif()

string(REGEX MATCH "error: [^\n]*" first_error "${output}")
set(first_is_a_sentence FALSE)
foreach(comment IN LISTS comments)
  string(REGEX REPLACE "\n *// " " " sentence "${comment}")
  string(REPLACE "// error: " "" sentence "${sentence}")
  string(FIND "${output}" "${sentence}" place)
  if(place EQUAL -1)
    message(SEND_ERROR "The compiler does not say: ${sentence}")
  endif()
  string(FIND "${first_error}" "${sentence}" place)
  if(NOT place EQUAL -1)
    set(first_is_a_sentence TRUE)
  endif()
endforeach()
if(NOT first_is_a_sentence)
  message(SEND_ERROR "The first error is another one: ${first_error}")
endif()
