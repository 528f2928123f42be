// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_OPROSTHREAD_H_
#define DEVICE_OPROSTHREAD_H_

// Components name it; upstream's has nothing in it either.

#endif
