// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <OPRoSInclude.h>

/// A component of a test whose transitions all succeed; it overrides what it needs.
class SimpleComponent : public Component {
  protected:
    ReturnType onInitialize() override { return OPROS_SUCCESS; }
    ReturnType onStart() override { return OPROS_SUCCESS; }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onReset() override { return OPROS_SUCCESS; }
    ReturnType onError() override { return OPROS_SUCCESS; }
    ReturnType onRecover() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }
};
