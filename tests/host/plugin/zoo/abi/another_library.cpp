// SPDX-License-Identifier: Apache-2.0
extern "C" int in_another_library() { return 1; }
