// SPDX-License-Identifier: Apache-2.0
// The RTM API of components and ports. The files of proxy/interceptor include this header instead of single ones:
// OpenRTM-aist's port templates find the operators of a data type only if its skeleton is included before them. In a unity
// build, this also applies to headers that another source file has included.
#pragma once

#include <rtm/idl/BasicDataTypeSkel.h>

#include <rtm/CORBA_RTCUtil.h>
#include <rtm/CdrBufferBase.h>
#include <rtm/CorbaConsumer.h>
#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataOutPort.h>
#include <rtm/ExtTrigExecutionContext.h>
#include <rtm/InPortBase.h>
#include <rtm/Manager.h>
#include <rtm/NamingManager.h>
#include <rtm/OutPortBase.h>
#include <rtm/OutPortConnector.h>
