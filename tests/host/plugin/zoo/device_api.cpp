// SPDX-License-Identifier: Apache-2.0
extern "C" void* GetAPI() { return nullptr; }
