# SPDX-License-Identifier: Apache-2.0
# Run by CPack once for each package, with `package`, `build` and `libdir`: moves the files that the package's list names
# from the stage into the package. Each line of a list is a pattern below /, a folder stands for all that is in it.
set(stage ${build}/debian/stage)
set(root $ENV{DESTDIR})
if(NOT EXISTS ${stage} OR NOT root OR NOT CMAKE_INSTALL_PREFIX STREQUAL /usr)
  message(FATAL_ERROR "component ${package} is a Debian package: cpack -G DEB makes it")
endif()
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/install/${package} patterns REGEX "^[^#]")
foreach(pattern IN LISTS patterns)
  string(CONFIGURE "${pattern}" pattern @ONLY)
  file(GLOB found RELATIVE ${stage} ${stage}/${pattern})
  if(NOT found)
    message(FATAL_ERROR "cpack: nothing to install is named ${pattern}; cmake/debian/install/${package} asks for it")
  endif()
  foreach(file IN LISTS found)
    get_filename_component(folder ${root}/${file} DIRECTORY)
    file(MAKE_DIRECTORY ${folder})
    # Not file(RENAME), since CPack's folder may be in another file system.
    execute_process(COMMAND mv ${stage}/${file} ${root}/${file} COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
endforeach()
file(COPY ${build}/debian/doc/ DESTINATION ${root}/usr/share/doc/${package})
execute_process(COMMAND chmod -R u+rwX,go+rX,go-w ${root} COMMAND_ERROR_IS_FATAL ANY)
