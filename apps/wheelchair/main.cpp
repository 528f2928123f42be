// SPDX-License-Identifier: Apache-2.0
// wheelchair: the paper's experiment. See --help.
#include "apps/wheelchair/drive.hpp"

int main(int argc, char** argv) { return tandem::wheelchair::drive(argc, argv); }
