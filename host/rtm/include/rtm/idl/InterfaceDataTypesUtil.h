// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_INTERFACEDATATYPESUTIL_H
#define RTC_INTERFACEDATATYPESUTIL_H
#include <rtm/DataTypeUtil.h>
#include <rtm/idl/InterfaceDataTypesSkel.h>
#endif
