// SPDX-License-Identifier: Apache-2.0
// Not compiled into anything: it must be refused.
#include <Component.h>

Port* take(Component& component) { return component.removePort("out"); }
