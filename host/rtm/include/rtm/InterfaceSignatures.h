// SPDX-License-Identifier: Apache-2.0
#ifndef RTM_INTERFACESIGNATURES_H
#define RTM_INTERFACESIGNATURES_H
#include <omniORB4/CORBA.h>
#include <string>
#include <utility>
#include <vector>

namespace RTC {

/// Type signatures of IDL structs, unions and operations, by repository id. Not part of OpenRTM-aist. A signature
/// describes the structure of a type in the alphabet of the D-Bus type system and additional codes
/// (docs/wire_format.md), with member names in braces: `{tm}({sec}u{nsec}u){data}d`. Filled by the initialisers that
/// tandem_add_rtm_idl() generates, and by ports for their data types. [any-thread]
class InterfaceSignatures {
  public:
    struct Operation {
        std::string name;
        /// Without separators; `>` before an out and `&` before an inout argument: `{a}d>{b}d`.
        std::string arguments;
        /// The type, then ` oneway`, or ` raises` and the exceptions: `i raises IDL:M/E:1.0({a}s)`.
        std::string result;
    };
    using Operations = std::vector<Operation>;

    /// Static initialisers of generated sources create one of these.
    struct Registration {
        Registration(const std::vector<std::pair<const char*, Operations>>& interfaces,
                     const std::vector<std::pair<const char*, const char*>>& types);
    };

    /// Returns the operations of an interface, named by its repository id (`IDL:M/I:1.0`) or its last names (`M::I`,
    /// `I`), or NULL if unknown. The result stays valid.
    static const Operations* find(const std::string& interface_name);
    /// Returns the full repository id for the same names, or an empty string if unknown.
    static std::string repositoryId(const std::string& interface_name);

    /// Returns the signature of a data type by repository id, `{tm}({sec}u{nsec}u){data}d` for
    /// IDL:RTC/TimedDouble:1.0 (without the message's own parentheses), or an empty string if unknown.
    static std::string type(const std::string& repository_id);
    /// Returns the repository ids of all currently known data types in alphabetical order.
    static std::vector<std::string> types();
    /// Adds a data type from its TypeCode. Ports call it for their types.
    static void addType(const char* repository_id, CORBA::TypeCode_ptr code);
    /// Returns the signature of any TypeCode; a struct has its parentheses.
    static std::string signature(CORBA::TypeCode_ptr code);
};

} // namespace RTC
#endif
