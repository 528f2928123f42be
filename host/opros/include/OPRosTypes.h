// SPDX-License-Identifier: Apache-2.0
#include <OPRoSTypes.h> // the spelling that some components use
