// SPDX-License-Identifier: Apache-2.0
#ifndef RTM_INTERFACESIGNATURES_H
#define RTM_INTERFACESIGNATURES_H
#include <omniORB4/CORBA.h>
#include <string>
#include <utility>
#include <vector>

namespace RTC {

/// Type signatures of IDL structs, unions and operations, by repository id; ours, not part of OpenRTM-aist. A
/// signature says the structure of a type in the alphabet of the D-Bus type system and more codes, which
/// docs/wire_format.md lists, with the names of members in braces: `{tm}({sec}u{nsec}u){data}d`. Filled by the
/// initialisers that tandem_add_rtm_idl() generates, and by ports for their data types. [any-thread]
class InterfaceSignatures {
  public:
    struct Operation {
        std::string name;
        std::string
            arguments; ///< without separators, `>` before an out and `&` before an inout one: `{a}d>{b}d`
        std::string
            result; ///< and then ` oneway`, or ` raises` and the exceptions: `i raises IDL:M/E:1.0({a}s)`
    };
    using Operations = std::vector<Operation>;

    /// Static initialisers of generated sources make one of these.
    struct Registration {
        Registration(const std::vector<std::pair<const char*, Operations>>& interfaces,
                     const std::vector<std::pair<const char*, const char*>>& types);
    };

    /// Operations of an interface named by its repository id (`IDL:M/I:1.0`) or by its last names (`M::I`,
    /// `I`); NULL when unknown. The result stays valid.
    static const Operations* find(const std::string& interface_name);
    /// Full repository id for the same names, empty when unknown.
    static std::string repositoryId(const std::string& interface_name);

    /// Signature of a data type by repository id, `{tm}({sec}u{nsec}u){data}d` for IDL:RTC/TimedDouble:1.0 (a
    /// message's own pair of parentheses is dropped); empty when unknown.
    static std::string type(const std::string& repository_id);
    /// Repository ids of all data types that are known now, in alphabetical order.
    static std::vector<std::string> types();
    /// Makes a data type known from its TypeCode; ports do this for what they carry.
    static void addType(const char* repository_id, CORBA::TypeCode_ptr code);
    /// Signature of any TypeCode, a struct with its parentheses.
    static std::string signature(CORBA::TypeCode_ptr code);
};

} // namespace RTC
#endif
