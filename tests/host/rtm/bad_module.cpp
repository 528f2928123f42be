// SPDX-License-Identifier: Apache-2.0
// A library without an init function.
extern "C" int not_an_init_function() { return 0; }
