# SPDX-License-Identifier: MIT

# Each source file that the manual or the README names in `backticks` is one of the repository.

file(GLOB_RECURSE sources ${ROOT}/include/* ${ROOT}/src/* ${ROOT}/test/* ${ROOT}/benchmark/* ${ROOT}/examples/*.h
  ${ROOT}/examples/*.cpp ${ROOT}/python/*.h ${ROOT}/python/*.cpp ${ROOT}/python/*.py ${ROOT}/doc/*)
file(GLOB pages ${ROOT}/doc/RW_segmentation/*.md ${ROOT}/README.md)
foreach(page IN LISTS pages)
  file(READ ${page} text)
  string(REGEX MATCHALL "`[A-Za-z0-9_/-]+\\.(h|cpp|py)[`:,]" names "${text}")
  foreach(name IN LISTS names)
    string(REGEX REPLACE "[`:,]" "" name "${name}")
    string(REGEX REPLACE "([.])" "\\\\\\1" pattern "/${name}$")
    if(NOT sources MATCHES "${pattern}" AND NOT sources MATCHES "/${name};")
      message(SEND_ERROR "${page} names ${name}, which does not exist.")
    endif()
  endforeach()
endforeach()
