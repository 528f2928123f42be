# SPDX-License-Identifier: Apache-2.0
# What every target of the tree shares: warnings, sanitizers, output folders, run paths, and the two ways to
# declare a plugin and a test.

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(TANDEM_PLUGIN_DIR ${CMAKE_INSTALL_LIBDIR}/tandem/plugins)

# Relative run paths, so that the installed tree works from any prefix.
set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")

# g++ 12 sees overlaps in std::string's operator+ that are not there (GCC bug 105329).
add_compile_options(-Wall -Wextra $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
# __FILE__ (omniORB's generated code keeps it) tells nobody where the tree was built.
add_compile_options(-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/= -fmacro-prefix-map=${PROJECT_BINARY_DIR}/=)
if(TANDEM_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()
if(TANDEM_SANITIZE)
  add_compile_options(-fsanitize=${TANDEM_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${TANDEM_SANITIZE})
  if(TANDEM_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize-recover=undefined)
  endif()
endif()
if(TANDEM_COVERAGE)
  add_compile_options(--coverage)
  add_compile_definitions(TANDEM_COVERAGE)
  add_link_options(--coverage)
endif()

# tandem_add_plugin(NAME opros|rtm SOURCES a.cpp ... [LIBRARIES x ...])
# A component library NAME.so in plugins/MODEL, linked with that model's component library only.
function(tandem_add_plugin name model)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_library(plugin_${model}_${name} MODULE ${arg_SOURCES})
  target_link_libraries(plugin_${model}_${name} PRIVATE tandem_${model} ${arg_LIBRARIES})
  set_target_properties(plugin_${model}_${name} PROPERTIES
    PREFIX "" OUTPUT_NAME ${name}
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/plugins/${model}
    INSTALL_RPATH "$ORIGIN/../../..")
  install(TARGETS plugin_${model}_${name} LIBRARY DESTINATION ${TANDEM_PLUGIN_DIR}/${model})
endfunction()

# tandem_add_test(NAME SOURCES a.cpp ... [LIBRARIES x ...] [ARGUMENTS_TO add_test properties ...])
# A Catch2 executable test_NAME; each TEST_CASE becomes one ctest test.
function(tandem_add_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES;PROPERTIES" ${ARGN})
  add_executable(test_${name} ${arg_SOURCES})
  target_link_libraries(test_${name} PRIVATE tandem_test_main ${arg_LIBRARIES})
  set_target_properties(test_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  catch_discover_tests(test_${name} TEST_PREFIX "${name}: " DISCOVERY_MODE PRE_TEST
    PROPERTIES TIMEOUT 300 ${arg_PROPERTIES})
endfunction()
