// SPDX-License-Identifier: Apache-2.0
#include <OPRoSTypes.h> // a spelling that some components use
