# SPDX-License-Identifier: Apache-2.0
# The longer name of the same package.
include(${CMAKE_CURRENT_LIST_DIR}/../OpenRTM/OpenRTMConfig.cmake)
