// SPDX-License-Identifier: Apache-2.0
extern "C" int nothing_of_interest() { return 0; }
