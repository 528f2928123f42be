// SPDX-License-Identifier: Apache-2.0
// The signatures use the alphabet of the D-Bus type system (D-Bus specification, "Type system"), with additions for
// CDR. docs/wire_format.md describes them in full.
#include <cstring>
#include <map>
#include <mutex>
#include <rtm/InterfaceSignatures.h>

namespace RTC {
namespace {

/// All registrations of this process. Entries are only added, so pointers to them stay valid.
struct SignatureRegistry {
    std::mutex mutex;
    std::map<std::string, InterfaceSignatures::Operations> interfaces; // by repository id
    std::map<std::string, std::string> types;                          // by repository id
};
SignatureRegistry& signature_registry() {
    // Never destroyed: static initialisers of plugins may run before and after all other code.
    static auto* instance = new SignatureRegistry;
    return *instance;
}

// IDL:omg.org/M/I:1.0 -> omg.org/M/I; a name that is not a repository id stays unchanged.
std::string repository_path(const std::string& id) {
    const std::size_t begin = id.compare(0, 4, "IDL:") == 0 ? 4 : 0;
    const std::size_t end = begin == 0 ? id.size() : id.rfind(':');
    return id.substr(begin, end - begin);
}

// ::M::I -> M/I, the form of repository ids.
std::string scopes_to_slashes(std::string name) {
    for (std::size_t at; (at = name.find("::")) != std::string::npos;) name.replace(at, 2, "/");
    return !name.empty() && name[0] == '/' ? name.substr(1) : name;
}

// Whole path elements only: `alculator` is not the end of `Testing/Calculator`.
bool ends_with_path(const std::string& path, const std::string& name) {
    if (path == name) return true;
    return path.size() > name.size() && path[path.size() - name.size() - 1] == '/' &&
           path.compare(path.size() - name.size(), name.size(), name) == 0;
}

// The exact repository id, otherwise the first interface whose path ends with the name. The caller holds the
// mutex.
auto find_interface(SignatureRegistry& signatures, const std::string& name) {
    auto exact = signatures.interfaces.find(name);
    if (exact != signatures.interfaces.end()) return exact;
    const std::string wanted = scopes_to_slashes(repository_path(name));
    auto it = signatures.interfaces.begin();
    while (it != signatures.interfaces.end() && !ends_with_path(repository_path(it->first), wanted)) ++it;
    return it;
}

// Removes the outer parentheses, ((uu)d) -> (uu)d: a message is one struct, so they carry no information.
std::string strip_outer_parentheses(const std::string& signature) {
    // The signature of a struct begins and ends with its own pair.
    return signature.size() >= 2 && signature.front() == '(' ? signature.substr(1, signature.size() - 2)
                                                             : signature;
}

struct TooLarge {};

/// How much of a signature has been written. A TypeCode contains each type once, its signature wherever it is used: a
/// client's TypeCode of 1 kB could have a signature that fills the memory, or never end.
class Extent {
  public:
    void count(std::size_t bytes) {
        constexpr std::size_t max_bytes = 1 << 20;
        bytes_ += bytes;
        if (bytes_ > max_bytes) throw TooLarge();
    }
    void enter() {
        constexpr int max_depth = 256;
        count(1);
        if (++depth_ > max_depth) throw TooLarge();
    }
    void leave() { --depth_; }

  private:
    std::size_t bytes_ = 0;
    int depth_ = 0;
};
constexpr const char* too_large = "?{a type whose description is above 1 MiB or nested too deep}";

/// The structures and unions around a type, the innermost first.
struct Enclosing {
    std::string id;
    const Enclosing* outer;
    Extent& extent;
};

// Types without an id may differ: only their depth is limited.
bool is_within_itself(const std::string& id, const Enclosing* outer) {
    for (; outer != nullptr && !id.empty(); outer = outer->outer)
        if (outer->id == id) return true;
    return false;
}
constexpr const char* recursive = "?{a type that contains itself, whose depth only each value knows}";

std::string signature_of(CORBA::TypeCode_ptr code, const Enclosing& outer);

CORBA::TypeCode_var strip_aliases(CORBA::TypeCode_ptr code) {
    CORBA::TypeCode_var type = CORBA::TypeCode::_duplicate(code);
    while (type->kind() == CORBA::tk_alias) type = type->content_type();
    return type;
}

struct BasicSignature {
    CORBA::TCKind kind;
    const char* signature;
};
// The types that contain no other type. Constant, because static initialisers of plugins need them before any code
// runs.
constexpr BasicSignature basic_signatures[] = {
    {CORBA::tk_void, ""},
    {CORBA::tk_null, ""},
    {CORBA::tk_boolean, "b"},
    {CORBA::tk_char, "c"},
    {CORBA::tk_octet, "y"},
    {CORBA::tk_short, "n"},
    {CORBA::tk_ushort, "q"},
    {CORBA::tk_long, "i"},
    {CORBA::tk_ulong, "u"},
    {CORBA::tk_longlong, "x"},
    {CORBA::tk_ulonglong, "t"},
    {CORBA::tk_float, "f"},
    {CORBA::tk_double, "d"},
    {CORBA::tk_any, "v"},
    {CORBA::tk_wchar, "W"},
    {CORBA::tk_longdouble, "D"},
    {CORBA::tk_objref, "o"},
    {CORBA::tk_value, "?{valuetype}"},
    {CORBA::tk_value_box, "?{valuetype}"},
    {CORBA::tk_TypeCode, "?{TypeCode}"},
};

std::string member_signature(const char* name, CORBA::TypeCode_ptr code, const Enclosing& outer) {
    outer.extent.count(std::strlen(name) + 2);
    return "{" + std::string(name) + "}" + signature_of(code, outer);
}

// The members' signatures in parentheses; the TypeCode has them in the order of the IDL.
std::string signature_of_struct(CORBA::TypeCode_ptr code, const Enclosing& outer) {
    const Enclosing here{code->id(), &outer, outer.extent};
    if (is_within_itself(here.id, &outer)) return recursive;
    std::string parts;
    for (CORBA::ULong i = 0; i < code->member_count(); ++i)
        parts += member_signature(code->member_name(i), CORBA::TypeCode_var(code->member_type(i)).in(), here);
    return "(" + parts + ")";
}

// A label has the type of the discriminator: an enumerator is written as its number.
std::string text_of_label(const CORBA::Any& label) {
    const CORBA::TypeCode_var code = label.type();
    cdrMemoryStream stream;
    label.NP_marshalDataOnly(stream);
    const auto number = [&](auto value) {
        value <<= stream;
        return std::to_string(value);
    };
    switch (strip_aliases(code.in())->kind()) {
    case CORBA::tk_boolean:
        return std::to_string(static_cast<int>(stream.unmarshalBoolean()));
    case CORBA::tk_char:
        return std::to_string(static_cast<int>(static_cast<signed char>(stream.unmarshalChar())));
    case CORBA::tk_short:
        return number(CORBA::Short());
    case CORBA::tk_ushort:
        return number(CORBA::UShort());
    case CORBA::tk_long:
        return number(CORBA::Long());
    case CORBA::tk_longlong:
        return number(CORBA::LongLong());
    case CORBA::tk_ulonglong:
        return number(CORBA::ULongLong());
    default: // unsigned long, and the number of an enumerator
        return number(CORBA::ULong());
    }
}

// Several labels of one case are several members of that name in the TypeCode.
std::string signature_of_union(CORBA::TypeCode_ptr code, const Enclosing& outer) {
    const Enclosing here{code->id(), &outer, outer.extent};
    if (is_within_itself(here.id, &outer)) return recursive;
    std::string text = "<" + signature_of(CORBA::TypeCode_var(code->discriminator_type()).in(), here);
    const CORBA::Long default_index = code->default_index();
    for (CORBA::ULong i = 0; i < code->member_count();) {
        const std::string name = code->member_name(i);
        const CORBA::TypeCode_var type = code->member_type(i);
        std::string labels;
        for (; i < code->member_count() && name == code->member_name(i); ++i) {
            const bool is_default = static_cast<CORBA::Long>(i) == default_index;
            if (is_default && !labels.empty()) break; // a separate case, so that no label is lost
            const CORBA::Any_var label = code->member_label(i);
            const std::string value = is_default ? "*" : text_of_label(label.in());
            outer.extent.count(value.size() + 1);
            labels += (labels.empty() ? "" : ",") + value;
            if (!is_default) continue;
            ++i;
            break;
        }
        text += ";" + labels + "=" + member_signature(name.c_str(), type.in(), here);
    }
    return text + ">";
}

std::string bound_text(CORBA::ULong bound) { return bound == 0 ? "" : "#" + std::to_string(bound); }

std::string signature_of_kind(CORBA::TypeCode_ptr code, const Enclosing& outer) {
    for (const auto& basic : basic_signatures)
        if (basic.kind == code->kind()) return basic.signature;
    switch (code->kind()) {
    case CORBA::tk_alias: // a typedef is the type it names
        return signature_of(CORBA::TypeCode_var(code->content_type()).in(), outer);
    case CORBA::tk_string:
        return "s" + bound_text(code->length());
    case CORBA::tk_wstring:
        return "w" + bound_text(code->length());
    case CORBA::tk_enum:
        return "e" + bound_text(code->member_count());
    case CORBA::tk_fixed:
        return "F" + std::to_string(code->fixed_digits()) + "," + std::to_string(code->fixed_scale());
    case CORBA::tk_sequence:
        return "a" + bound_text(code->length()) +
               signature_of(CORBA::TypeCode_var(code->content_type()).in(), outer);
    case CORBA::tk_array:
        return "[" + std::to_string(code->length()) + "]" +
               signature_of(CORBA::TypeCode_var(code->content_type()).in(), outer);
    case CORBA::tk_struct:
        return signature_of_struct(code, outer);
    case CORBA::tk_union:
        return signature_of_union(code, outer);
    default:
        return "?{TypeCode kind " + std::to_string(static_cast<int>(code->kind())) + "}";
    }
}

std::string signature_of(CORBA::TypeCode_ptr code, const Enclosing& outer) {
    outer.extent.enter();
    std::string signature = signature_of_kind(code, outer);
    outer.extent.leave(); // after an exception, the extent is not used any more
    return signature;
}

} // namespace

InterfaceSignatures::Registration::Registration(
    const std::vector<std::pair<const char*, Operations>>& interfaces,
    const std::vector<std::pair<const char*, const char*>>& types) {
    SignatureRegistry& signatures = signature_registry();
    std::lock_guard<std::mutex> lock(signatures.mutex);
    for (auto& entry : interfaces) signatures.interfaces.emplace(entry.first, entry.second);
    for (auto& entry : types) signatures.types.emplace(entry.first, strip_outer_parentheses(entry.second));
}

const InterfaceSignatures::Operations* InterfaceSignatures::find(const std::string& interface_name) {
    SignatureRegistry& signatures = signature_registry();
    std::lock_guard<std::mutex> lock(signatures.mutex);
    auto found = find_interface(signatures, interface_name);
    return found == signatures.interfaces.end() ? nullptr : &found->second;
}

std::string InterfaceSignatures::repositoryId(const std::string& interface_name) {
    SignatureRegistry& signatures = signature_registry();
    std::lock_guard<std::mutex> lock(signatures.mutex);
    auto found = find_interface(signatures, interface_name);
    return found == signatures.interfaces.end() ? "" : found->first;
}

std::string InterfaceSignatures::type(const std::string& repository_id) {
    SignatureRegistry& signatures = signature_registry();
    std::lock_guard<std::mutex> lock(signatures.mutex);
    auto found = signatures.types.find(repository_id);
    return found == signatures.types.end() ? "" : found->second;
}

std::vector<std::string> InterfaceSignatures::types() {
    SignatureRegistry& signatures = signature_registry();
    std::lock_guard<std::mutex> lock(signatures.mutex);
    std::vector<std::string> ids;
    for (const auto& entry : signatures.types) ids.push_back(entry.first);
    return ids;
}

// Makes the signature before taking the lock, because a TypeCode of another library may take long.
void InterfaceSignatures::addType(const char* repository_id, CORBA::TypeCode_ptr code) {
    const std::string text = strip_outer_parentheses(signature(code));
    SignatureRegistry& signatures = signature_registry();
    std::lock_guard<std::mutex> lock(signatures.mutex);
    signatures.types.emplace(repository_id, text);
}

std::string InterfaceSignatures::signature(CORBA::TypeCode_ptr code) {
    Extent extent;
    try {
        return signature_of(code, {"", nullptr, extent});
    } catch (const TooLarge&) {
        return too_large;
    }
}

} // namespace RTC
