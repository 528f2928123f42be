// SPDX-License-Identifier: Apache-2.0
// A component's own program, as projects make one beside the library, from before Tandem was replaced. It has our number, too,
// by the header by which each of ours leaves it, and declares what it calls: the others would take seconds to compile.
#include "another_number.hpp"

#include <rtm/TandemAbi.h>

namespace RTC {
class Manager {
  public:
    static Manager* init(int argc, char** argv);
};
} // namespace RTC

int main(int argc, char** argv) {
    RTC::Manager::init(argc, argv);
    return 7;
}
