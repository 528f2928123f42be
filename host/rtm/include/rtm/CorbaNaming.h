// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_CORBANAMING_H
#define RTC_CORBANAMING_H
#include <omniORB4/Naming.hh>
#include <rtm/RTC.h>
#include <string>
#include <vector>

namespace RTC {

/// A client of one CORBA name server. Names as strings are `id.kind/id.kind` (CosNaming's stringified names). Unless
/// stated otherwise, the functions throw CORBA::SystemException and the exceptions of CosNaming. The caller owns
/// returned references.
class CorbaNaming {
  public:
    using SystemException = CORBA::SystemException;
    using NotFound = CosNaming::NamingContext::NotFound;
    using CannotProceed = CosNaming::NamingContext::CannotProceed;
    using InvalidName = CosNaming::NamingContext::InvalidName;
    using AlreadyBound = CosNaming::NamingContext::AlreadyBound;
    using NotEmpty = CosNaming::NamingContext::NotEmpty;
    using InvalidAddress = CosNaming::NamingContextExt::InvalidAddress;
    using ObjectList = std::vector<CORBA::Object_ptr>;

    explicit CorbaNaming(CORBA::ORB_ptr orb);
    /// `name_server` is `host`, `host:port` or a corbaloc. Throws std::bad_alloc, like OpenRTM-aist, if there is no
    /// name server.
    CorbaNaming(CORBA::ORB_ptr orb, const char* name_server);
    virtual ~CorbaNaming() = default;
    void init(const char* name_server);
    /// Returns true if the server answers.
    bool isAlive();

    // `force` creates the contexts on the way to the name.
    void bind(const CosNaming::Name& name, CORBA::Object_ptr obj, bool force = true);
    void bindByString(const char* string_name, CORBA::Object_ptr obj, bool force = true);
    void bindRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                       CORBA::Object_ptr obj);
    void rebind(const CosNaming::Name& name, CORBA::Object_ptr obj, bool force = true);
    void rebindByString(const char* string_name, CORBA::Object_ptr obj, bool force = true);
    void rebindRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                         CORBA::Object_ptr obj);
    void bindContext(const CosNaming::Name& name, CosNaming::NamingContext_ptr name_cxt, bool force = true);
    void bindContext(const char* string_name, CosNaming::NamingContext_ptr name_cxt, bool force = true);
    void bindContextRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                              CosNaming::NamingContext_ptr name_cxt);
    void rebindContext(const CosNaming::Name& name, CosNaming::NamingContext_ptr name_cxt, bool force = true);
    void rebindContext(const char* string_name, CosNaming::NamingContext_ptr name_cxt, bool force = true);
    void rebindContextRecursive(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                                CosNaming::NamingContext_ptr name_cxt);

    CORBA::Object_ptr resolve(const CosNaming::Name& name);
    CORBA::Object_ptr resolve(const char* string_name);
    CORBA::Object_ptr resolveStr(const char* string_name) { return resolve(string_name); }
    void unbind(const CosNaming::Name& name);
    void unbind(const char* string_name);

    CosNaming::NamingContext_ptr newContext();
    CosNaming::NamingContext_ptr bindNewContext(const CosNaming::Name& name, bool force = true);
    CosNaming::NamingContext_ptr bindNewContext(const char* string_name, bool force = true);
    static void destroy(CosNaming::NamingContext_ptr context);
    /// Removes all bindings of the context and of its inner contexts. Does not change the bound objects.
    void destroyRecursive(CosNaming::NamingContext_ptr context);
    /// Removes all bindings of the server.
    void clearAll();

    static void list(CosNaming::NamingContext_ptr name_cxt, CORBA::ULong how_many,
                     CosNaming::BindingList_var& bl, CosNaming::BindingIterator_var& bi);
    /// Sets `bl` to all entries of a context.
    void list(const char* string_name, CosNaming::BindingList_var& bl);
    void listByKind(const char* string_name, const char* string_kind, CosNaming::BindingList_var& bl);

    /// The caller frees the result with CORBA::string_free().
    static char* toString(const CosNaming::Name& name);
    static CosNaming::Name toName(const char* string_name);
    char* toUrl(char* addr, char* string_name);

    /// Binds the object, or returns the object that is already bound to the name.
    static CORBA::Object_ptr bindOrResolve(CosNaming::NamingContext_ptr context, const CosNaming::Name& name,
                                           CORBA::Object_ptr obj);
    static CosNaming::NamingContext_ptr bindOrResolveContext(CosNaming::NamingContext_ptr context,
                                                             const CosNaming::Name& name,
                                                             CosNaming::NamingContext_ptr new_context);
    CosNaming::NamingContext_ptr bindOrResolveContext(CosNaming::NamingContext_ptr context,
                                                      const CosNaming::Name& name);

    const char* getNameServer() { return m_nameServer.c_str(); }
    CosNaming::NamingContext_ptr getRootContext() {
        return CosNaming::NamingContext::_duplicate(m_rootContext.in());
    }
    /// Returns false also for an object that cannot be reached.
    static bool isNamingContext(CORBA::Object_ptr obj);
    bool isNamingContext(const CosNaming::Name& name);
    bool isNamingContext(const char* string_name);
    /// Returns the elements `begin` to `end`, inclusive. A negative `end` means the last element.
    static CosNaming::Name subName(const CosNaming::Name& name, CORBA::Long begin, CORBA::Long end = -1);

  protected:
    CORBA::ORB_var m_varORB;
    std::string m_nameServer;
    CosNaming::NamingContextExt_var m_rootContext;
    CORBA::ULong m_blLength = 100; // number of entries requested in one call
};

} // namespace RTC
#endif
