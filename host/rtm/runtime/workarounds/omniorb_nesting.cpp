// SPDX-License-Identifier: Apache-2.0
// Limits how deep the values and types of a request may nest. omniORB 4.2 and 4.3 have no limit: they read an `any` within
// another one twice, so that the time doubles with each level, and a TypeCode by recursion, with a copy for each level. They
// call both functions through the dynamic symbol table, which finds the definitions in this library first.
#include <dlfcn.h>
#include <omniORB4/CORBA.h>

namespace {

// The time is up to 2^10 times that of one any. A link carries 8 levels, and names a ninth in its message.
constexpr int most_nested_anys = 10;
// Data types of OpenRTM-aist have up to 10 levels.
constexpr int most_type_levels = 32;

/// Counts the calls of one function that this thread has not left. Throws MARSHAL if there are too many.
class Level {
  public:
    Level(int& count, int most) : count_(count) {
        if (count_ >= most) throw CORBA::MARSHAL(0, CORBA::COMPLETED_NO);
        ++count_;
    }
    ~Level() { --count_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

  private:
    int& count_;
};

/// Returns omniORB's function. In a program that loads omniORB before this library, it is not the next one but the first.
template <class Function>
Function* original(const char* symbol) {
    void* const next = dlsym(RTLD_NEXT, symbol);
    return reinterpret_cast<Function*>(next != nullptr ? next : dlsym(RTLD_DEFAULT, symbol));
}

} // namespace

void CORBA::Any::operator<<=(cdrStream& stream) {
    static auto* const read = original<void(CORBA::Any*, cdrStream&)>("_ZN5CORBA3AnylSER9cdrStream");
    thread_local int anys = 0;
    const Level level(anys, most_nested_anys);
    read(this, stream);
}

namespace omni {

class TypeCode_base;
class TypeCode_offsetTable;

/// A class of omniORB whose header is not installed.
class TypeCode_marshaller {
  public:
    static TypeCode_base* unmarshal(cdrStream& stream, TypeCode_offsetTable* offsets);
};

TypeCode_base* TypeCode_marshaller::unmarshal(cdrStream& stream, TypeCode_offsetTable* offsets) {
    static auto* const read = original<TypeCode_base*(cdrStream&, TypeCode_offsetTable*)>(
        "_ZN4omni19TypeCode_marshaller9unmarshalER9cdrStreamPNS_20TypeCode_offsetTableE");
    thread_local int levels = 0;
    const Level level(levels, most_type_levels + 1); // the innermost is a basic type
    return read(stream, offsets);
}

} // namespace omni
