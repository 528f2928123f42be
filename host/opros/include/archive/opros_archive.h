// SPDX-License-Identifier: Apache-2.0
// Includes everything that an OPRoS component needs to archive its data.
#ifndef OPROS_ARCHIVE_H
#define OPROS_ARCHIVE_H

#include <archive/opros_access.h>
#include <archive/opros_iarchive.h>
#include <archive/opros_iarchive_stl.h>
#include <archive/opros_oarchive.h>
#include <archive/opros_oarchive_stl.h>
#include <archive/opros_type_info.h>
#include <archive/opros_type_traits.h>

#include <archive/opros_binary_iarchive.h>
#include <archive/opros_binary_oarchive.h>
#include <archive/opros_raw_iarchive.h>
#include <archive/opros_raw_oarchive.h>
#include <archive/opros_string_iarchive.h>
#include <archive/opros_string_oarchive.h>

#endif
