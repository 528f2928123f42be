// SPDX-License-Identifier: Apache-2.0
// The part of CorbaNaming that changes a name server: bind, rebind and unbind of objects and contexts. With
// `force`, contexts on the way that do not exist yet are created, as in OpenRTM-aist.
#include <rtm/CorbaNaming.h>

namespace RTC {
namespace {

using Context = CosNaming::NamingContext;

// The context of the last part of `name`, created with all those above it when it does not exist. Throws
// CannotProceed when an object that is not a context has the name of one of them.
CosNaming::NamingContext_ptr find_or_create_parent(CosNaming::NamingContext_ptr context,
                                                   const CosNaming::Name& name) {
    CosNaming::NamingContext_var parent = Context::_duplicate(context);
    for (CORBA::ULong depth = 0; depth + 1 < name.length(); ++depth) {
        const CosNaming::Name part =
            CorbaNaming::subName(name, static_cast<CORBA::Long>(depth), static_cast<CORBA::Long>(depth));
        try {
            parent = parent->bind_new_context(part);
        } catch (const Context::AlreadyBound&) {
            CORBA::Object_var bound = parent->resolve(part);
            CosNaming::NamingContext_var next = Context::_narrow(bound.in());
            if (CORBA::is_nil(next.in())) throw Context::CannotProceed(parent.in(), part);
            parent = next;
        }
    }
    return parent._retn();
}

CosNaming::Name last_part(const CosNaming::Name& name) {
    if (name.length() == 0) throw Context::InvalidName();
    return CorbaNaming::subName(name, static_cast<CORBA::Long>(name.length()) - 1);
}

// Tries `direct` first, because the contexts exist as a rule; with `force`, `recursive` creates them.
template <class Direct, class Recursive>
void bind_with_contexts(bool force, Direct direct, Recursive recursive) {
    try {
        direct();
    } catch (const Context::NotFound&) {
        if (!force) throw;
        recursive();
    }
}

} // namespace

// Throws AlreadyBound when the name is in use.
void CorbaNaming::bind(const CosNaming::Name& name, CORBA::Object_ptr obj, bool force) {
    bind_with_contexts(
        force, [&] { m_rootContext->bind(name, obj); },
        [&] { bindRecursive(m_rootContext.in(), name, obj); });
}
void CorbaNaming::bindByString(const char* string_name, CORBA::Object_ptr obj, bool force) {
    bind(toName(string_name), obj, force);
}
void CorbaNaming::bindRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                                CORBA::Object_ptr obj) {
    CosNaming::NamingContext_var parent = find_or_create_parent(context, name);
    parent->bind(last_part(name), obj);
}

// Replaces another object of the name.
void CorbaNaming::rebind(const CosNaming::Name& name, CORBA::Object_ptr obj, bool force) {
    bind_with_contexts(
        force, [&] { m_rootContext->rebind(name, obj); },
        [&] { rebindRecursive(m_rootContext.in(), name, obj); });
}
void CorbaNaming::rebindByString(const char* string_name, CORBA::Object_ptr obj, bool force) {
    rebind(toName(string_name), obj, force);
}
void CorbaNaming::rebindRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                                  CORBA::Object_ptr obj) {
    CosNaming::NamingContext_var parent = find_or_create_parent(context, name);
    parent->rebind(last_part(name), obj);
}

// The same two for contexts: a name server resolves names through contexts that are bound as such.
void CorbaNaming::bindContext(const CosNaming::Name& name, CosNaming::NamingContext_ptr name_cxt,
                              bool force) {
    bind_with_contexts(
        force, [&] { m_rootContext->bind_context(name, name_cxt); },
        [&] { bindContextRecursive(m_rootContext.in(), name, name_cxt); });
}
void CorbaNaming::bindContext(const char* string_name, CosNaming::NamingContext_ptr name_cxt, bool force) {
    bindContext(toName(string_name), name_cxt, force);
}
void CorbaNaming::bindContextRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                                       CosNaming::NamingContext_ptr name_cxt) {
    CosNaming::NamingContext_var parent = find_or_create_parent(context, name);
    parent->bind_context(last_part(name), name_cxt);
}

void CorbaNaming::rebindContext(const CosNaming::Name& name, CosNaming::NamingContext_ptr name_cxt,
                                bool force) {
    bind_with_contexts(
        force, [&] { m_rootContext->rebind_context(name, name_cxt); },
        [&] { rebindContextRecursive(m_rootContext.in(), name, name_cxt); });
}
void CorbaNaming::rebindContext(const char* string_name, CosNaming::NamingContext_ptr name_cxt, bool force) {
    rebindContext(toName(string_name), name_cxt, force);
}
void CorbaNaming::rebindContextRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                                         CosNaming::NamingContext_ptr name_cxt) {
    CosNaming::NamingContext_var parent = find_or_create_parent(context, name);
    parent->rebind_context(last_part(name), name_cxt);
}

void CorbaNaming::unbind(const CosNaming::Name& name) { m_rootContext->unbind(name); }
void CorbaNaming::unbind(const char* string_name) { unbind(toName(string_name)); }

CosNaming::NamingContext_ptr CorbaNaming::newContext() { return m_rootContext->new_context(); }
// Creates a context and binds it; the caller releases the reference.
CosNaming::NamingContext_ptr CorbaNaming::bindNewContext(const CosNaming::Name& name, bool force) {
    CosNaming::NamingContext_var created;
    bind_with_contexts(
        force, [&] { created = m_rootContext->bind_new_context(name); },
        [&] {
            CosNaming::NamingContext_var parent = find_or_create_parent(m_rootContext.in(), name);
            created = parent->bind_new_context(last_part(name));
        });
    return created._retn();
}
CosNaming::NamingContext_ptr CorbaNaming::bindNewContext(const char* string_name, bool force) {
    return bindNewContext(toName(string_name), force);
}
void CorbaNaming::destroy(CosNaming::NamingContext_ptr context) { context->destroy(); }

// Binds `obj`, or returns what has the name already.
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
        CORBA::Object_var bound = context->resolve(name);
        return Context::_narrow(bound.in());
    }
}
CosNaming::NamingContext_ptr CorbaNaming::bindOrResolveContext(CosNaming::NamingContext_ptr context,
                                                               const CosNaming::Name& name) {
    CosNaming::NamingContext_var created = newContext();
    return bindOrResolveContext(context, name, created.in());
}

} // namespace RTC
