// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_OPROSTHREAD_H_
#define DEVICE_OPROSTHREAD_H_

// Components include this file. Upstream's is empty as well.

#endif
