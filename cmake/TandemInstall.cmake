# SPDX-License-Identifier: Apache-2.0
# The installation of a partly built tree: what is built is installed, and one line at the end
# names the rest.

# tandem_install(TARGET... [what install(TARGETS) takes])
# Like install(TARGETS), but skips targets that have not been built.
function(tandem_install)
  install(TARGETS ${ARGN} OPTIONAL)
  cmake_parse_arguments(arg "" "COMPONENT;DESTINATION;EXPORT" "RUNTIME;LIBRARY" ${ARGN})
  # COMPONENT may follow an artifact's kind: then it is among that one's arguments.
  string(REGEX MATCH "COMPONENT;([a-z]+)" ignored "${ARGN}")
  set(component ${CMAKE_MATCH_1})
  foreach(target ${arg_UNPARSED_ARGUMENTS})
    set_property(GLOBAL APPEND PROPERTY TANDEM_INSTALLED_FILES "${component}|$<TARGET_FILE:${target}>")
  endforeach()
endfunction()

# tandem_name_missing_at_install()
# To be called after the last tandem_install(). Prints at installation which targets were not built, if any.
function(tandem_name_missing_at_install)
  get_property(files GLOBAL PROPERTY TANDEM_INSTALLED_FILES)
  list(REMOVE_DUPLICATES files)
  install(CODE "
    set(missing \"\")
    foreach(entry IN ITEMS ${files})
      string(REGEX MATCH \"^([^|]*)\\\\|(.*)$\" ignored \"\${entry}\")
      set(component \"\${CMAKE_MATCH_1}\")
      set(file \"\${CMAKE_MATCH_2}\")
      if((NOT CMAKE_INSTALL_COMPONENT OR CMAKE_INSTALL_COMPONENT STREQUAL component) AND NOT EXISTS \"\${file}\")
        get_filename_component(name \"\${file}\" NAME)
        list(APPEND missing \${name})
      endif()
    endforeach()
    if(missing)
      list(REMOVE_DUPLICATES missing)
      list(JOIN missing \", \" missing)
      message(STATUS \"Not built, so not installed: \${missing} (cmake --build ${PROJECT_BINARY_DIR} builds all)\")
    endif()" ALL_COMPONENTS)
endfunction()
