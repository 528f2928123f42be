// SPDX-License-Identifier: Apache-2.0
class Component;
extern "C" Component* getComponent() { return nullptr; }
