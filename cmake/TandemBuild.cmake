# SPDX-License-Identifier: Apache-2.0
# What every target of the tree shares: warnings, sanitizers, output folders, run paths, and the two ways to
# declare a plugin and a test.

# ccache keeps objects between builds. It can cache what uses a precompiled header only if told that no macro in front
# of it and no time of day matters, which holds here. It takes the compiler's list of headers: otherwise it would preprocess each
# file that it does not know once more.
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  set(CMAKE_CXX_COMPILER_LAUNCHER
    env CCACHE_DEPEND=1 CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
endif()

# One compiler per processor. Ninja starts two more, which share the processors' caches with the others: on two processors the
# whole build then takes a quarter longer, in CPU seconds, too.
if(PROJECT_IS_TOP_LEVEL)
  include(ProcessorCount)
  ProcessorCount(processors)
  if(processors GREATER 0)
    set_property(GLOBAL APPEND PROPERTY JOB_POOLS compilers=${processors})
    set(CMAKE_JOB_POOL_COMPILE compilers)
    set(CMAKE_JOB_POOL_LINK compilers)
    set(CMAKE_JOB_POOL_PRECOMPILE_HEADER compilers)
  endif()
endif()

# Most of the compile time is headers (CORBA, CLI11, Catch2), so files of one library are compiled together. The
# preset dev compiles each file by itself, which shows a missing #include.
set(CMAKE_UNITY_BUILD ${TANDEM_UNITY_BUILD})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 32)
if(TANDEM_UNITY_BUILD)
  # g++ takes a file that is included for a header, where types of an anonymous namespace would be a mistake.
  add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
endif()

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(TANDEM_PLUGIN_DIR ${CMAKE_INSTALL_LIBDIR}/tandem/plugins)

# Relative run paths, so that the installed tree works from any prefix.
set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")

# What is computed in each cycle asks for more by tandem_optimize(), what each message passes through by tandem_message_path().
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")

# g++ collects its garbage once in a file instead of many times, which takes 400 MB for the largest one.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(--param=ggc-min-expand=300 --param=ggc-min-heapsize=400000)
endif()

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

# Functions are found when a program starts: a robot does not wait for the dynamic linker at the first call of each.
add_link_options(-Wl,-z,now)

# tandem_optimize(TARGET...)
function(tandem_optimize)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O3>)
  endforeach()
endfunction()

# tandem_message_path(TARGET...)
# For what each message passes through, where instructions, cache lines and pages of code count: calls of other libraries
# have no stub, calls within a library go straight to the function, and virtual calls are made without a guess.
function(tandem_message_path)
  tandem_message_path_options(${ARGN})
  if(NOT TARGET tandem_message_path_headers)
    tandem_add_library_headers(tandem_message_path_headers)
    tandem_message_path_options(tandem_message_path_headers)
  endif()
  tandem_use_library_headers(tandem_message_path_headers ${ARGN})
endfunction()
function(tandem_message_path_options)
  tandem_plugin_path(${ARGN})
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-devirtualize-speculatively>)
  endforeach()
endfunction()

# tandem_add_library_headers(NAME), tandem_use_library_headers(NAME TARGET...)
# What many targets include of the C++ library is compiled once for all that have the options of NAME: a function in a precompiled
# header is compiled with the header's.
function(tandem_add_library_headers name)
  add_library(${name} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled_header.cpp)
  if(TANDEM_UNITY_BUILD)
    target_precompile_headers(${name} PRIVATE <algorithm> <atomic> <chrono> <condition_variable> <filesystem> <functional> <map>
      <memory> <mutex> <optional> <set> <sstream> <string> <thread> <vector>)
  endif()
endfunction()
function(tandem_use_library_headers name)
  if(TANDEM_UNITY_BUILD)
    foreach(target ${ARGN})
      target_precompile_headers(${target} REUSE_FROM ${name})
      tandem_quiet_precompiled_headers(${target})
    endforeach()
  endif()
endfunction()

# tandem_quiet_precompiled_headers(TARGET)
# With a precompiled header g++ 12 warns of overflows in std::string's operator+, too, that are not there (GCC bug 105329). The
# preset dev, which has none, shows those that are real.
function(tandem_quiet_precompiled_headers target)
  target_compile_options(${target} PRIVATE "$<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow;-Wno-array-bounds>")
endfunction()

# tandem_plugin_path(TARGET...)
# The same for plugins, where a guess is mostly right: they call their own classes. A function begins with a cache line: else
# most take one more, depending on where the linker puts them.
function(tandem_plugin_path)
  tandem_optimize(${ARGN})
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE -fno-plt -fno-semantic-interposition -falign-functions=64)
  endforeach()
endfunction()

# tandem_sources(OUT FOLDER...)
# The .cpp files of the named folders, below the current one. A new file needs no line in a CMakeLists.txt.
function(tandem_sources out)
  set(found "")
  foreach(folder ${ARGN})
    file(REAL_PATH ${folder} absolute BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    file(GLOB files CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} ${absolute}/*.cpp)
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

# tandem_add_plugin(NAME opros|rtm SOURCES a.cpp ... [LIBRARIES x ...] [PRECOMPILED])
# A component library NAME.so in plugins/MODEL, linked with that model's component library only. PRECOMPILED, for an RTC: with
# the headers of the API that are compiled once for all who say so, which takes longer than compiling one component.
function(tandem_add_plugin name model)
  cmake_parse_arguments(arg "PRECOMPILED" "" "SOURCES;LIBRARIES" ${ARGN})
  add_library(plugin_${model}_${name} MODULE ${arg_SOURCES})
  target_link_libraries(plugin_${model}_${name} PRIVATE tandem_${model} ${arg_LIBRARIES})
  target_link_options(plugin_${model}_${name} PRIVATE -Wl,-Bsymbolic-functions)
  tandem_plugin_path(plugin_${model}_${name})
  if(TANDEM_UNITY_BUILD AND arg_PRECOMPILED)
    target_precompile_headers(plugin_${model}_${name} REUSE_FROM tandem_rtc_headers)
  endif()
  set_target_properties(plugin_${model}_${name} PROPERTIES
    PREFIX "" OUTPUT_NAME ${name}
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/plugins/${model}
    INSTALL_RPATH "$ORIGIN/../../..")
  tandem_install(plugin_${model}_${name} LIBRARY DESTINATION ${TANDEM_PLUGIN_DIR}/${model})
endfunction()

# tandem_use_test_headers(TARGET LIBRARY...)
# The precompiled header of tests: with JSON if that is one of the libraries.
function(tandem_use_test_headers target)
  if(TANDEM_UNITY_BUILD AND "nlohmann_json::nlohmann_json" IN_LIST ARGN)
    target_precompile_headers(${target} REUSE_FROM tandem_test_json)
  elseif(TANDEM_UNITY_BUILD)
    target_precompile_headers(${target} REUSE_FROM tandem_test_headers)
  endif()
endfunction()

# tandem_add_test(NAME SOURCES a.cpp ... [PROGRAM x] [LIBRARIES x ...] [PROPERTIES ctest properties ...] [COMPUTES] [SOME_ALONE])
# A Catch2 executable test_NAME; each TEST_CASE becomes one ctest test. One that uses JSON names its library. COMPUTES is
# for a test that would take minutes without optimization. With SOME_ALONE nothing else runs beside a TEST_CASE that has the
# tag [alone].
# With PROGRAM the sources are a part of the executable test_PROGRAM, which tandem_add_test_program() has made.
function(tandem_add_test name)
  cmake_parse_arguments(arg "COMPUTES;SOME_ALONE" "PROGRAM" "SOURCES;LIBRARIES;PROPERTIES" ${ARGN})
  set(properties TIMEOUT 300 ${arg_PROPERTIES})
  if(arg_PROGRAM)
    tandem_add_test_part(${arg_PROGRAM} ${arg_SOURCES})
    target_link_libraries(test_${arg_PROGRAM} PRIVATE ${arg_LIBRARIES})
    list(TRANSFORM arg_SOURCES REPLACE "(.*/)?(.*)[.]cpp" "[#\\2]" OUTPUT_VARIABLE files) # Catch2's tags of files, by -#
    list(JOIN files "," files)
    catch_discover_tests(test_${arg_PROGRAM} TEST_SPEC -\# ${files} TEST_PREFIX "${name}: " DISCOVERY_MODE PRE_TEST
      PROPERTIES ${properties})
    return()
  endif()
  tandem_add_test_program(${name} SOURCES ${arg_SOURCES} LIBRARIES ${arg_LIBRARIES} COMPUTES ${arg_COMPUTES})
  set(rest "")
  if(arg_SOME_ALONE)
    catch_discover_tests(test_${name} TEST_SPEC [alone] TEST_PREFIX "${name}: " DISCOVERY_MODE PRE_TEST
      PROPERTIES ${properties} RUN_SERIAL TRUE)
    set(rest TEST_SPEC ~[alone])
  endif()
  catch_discover_tests(test_${name} ${rest} TEST_PREFIX "${name}: " DISCOVERY_MODE PRE_TEST PROPERTIES ${properties})
endfunction()

# tandem_add_test_program(NAME [SOURCES a.cpp ...] [LIBRARIES x ...] [COMPUTES ON])
# The executable of a test. For tests that include much the same, which is then compiled once: each adds its files by
# tandem_add_test(... PROGRAM NAME), in the same CMakeLists.txt, and has its own name and properties in ctest as before.
function(tandem_add_test_program name)
  cmake_parse_arguments(arg "" "COMPUTES" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(test_${name} ${arg_SOURCES})
  target_link_libraries(test_${name} PRIVATE Catch2::Catch2WithMain ${arg_LIBRARIES})
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR})
  if(arg_COMPUTES)
    target_compile_options(test_${name} PRIVATE -O1)
  else() # g++ uses a precompiled header only for the same level of optimization
    tandem_use_test_headers(test_${name} ${arg_LIBRARIES})
  endif()
  set_target_properties(test_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
endfunction()

# Adds sources to a program; the tests of a part are found by the names of its files, so that two of one name would be mixed up.
function(tandem_add_test_part program)
  get_target_property(known test_${program} SOURCES)
  foreach(source ${ARGN})
    get_filename_component(file ${source} NAME)
    if(known MATCHES "(^|[/;])${file}(;|$)")
      message(FATAL_ERROR "test_${program} has another file named ${file}")
    endif()
  endforeach()
  target_sources(test_${program} PRIVATE ${ARGN})
endfunction()
