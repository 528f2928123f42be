// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <coil/stringutil.h>
#include <new>
#include <rtm/CorbaNaming.h>

namespace RTC {
namespace {

using Context = CosNaming::NamingContext;

// The context in which the last element of `name` belongs, made when it is not there.
CosNaming::NamingContext_ptr parent_of(CosNaming::NamingContext_ptr context, const CosNaming::Name& name) {
    CosNaming::NamingContext_var at = Context::_duplicate(context);
    for (CORBA::ULong depth = 0; depth + 1 < name.length(); ++depth) {
        const CosNaming::Name step =
            CorbaNaming::subName(name, static_cast<CORBA::Long>(depth), static_cast<CORBA::Long>(depth));
        try {
            at = at->bind_new_context(step);
        } catch (const Context::AlreadyBound&) {
            CORBA::Object_var there = at->resolve(step);
            CosNaming::NamingContext_var next = Context::_narrow(there.in());
            if (CORBA::is_nil(next.in()))
                throw Context::CannotProceed(at.in(), step); // an object has that name
            at = next;
        }
    }
    return at._retn();
}

CosNaming::Name last_of(const CosNaming::Name& name) {
    if (name.length() == 0) throw Context::InvalidName();
    return CorbaNaming::subName(name, static_cast<CORBA::Long>(name.length()) - 1);
}

void append(CosNaming::BindingList& to, const CosNaming::BindingList& from) {
    const CORBA::ULong at = to.length();
    to.length(at + from.length());
    for (CORBA::ULong i = 0; i < from.length(); ++i) to[at + i] = from[i];
}

CosNaming::BindingList* all_entries(CosNaming::NamingContext_ptr context, CORBA::ULong at_once) {
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

CorbaNaming::CorbaNaming(CORBA::ORB_ptr orb, const char* name_server) : CorbaNaming(orb) {
    init(name_server);
    if (CORBA::is_nil(m_rootContext.in())) throw std::bad_alloc();
}

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

bool CorbaNaming::isAlive() {
    try {
        return !CORBA::is_nil(m_rootContext.in()) && !m_rootContext->_non_existent();
    } catch (const CORBA::SystemException&) { // it does not answer: that is what was asked
        return false;
    }
}

void CorbaNaming::bind(const CosNaming::Name& name, CORBA::Object_ptr obj, bool force) {
    try {
        m_rootContext->bind(name, obj);
    } catch (const NotFound&) {
        if (!force) throw;
        bindRecursive(m_rootContext.in(), name, obj);
    }
}
void CorbaNaming::bindByString(const char* string_name, CORBA::Object_ptr obj, bool force) {
    bind(toName(string_name), obj, force);
}
void CorbaNaming::bindRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                                CORBA::Object_ptr obj) {
    CosNaming::NamingContext_var parent = parent_of(context, name);
    parent->bind(last_of(name), obj);
}

void CorbaNaming::rebind(const CosNaming::Name& name, CORBA::Object_ptr obj, bool force) {
    try {
        m_rootContext->rebind(name, obj);
    } catch (const NotFound&) {
        if (!force) throw;
        rebindRecursive(m_rootContext.in(), name, obj);
    }
}
void CorbaNaming::rebindByString(const char* string_name, CORBA::Object_ptr obj, bool force) {
    rebind(toName(string_name), obj, force);
}
void CorbaNaming::rebindRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                                  CORBA::Object_ptr obj) {
    CosNaming::NamingContext_var parent = parent_of(context, name);
    parent->rebind(last_of(name), obj);
}

void CorbaNaming::bindContext(const CosNaming::Name& name, CosNaming::NamingContext_ptr name_cxt,
                              bool force) {
    try {
        m_rootContext->bind_context(name, name_cxt);
    } catch (const NotFound&) {
        if (!force) throw;
        bindContextRecursive(m_rootContext.in(), name, name_cxt);
    }
}
void CorbaNaming::bindContext(const char* string_name, CosNaming::NamingContext_ptr name_cxt, bool force) {
    bindContext(toName(string_name), name_cxt, force);
}
void CorbaNaming::bindContextRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                                       CosNaming::NamingContext_ptr name_cxt) {
    CosNaming::NamingContext_var parent = parent_of(context, name);
    parent->bind_context(last_of(name), name_cxt);
}

void CorbaNaming::rebindContext(const CosNaming::Name& name, CosNaming::NamingContext_ptr name_cxt,
                                bool force) {
    try {
        m_rootContext->rebind_context(name, name_cxt);
    } catch (const NotFound&) {
        if (!force) throw;
        rebindContextRecursive(m_rootContext.in(), name, name_cxt);
    }
}
void CorbaNaming::rebindContext(const char* string_name, CosNaming::NamingContext_ptr name_cxt, bool force) {
    rebindContext(toName(string_name), name_cxt, force);
}
void CorbaNaming::rebindContextRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                                         CosNaming::NamingContext_ptr name_cxt) {
    CosNaming::NamingContext_var parent = parent_of(context, name);
    parent->rebind_context(last_of(name), name_cxt);
}

CORBA::Object_ptr CorbaNaming::resolve(const CosNaming::Name& name) { return m_rootContext->resolve(name); }
CORBA::Object_ptr CorbaNaming::resolve(const char* string_name) { return resolve(toName(string_name)); }
void CorbaNaming::unbind(const CosNaming::Name& name) { m_rootContext->unbind(name); }
void CorbaNaming::unbind(const char* string_name) { unbind(toName(string_name)); }

CosNaming::NamingContext_ptr CorbaNaming::newContext() { return m_rootContext->new_context(); }
CosNaming::NamingContext_ptr CorbaNaming::bindNewContext(const CosNaming::Name& name, bool force) {
    try {
        return m_rootContext->bind_new_context(name);
    } catch (const NotFound&) {
        if (!force) throw;
        CosNaming::NamingContext_var parent = parent_of(m_rootContext.in(), name);
        return parent->bind_new_context(last_of(name));
    }
}
CosNaming::NamingContext_ptr CorbaNaming::bindNewContext(const char* string_name, bool force) {
    return bindNewContext(toName(string_name), force);
}
void CorbaNaming::destroy(CosNaming::NamingContext_ptr context) { context->destroy(); }

void CorbaNaming::destroyRecursive(CosNaming::NamingContext_ptr context) {
    CosNaming::BindingList_var entries = all_entries(context, m_blLength);
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
void CorbaNaming::list(const char* string_name, CosNaming::BindingList_var& bl) {
    CORBA::Object_var object =
        *string_name == '\0' ? CORBA::Object::_duplicate(m_rootContext.in()) : resolve(string_name);
    CosNaming::NamingContext_var context = Context::_narrow(object.in());
    bl = CORBA::is_nil(context.in()) ? new CosNaming::BindingList : all_entries(context.in(), m_blLength);
}
void CorbaNaming::listByKind(const char* string_name, const char* string_kind,
                             CosNaming::BindingList_var& bl) {
    CosNaming::BindingList_var entries;
    list(string_name, entries);
    CosNaming::BindingList_var chosen = new CosNaming::BindingList;
    for (CORBA::ULong i = 0; i < entries->length(); ++i) {
        const CosNaming::Name& name = entries[i].binding_name;
        if (std::string(name[name.length() - 1].kind) != string_kind) continue;
        chosen->length(chosen->length() + 1);
        chosen[chosen->length() - 1] = entries[i];
    }
    bl = chosen._retn();
}

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

CORBA::Object_ptr CorbaNaming::bindOrResolve(CosNaming::NamingContext_ptr context,
                                             const CosNaming::Name& name, CORBA::Object_ptr obj) {
    try {
        context->bind(name, obj);
        return CORBA::Object::_duplicate(obj);
    } catch (const AlreadyBound&) {
        return context->resolve(name);
    }
}
CosNaming::NamingContext_ptr CorbaNaming::bindOrResolveContext(CosNaming::NamingContext_ptr context,
                                                               const CosNaming::Name& name,
                                                               CosNaming::NamingContext_ptr new_context) {
    try {
        context->bind_context(name, new_context);
        return Context::_duplicate(new_context);
    } catch (const AlreadyBound&) {
        CORBA::Object_var there = context->resolve(name);
        return Context::_narrow(there.in());
    }
}
CosNaming::NamingContext_ptr CorbaNaming::bindOrResolveContext(CosNaming::NamingContext_ptr context,
                                                               const CosNaming::Name& name) {
    CosNaming::NamingContext_var made = newContext();
    return bindOrResolveContext(context, name, made.in());
}

bool CorbaNaming::isNamingContext(CORBA::Object_ptr obj) {
    try {
        CosNaming::NamingContext_var context = Context::_narrow(obj);
        return !CORBA::is_nil(context.in());
    } catch (const CORBA::SystemException&) { // nobody answers who could be one
        return false;
    }
}
bool CorbaNaming::isNamingContext(const CosNaming::Name& name) {
    CORBA::Object_var object = resolve(name);
    return isNamingContext(object.in());
}
bool CorbaNaming::isNamingContext(const char* string_name) { return isNamingContext(toName(string_name)); }

CosNaming::Name CorbaNaming::subName(const CosNaming::Name& name, CORBA::Long begin, CORBA::Long end) {
    const auto length = static_cast<CORBA::Long>(name.length());
    if (end < 0 || end >= length) end = length - 1;
    CosNaming::Name part;
    part.length(static_cast<CORBA::ULong>(std::max<CORBA::Long>(end - begin + 1, 0)));
    for (CORBA::ULong i = 0; i < part.length(); ++i) part[i] = name[static_cast<CORBA::ULong>(begin) + i];
    return part;
}

} // namespace RTC
