// SPDX-License-Identifier: Apache-2.0
#include <Component.h>
namespace {
int* volatile nowhere = nullptr;
class Fragile : public Component {
  public:
    ~Fragile() override { *nowhere = 1; }
};
} // namespace
extern "C" Component* getComponent() { return new Fragile; }
extern "C" void releaseComponent(Component* component) { delete component; }
