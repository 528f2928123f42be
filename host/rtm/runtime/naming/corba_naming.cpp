// SPDX-License-Identifier: Apache-2.0
// A client of one CORBA name server, which components use themselves, as OpenRTM-aist's class CorbaNaming. NameBindings
// holds the runtime's own names; it has time limits and repeats failed calls. The calls here throw the server's
// exceptions. This file: connecting, resolving, listing, names as text.
#include <algorithm>
#include <coil/stringutil.h>
#include <new>
#include <rtm/CorbaNaming.h>

namespace RTC {
namespace {

using Context = CosNaming::NamingContext;

void append(CosNaming::BindingList& to, const CosNaming::BindingList& from) {
    const CORBA::ULong at = to.length();
    to.length(at + from.length());
    for (CORBA::ULong i = 0; i < from.length(); ++i) to[at + i] = from[i];
}

// All entries of a context, fetched `at_once` at a time.
CosNaming::BindingList* list_all(CosNaming::NamingContext_ptr context, CORBA::ULong at_once) {
    CosNaming::BindingList_var entries, more;
    CosNaming::BindingIterator_var iterator;
    context->list(at_once, entries.out(), iterator.out());
    if (CORBA::is_nil(iterator.in())) return entries._retn();
    while (iterator->next_n(at_once, more.out())) append(entries.inout(), more.in());
    iterator->destroy();
    return entries._retn();
}

} // namespace

CorbaNaming::CorbaNaming(CORBA::ORB_ptr orb) : m_varORB(CORBA::ORB::_duplicate(orb)) {}

// Throws std::bad_alloc when there is no name server, as OpenRTM-aist does.
CorbaNaming::CorbaNaming(CORBA::ORB_ptr orb, const char* name_server) : CorbaNaming(orb) {
    init(name_server);
    if (CORBA::is_nil(m_rootContext.in())) throw std::bad_alloc();
}

// `HOST`, `HOST:PORT` (2809 is the port that IANA has assigned to CORBA) or a whole corbaloc: URL.
void CorbaNaming::init(const char* name_server) {
    m_nameServer = name_server;
    const std::string url = m_nameServer.compare(0, 9, "corbaloc:") == 0
                                ? m_nameServer
                                : "corbaloc:iiop:" + m_nameServer +
                                      (m_nameServer.find(':') == std::string::npos ? ":2809" : "") +
                                      "/NameService";
    CORBA::Object_var object = m_varORB->string_to_object(url.c_str());
    m_rootContext = CosNaming::NamingContextExt::_narrow(object.in());
}

// Calls the server, within the ORB's time limit.
bool CorbaNaming::isAlive() {
    try {
        return !CORBA::is_nil(m_rootContext.in()) && !m_rootContext->_non_existent();
    } catch (const CORBA::SystemException&) { // no answer means not alive
        return false;
    }
}

// The caller releases the reference. Throws NotFound and the other exceptions of CosNaming.
CORBA::Object_ptr CorbaNaming::resolve(const CosNaming::Name& name) { return m_rootContext->resolve(name); }
CORBA::Object_ptr CorbaNaming::resolve(const char* string_name) { return resolve(toName(string_name)); }

// Empties a context: contexts below it are emptied, unbound and destroyed, other entries only unbound.
void CorbaNaming::destroyRecursive(CosNaming::NamingContext_ptr context) {
    CosNaming::BindingList_var entries = list_all(context, m_blLength);
    for (CORBA::ULong i = 0; i < entries->length(); ++i) {
        const CosNaming::Binding& entry = entries[i];
        CosNaming::NamingContext_var below;
        if (entry.binding_type == CosNaming::ncontext) {
            CORBA::Object_var object = context->resolve(entry.binding_name);
            below = Context::_narrow(object.in());
        }
        if (!CORBA::is_nil(below.in())) destroyRecursive(below.in());
        context->unbind(entry.binding_name);
        if (!CORBA::is_nil(below.in())) below->destroy();
    }
}
void CorbaNaming::clearAll() { destroyRecursive(m_rootContext.in()); }

void CorbaNaming::list(CosNaming::NamingContext_ptr name_cxt, CORBA::ULong how_many,
                       CosNaming::BindingList_var& bl, CosNaming::BindingIterator_var& bi) {
    name_cxt->list(how_many, bl.out(), bi.out());
}
// An empty name stands for the root context.
void CorbaNaming::list(const char* string_name, CosNaming::BindingList_var& bl) {
    CORBA::Object_var object =
        *string_name == '\0' ? CORBA::Object::_duplicate(m_rootContext.in()) : resolve(string_name);
    CosNaming::NamingContext_var context = Context::_narrow(object.in());
    bl = CORBA::is_nil(context.in()) ? new CosNaming::BindingList : list_all(context.in(), m_blLength);
}
// Entries of one kind, `rtc` or `host_cxt` for example.
void CorbaNaming::listByKind(const char* string_name, const char* string_kind,
                             CosNaming::BindingList_var& bl) {
    CosNaming::BindingList_var entries;
    list(string_name, entries);
    CosNaming::BindingList_var matching = new CosNaming::BindingList;
    for (CORBA::ULong i = 0; i < entries->length(); ++i) {
        const CosNaming::Name& name = entries[i].binding_name;
        if (std::string(name[name.length() - 1].kind) != string_kind) continue;
        matching->length(matching->length() + 1);
        matching[matching->length() - 1] = entries[i];
    }
    bl = matching._retn();
}

// _narrow() may have to ask the object's process for its type.
bool CorbaNaming::isNamingContext(CORBA::Object_ptr obj) {
    try {
        CosNaming::NamingContext_var context = Context::_narrow(obj);
        return !CORBA::is_nil(context.in());
    } catch (const CORBA::SystemException&) { // an object that does not answer is not usable
        return false;
    }
}
bool CorbaNaming::isNamingContext(const CosNaming::Name& name) {
    CORBA::Object_var object = resolve(name);
    return isNamingContext(object.in());
}
bool CorbaNaming::isNamingContext(const char* string_name) { return isNamingContext(toName(string_name)); }

// Names as text: `id.kind` parts separated by slashes. A part without a dot has the empty kind.
char* CorbaNaming::toString(const CosNaming::Name& name) {
    if (name.length() == 0) throw InvalidName();
    std::string text;
    for (CORBA::ULong i = 0; i < name.length(); ++i) {
        if (i > 0) text += '/';
        text += name[i].id;
        if (*name[i].kind != '\0') text += std::string(".") + static_cast<const char*>(name[i].kind);
    }
    return CORBA::string_dup(text.c_str());
}

CosNaming::Name CorbaNaming::toName(const char* string_name) {
    if (string_name == nullptr || *string_name == '\0') throw InvalidName();
    CosNaming::Name name;
    for (const auto& part : coil::split(string_name, "/", true)) {
        const std::size_t dot = part.rfind('.');
        const CORBA::ULong at = name.length();
        name.length(at + 1);
        name[at].id = CORBA::string_dup(part.substr(0, dot).c_str());
        name[at].kind = CORBA::string_dup(dot == std::string::npos ? "" : part.substr(dot + 1).c_str());
    }
    return name;
}

char* CorbaNaming::toUrl(char* addr, char* string_name) { return m_rootContext->to_url(addr, string_name); }

// `begin` to `end`, both included; a negative `end` means the last part.
CosNaming::Name CorbaNaming::subName(const CosNaming::Name& name, CORBA::Long begin, CORBA::Long end) {
    const auto length = static_cast<CORBA::Long>(name.length());
    if (end < 0 || end >= length) end = length - 1;
    CosNaming::Name part;
    part.length(static_cast<CORBA::ULong>(std::max<CORBA::Long>(end - begin + 1, 0)));
    for (CORBA::ULong i = 0; i < part.length(); ++i) part[i] = name[static_cast<CORBA::ULong>(begin) + i];
    return part;
}

} // namespace RTC
