# SPDX-License-Identifier: Apache-2.0
# Run by CPack when all packages have taken their files: what is left in the stage is in no package, by mistake.
file(GLOB_RECURSE left LIST_DIRECTORIES false RELATIVE ${CPACK_TANDEM_BUILD}/debian/stage
  ${CPACK_TANDEM_BUILD}/debian/stage/*)
if(left)
  list(JOIN left ", " left)
  message(FATAL_ERROR "cpack: no list in cmake/debian/install names ${left}")
endif()
file(REMOVE_RECURSE ${CPACK_TANDEM_BUILD}/debian/stage)
