// SPDX-License-Identifier: Apache-2.0
// A component's own program, as projects make one beside the library, from before Tandem was replaced.
#include "another_number.hpp"

#include <rtm/Manager.h>

int main(int argc, char** argv) {
    RTC::Manager::init(argc, argv);
    return 7;
}
