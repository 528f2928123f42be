// SPDX-License-Identifier: Apache-2.0
#ifndef OPROS_BINARY_H
#define OPROS_BINARY_H

#include <vector>

namespace opros {

/// A block of bytes, for components of OPRoS v1 that archive one.
class binary {
  public:
    virtual ~binary() {}
    virtual void resize(unsigned long size) { m_data.resize(size); }
    virtual char* data() { return m_data.data(); }
    virtual unsigned long size() { return m_data.size(); }

  protected:
    std::vector<char> m_data;
};

} // namespace opros

#endif
