// SPDX-License-Identifier: Apache-2.0
#include <Component.h>
#include <cstdlib>
namespace {
class Leaver : public Component {
    ReturnType onInitialize() override { return OPROS_SUCCESS; }
    ReturnType onStart() override { return OPROS_SUCCESS; }
    ReturnType onExecute() override { std::exit(7); }
};
} // namespace
extern "C" Component* getComponent() { return new Leaver; }
extern "C" void releaseComponent(Component* component) { delete component; }
