// SPDX-License-Identifier: Apache-2.0
// CMake makes a precompiled header only for a target that has a file which uses it. This one holds nothing else.
