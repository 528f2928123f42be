// SPDX-License-Identifier: Apache-2.0
// Limits how deep the values and types of a request may nest. omniORB has no limit. It reads a TypeCode by recursion, with a copy
// for each level. omniORB 4.2 reads an `any` within another one twice, so that the time doubles with each level. omniORB 4.3
// copies it by recursion, until the stack ends, and calls operator<<= for the outermost one only, but reads the TypeCode of each.
// Both versions call both functions through the dynamic symbol table, which finds the definitions in this library first.
#include <cstddef>
#include <dlfcn.h>
#include <omniORB4/CORBA.h>

namespace {

// The time is up to 2^10 times that of one any. A link carries 8 levels, and names a ninth in its message.
constexpr int most_nested_anys = 10;
// Data types of OpenRTM-aist have up to 10 levels.
constexpr int most_type_levels = 32;
// One level takes omniORB 4.3 0.2 KiB. A thread of the ORB has 8 MiB.
constexpr std::ptrdiff_t most_stack_of_any = 1 << 18; // 256 KiB

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

thread_local int anys = 0;                    // that this thread is reading
thread_local const char* any_began = nullptr; // the stack's end where the outermost one began

const char* stack_end() { return static_cast<const char*>(__builtin_frame_address(0)); }

/// Throws MARSHAL if the any that this thread reads takes too much of its stack.
void check_stack_of_any() {
    if (anys > 0 && any_began - stack_end() > most_stack_of_any) throw CORBA::MARSHAL(0, CORBA::COMPLETED_NO);
}

/// Returns omniORB's function. In a program that loads omniORB before this library, it is not the next one but the first.
template <class Function>
Function* original(const char* symbol) {
    void* const next = dlsym(RTLD_NEXT, symbol);
    return reinterpret_cast<Function*>(next != nullptr ? next : dlsym(RTLD_DEFAULT, symbol));
}

} // namespace

void CORBA::Any::operator<<=(cdrStream& stream) {
    static auto* const read = original<void(CORBA::Any*, cdrStream&)>("_ZN5CORBA3AnylSER9cdrStream");
    const Level level(anys, most_nested_anys);
    if (anys == 1) any_began = stack_end();
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
    check_stack_of_any();
    return read(stream, offsets);
}

} // namespace omni
