// SPDX-License-Identifier: Apache-2.0
// A component's own program, as projects build one beside the library, built before Tandem was updated. The header that each of
// our headers includes stores the ABI number. This file declares what it calls: the other headers would take seconds to compile.
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
