# SPDX-License-Identifier: Apache-2.0
# What every target shares: warnings, sanitizers, output folders, run paths, and how a plugin and a test are declared.

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(TANDEM_PLUGIN_DIR ${CMAKE_INSTALL_LIBDIR}/tandem/plugins)

# Relative run paths, so that the installed tree works from any prefix.
set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")

set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
add_compile_options(-Wall -Wextra)
# Keeps the path of the tree out of __FILE__, which omniORB's generated code contains.
add_compile_options(-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/= -fmacro-prefix-map=${PROJECT_BINARY_DIR}/=)
if(TANDEM_SANITIZE)
  add_compile_options(-fsanitize=${TANDEM_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${TANDEM_SANITIZE})
endif()
if(TANDEM_COVERAGE)
  add_compile_options(--coverage)
  add_compile_definitions(TANDEM_COVERAGE)
  add_link_options(--coverage)
endif()

# The dynamic linker binds all functions when a program starts, and none at its first call within a robot's cycle.
add_link_options(-Wl,-z,now)

# tandem_message_path(TARGET...)
# For targets that each message passes through. -O3 and direct calls save instructions; calls of other libraries have no stub;
# functions begin with a cache line, which saves up to 6 lines for a message (tandem-bench, path). With -O3, GCC 12 warns of
# overlaps in operator+ of strings that are not there (GCC bug 105329).
function(tandem_message_path)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O3> -fno-plt -fno-semantic-interposition -falign-functions=64
      $<$<CXX_COMPILER_ID:GNU>:-fno-devirtualize-speculatively -Wno-restrict>)
  endforeach()
endfunction()

# tandem_sources(OUT FOLDER...)
# Sets OUT to the .cpp files of the folders. A new file needs no line in a CMakeLists.txt.
function(tandem_sources out)
  set(found "")
  foreach(folder ${ARGN})
    file(GLOB files CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} ${folder}/*.cpp)
    if(NOT files)
      message(FATAL_ERROR "tandem_sources: ${CMAKE_CURRENT_SOURCE_DIR}/${folder} has no .cpp file")
    endif()
    list(APPEND found ${files})
  endforeach()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# tandem_add_aliases(FOLDER)
# Gives the libraries and programs of the folder and of those below it the names that an installed package has:
# tandem_shm is Tandem::shm, opros_host is Tandem::opros_host.
function(tandem_add_aliases folder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    string(REGEX REPLACE "^tandem[_-]" "" name ${target})
    if(type STREQUAL "EXECUTABLE")
      add_executable(Tandem::${name} ALIAS ${target})
    elseif(type MATCHES "^(STATIC|SHARED|OBJECT|INTERFACE)_LIBRARY$")
      add_library(Tandem::${name} ALIAS ${target})
    endif()
  endforeach()
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(below ${folders})
    tandem_add_aliases(${below})
  endforeach()
endfunction()

# tandem_add_plugin(NAME opros|rtm SOURCES a.cpp ... [LIBRARIES x ...])
# A component library NAME.so in plugins/MODEL, linked with that model's component library only.
function(tandem_add_plugin name model)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_library(plugin_${model}_${name} MODULE ${arg_SOURCES})
  target_link_libraries(plugin_${model}_${name} PRIVATE tandem_${model} ${arg_LIBRARIES})
  target_link_options(plugin_${model}_${name} PRIVATE -Wl,-Bsymbolic-functions)
  tandem_message_path(plugin_${model}_${name})
  set_target_properties(plugin_${model}_${name} PROPERTIES
    PREFIX "" OUTPUT_NAME ${name}
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/plugins/${model}
    INSTALL_RPATH "$ORIGIN/../../..")
  tandem_install(plugin_${model}_${name} LIBRARY DESTINATION ${TANDEM_PLUGIN_DIR}/${model})
endfunction()

# tandem_add_test(NAME SOURCES a.cpp ... [LIBRARIES x ...] [PROPERTIES ctest properties ...] [SOME_ALONE])
# A Catch2 executable test_NAME; each TEST_CASE becomes one ctest test. With SOME_ALONE nothing else runs beside a TEST_CASE
# that has the tag [alone]. A TEST_CASE that says TANDEM_SKIP is skipped. Without -w NoTests, Catch2 2 succeeds with a name that
# it does not find; Catch2 3 fails by itself.
function(tandem_add_test name)
  cmake_parse_arguments(arg "SOME_ALONE" "" "SOURCES;LIBRARIES;PROPERTIES" ${ARGN})
  add_executable(test_${name} ${arg_SOURCES})
  target_link_libraries(test_${name} PRIVATE Catch2::Catch2WithMain tandem_test_skips ${arg_LIBRARIES})
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR})
  set_target_properties(test_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  set(options TEST_PREFIX "${name}: " DISCOVERY_MODE PRE_TEST)
  if(Catch2_VERSION VERSION_LESS 3)
    list(APPEND options EXTRA_ARGS -w NoTests)
  endif()
  list(APPEND options PROPERTIES TIMEOUT 300 SKIP_REGULAR_EXPRESSION tandem-test-skipped: ${arg_PROPERTIES})
  if(arg_SOME_ALONE)
    catch_discover_tests(test_${name} TEST_SPEC [alone] ${options} RUN_SERIAL TRUE)
    catch_discover_tests(test_${name} TEST_SPEC ~[alone] ${options})
  else()
    catch_discover_tests(test_${name} ${options})
  endif()
endfunction()
