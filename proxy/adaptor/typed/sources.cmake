# SPDX-License-Identifier: Apache-2.0
# The sources of AdaptorComp for the OPRoS API alone, as the variable `sources`: of the rooms whose ports and methods have to
# describe their types this is what is left.
set(adaptor ${CMAKE_CURRENT_LIST_DIR}/..)
tandem_sources(sources ${adaptor} ${adaptor}/engine ${adaptor}/names ${adaptor}/typed)
list(APPEND sources ${adaptor}/archive/device_conversions.cpp ${adaptor}/archive/pictures.cpp
  ${adaptor}/archive/type_check.cpp
  ${adaptor}/event/event_type.cpp ${adaptor}/event/mirror_event_in_port.cpp ${adaptor}/event/mirror_fsm_port.cpp
  ${adaptor}/service/call_failure.cpp)

# A user's header of types is his own code: it is compiled by itself, so that it does not clash with the other files.
if(TANDEM_OPROS_TYPES)
  set_source_files_properties(${adaptor}/typed/added_types.cpp PROPERTIES
    COMPILE_DEFINITIONS "TANDEM_OPROS_TYPES=\"${TANDEM_OPROS_TYPES}\"" OBJECT_DEPENDS ${TANDEM_OPROS_TYPES})
endif()
