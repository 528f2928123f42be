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

// Calls bind_in(parent, last part of the name); the contexts that the name goes through are created.
template <class BindIn>
void bind_recursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name, BindIn bind_in) {
    CosNaming::NamingContext_var parent = find_or_create_parent(context, name);
    bind_in(parent.in(), last_part(name));
}

// Tries the whole name first, because the contexts usually exist. With `force`, creates those that do not.
template <class BindIn>
void bind_name(CosNaming::NamingContext_ptr root, const CosNaming::Name& name, bool force, BindIn bind_in) {
    try {
        bind_in(root, name);
    } catch (const Context::NotFound&) {
        if (!force) throw;
        bind_recursive(root, name, bind_in);
    }
}

// The functions to call with a context and the name in it. A context is bound as a context, because a name server
// resolves names only through such entries.
auto bind_object(CORBA::Object_ptr object) {
    return [=](CosNaming::NamingContext_ptr in, const CosNaming::Name& name) { in->bind(name, object); };
}
auto rebind_object(CORBA::Object_ptr object) {
    return [=](CosNaming::NamingContext_ptr in, const CosNaming::Name& name) { in->rebind(name, object); };
}
auto bind_context(CosNaming::NamingContext_ptr context) {
    return [=](CosNaming::NamingContext_ptr in, const CosNaming::Name& name) {
        in->bind_context(name, context);
    };
}
auto rebind_context(CosNaming::NamingContext_ptr context) {
    return [=](CosNaming::NamingContext_ptr in, const CosNaming::Name& name) {
        in->rebind_context(name, context);
    };
}

} // namespace

// bind throws AlreadyBound if the name is in use. rebind replaces the bound object.
void CorbaNaming::bind(const CosNaming::Name& name, CORBA::Object_ptr obj, bool force) {
    bind_name(m_rootContext.in(), name, force, bind_object(obj));
}
void CorbaNaming::rebind(const CosNaming::Name& name, CORBA::Object_ptr obj, bool force) {
    bind_name(m_rootContext.in(), name, force, rebind_object(obj));
}
void CorbaNaming::bindContext(const CosNaming::Name& name, CosNaming::NamingContext_ptr name_cxt,
                              bool force) {
    bind_name(m_rootContext.in(), name, force, bind_context(name_cxt));
}
void CorbaNaming::rebindContext(const CosNaming::Name& name, CosNaming::NamingContext_ptr name_cxt,
                                bool force) {
    bind_name(m_rootContext.in(), name, force, rebind_context(name_cxt));
}

// bind, rebind, bindContext and rebindContext with the name as a string.
void CorbaNaming::bindByString(const char* string_name, CORBA::Object_ptr obj, bool force) {
    bind(toName(string_name), obj, force);
}
void CorbaNaming::rebindByString(const char* string_name, CORBA::Object_ptr obj, bool force) {
    rebind(toName(string_name), obj, force);
}
void CorbaNaming::bindContext(const char* string_name, CosNaming::NamingContext_ptr name_cxt, bool force) {
    bindContext(toName(string_name), name_cxt, force);
}
void CorbaNaming::rebindContext(const char* string_name, CosNaming::NamingContext_ptr name_cxt, bool force) {
    rebindContext(toName(string_name), name_cxt, force);
}

// bind, rebind, bindContext and rebindContext in a context other than the root.
void CorbaNaming::bindRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                                CORBA::Object_ptr obj) {
    bind_recursive(context, name, bind_object(obj));
}
void CorbaNaming::rebindRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                                  CORBA::Object_ptr obj) {
    bind_recursive(context, name, rebind_object(obj));
}
void CorbaNaming::bindContextRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                                       CosNaming::NamingContext_ptr name_cxt) {
    bind_recursive(context, name, bind_context(name_cxt));
}
void CorbaNaming::rebindContextRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                                         CosNaming::NamingContext_ptr name_cxt) {
    bind_recursive(context, name, rebind_context(name_cxt));
}

void CorbaNaming::unbind(const CosNaming::Name& name) { m_rootContext->unbind(name); }
void CorbaNaming::unbind(const char* string_name) { unbind(toName(string_name)); }

CosNaming::NamingContext_ptr CorbaNaming::newContext() { return m_rootContext->new_context(); }
// Creates a context and binds it; the caller releases the reference.
CosNaming::NamingContext_ptr CorbaNaming::bindNewContext(const CosNaming::Name& name, bool force) {
    CosNaming::NamingContext_var created;
    bind_name(m_rootContext.in(), name, force,
              [&](CosNaming::NamingContext_ptr in, const CosNaming::Name& part) {
                  created = in->bind_new_context(part);
              });
    return created._retn();
}
CosNaming::NamingContext_ptr CorbaNaming::bindNewContext(const char* string_name, bool force) {
    return bindNewContext(toName(string_name), force);
}
void CorbaNaming::destroy(CosNaming::NamingContext_ptr context) { context->destroy(); }

// Binds `obj`, or returns the object that already has the name.
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
