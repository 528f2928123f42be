// SPDX-License-Identifier: Apache-2.0
// A library without an init function.
extern "C" int nothing_of_interest() { return 0; }
