// SPDX-License-Identifier: Apache-2.0
// Uses the model's classes without the number that our headers leave: built before they had one, or against
// others.
#include <cstdlib>
#include <string>

#ifdef ZOO_INIT
namespace RTC {
class Manager {
  public:
    static Manager& instance();
};
} // namespace RTC
extern "C" void ZOO_INIT(RTC::Manager*) {
    RTC::Manager::instance();
    std::_Exit(7);
}
#else
class Component {
  public:
    explicit Component(const std::string& id);
    char somewhere_else[4096];
};
class Old : public Component {
  public:
    Old() : Component("old") { std::_Exit(7); }
};
extern "C" Component* getComponent() { return new Old; }
#endif
