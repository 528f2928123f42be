// SPDX-License-Identifier: Apache-2.0
#include <Component.h>
namespace {
int* volatile nowhere = nullptr;
struct Last {
    ~Last() { *nowhere = 1; }
} last;
class Plain : public Component {};
} // namespace
extern "C" Component* getComponent() { return new Plain; }
extern "C" void releaseComponent(Component* component) { delete component; }
