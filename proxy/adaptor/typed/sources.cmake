# SPDX-License-Identifier: Apache-2.0
# The sources of AdaptorComp for the OPRoS API alone, as the variable `sources`: of the rooms whose ports and methods have to
# describe their types this is what is left.
set(adaptor ${CMAKE_CURRENT_LIST_DIR}/..)
tandem_sources(sources ${adaptor} ${adaptor}/names ${adaptor}/typed)
list(APPEND sources ${adaptor}/archive/device_conversions.cpp ${adaptor}/archive/type_check.cpp
  ${adaptor}/event/event_type.cpp ${adaptor}/event/mirror_event_in_port.cpp ${adaptor}/event/mirror_fsm_port.cpp
  ${adaptor}/service/call_failure.cpp)
