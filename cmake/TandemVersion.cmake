# SPDX-License-Identifier: Apache-2.0
# The target tandem_version: the header <tandem_version.hpp> with the version of the project() line. A header and not a
# compile definition, so that a new version recompiles only the sources that print it.
configure_file(${CMAKE_CURRENT_LIST_DIR}/tandem_version.hpp.in
  ${PROJECT_BINARY_DIR}/generated/tandem_version/tandem_version.hpp @ONLY)
add_library(tandem_version INTERFACE)
target_include_directories(tandem_version INTERFACE ${PROJECT_BINARY_DIR}/generated/tandem_version)
