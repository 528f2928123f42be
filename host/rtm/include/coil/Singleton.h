// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_SINGLETON_H
#define COIL_SINGLETON_H

namespace coil {

/// One instance per process, created at first use.
template <class T>
class Singleton {
  public:
    static T& instance() {
        static T the_instance;
        return the_instance;
    }
    Singleton(const Singleton&) = delete;
    Singleton& operator=(const Singleton&) = delete;

  protected:
    Singleton() = default;
    ~Singleton() = default;
};

} // namespace coil
#endif
