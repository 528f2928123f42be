# SPDX-License-Identifier: Apache-2.0
# CPack runs this before it installs anything. It installs the whole tree, stripped, into debian/stage of the build tree, and
# adds what only the packages have: man pages, the service, rules and limits. It refuses a tree that is built in part.
set(stage ${CPACK_TANDEM_BUILD}/debian/stage)
set(debian ${CPACK_TANDEM_SOURCE}/cmake/debian)
file(REMOVE_RECURSE ${stage})
unset(ENV{DESTDIR}) # CPack sets it for its own installation
execute_process(COMMAND ${CMAKE_COMMAND} --install ${CPACK_TANDEM_BUILD} --strip --prefix ${stage}/usr
  OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "cpack: the tree cannot be installed into the packages: ${said}")
elseif(said MATCHES "Not built, so not installed: [^\n]*")
  message(FATAL_ERROR "cpack: ${CMAKE_MATCH_0}; the packages need all of it")
endif()
file(COPY ${debian}/files/ DESTINATION ${stage})
execute_process(COMMAND ${debian}/write_man_pages.sh ${stage}/usr ${CPACK_PACKAGE_VERSION} ${CPACK_TANDEM_EMULATOR}
  RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "cpack: the man pages could not be written")
endif()

# In /usr the linker finds our libraries by itself, and scripts name the interpreter that the packages depend on.
file(GLOB_RECURSE files LIST_DIRECTORIES false ${stage}/usr/bin/* ${stage}/usr/*.so ${stage}/usr/*.py)
foreach(file IN LISTS files)
  file(READ ${file} first LIMIT 4 HEX)
  if(IS_SYMLINK ${file})
    continue()
  elseif(first STREQUAL "7f454c46")
    file(RPATH_REMOVE FILE ${file})
  else()
    execute_process(COMMAND sed -i "1s|^#!/usr/bin/env python3|#!/usr/bin/python3|" ${file} COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()

# What every package has in its folder of documentation.
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND git -C ${CPACK_TANDEM_SOURCE} log -1 --format=%ct OUTPUT_VARIABLE time ERROR_QUIET
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(time)
    set(ENV{SOURCE_DATE_EPOCH} ${time})
  endif()
endif()
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(doc ${CPACK_TANDEM_BUILD}/debian/doc)
file(REMOVE_RECURSE ${doc})
cmake_host_system_information(RESULT release QUERY DISTRIB_VERSION_CODENAME) # for example bookworm
if(NOT release)
  set(release unstable)
endif()
file(WRITE ${doc}/changelog.Debian "tandem (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) ${release}; urgency=medium

  * Version ${CPACK_PACKAGE_VERSION}: changelog.gz says what is new.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
file(COPY_FILE ${CPACK_TANDEM_SOURCE}/CHANGELOG.md ${doc}/changelog)
execute_process(COMMAND gzip -9n ${doc}/changelog ${doc}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
file(READ ${debian}/copyright copyright)
# Adds the license of a library of the monitor's page, if npm has installed it.
function(add_library_license file files owner short)
  set(path ${stage}/usr/share/tandem/monitor/lib/${file})
  if(NOT EXISTS ${path})
    return()
  endif()
  file(READ ${path} license)
  string(REGEX REPLACE "\r" "" license "${license}")
  string(REGEX REPLACE "\n[ \t]*\n" "\n.\n" license "${license}")
  string(REGEX REPLACE "\n[ \t]*\n" "\n.\n" license "${license}")
  string(STRIP "${license}" license)
  string(REPLACE "\n" "\n " license "${license}")
  set(copyright "${copyright}
Files: usr/share/tandem/monitor/lib/${files}
Copyright: ${owner}
License: ${short}
 ${license}
" PARENT_SCOPE)
  file(REMOVE ${path})
endfunction()
add_library_license(LICENSE.md elk* "2017 Ulf Rüegg, Kiel University and others" EPL-2.0)
add_library_license(uPlot-LICENSE uPlot* "2022 Leon Sorokin" Expat)
file(WRITE ${doc}/copyright "${copyright}")
