// SPDX-License-Identifier: Apache-2.0
// Includes everything.
#ifndef OPROS_INCLUDE_H
#define OPROS_INCLUDE_H

#include <Component.h>
#include <EventCallBack.h>
#include <EventData.h>
#include <InputDataPort.h>
#include <InputEventPort.h>
#include <OPRoSTypes.h>
#include <OutputDataPort.h>
#include <OutputEventPort.h>
#include <ServiceUtils.h>
#include <ext/EventPortX.h>

#endif
