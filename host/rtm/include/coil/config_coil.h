// SPDX-License-Identifier: Apache-2.0
// Macros by which component sources test for the system.
#ifndef COIL_CONFIG_H
#define COIL_CONFIG_H

#define COIL_OS_LINUX
#define COIL_HAS_IOSTREAM
#endif
