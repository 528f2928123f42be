// SPDX-License-Identifier: Apache-2.0
int component_of_this_library = 1;
