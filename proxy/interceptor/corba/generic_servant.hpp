// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"
#include "proxy/wire/operation.hpp"

#include <omniORB4/CORBA.h>

#include <cstddef>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// The target of a GenericServant's calls. Its functions are called in an ORB thread, or in the caller's thread if the
/// caller is in the same process; several at once.
class CallTarget {
  public:
    virtual ~CallTarget() = default;
    /// Returns nullptr if there is no such operation. The result must stay valid as long as the target.
    virtual const wire::Operation* find_operation(const char* name) = 0;
    /// Called when a client calls an operation that does not exist, before the client gets BAD_OPERATION.
    virtual void unknown_operation(const char*) {}
    /// Writes what must precede the arguments of a call, a multiple of 8 bytes. Writes nothing by default.
    virtual void put_head(const wire::Operation&, wire::CdrWriter&) {}
    /// Executes an operation. The head, the arguments after it, and the results are in CDR, the results in `memory`.
    /// Throws failures: CORBA system exceptions, or a GenericUserException that the operation declares.
    virtual std::span<const std::byte> call(const char* name, const wire::Operation&,
                                            std::span<const std::byte> request,
                                            wire::MessageBuffer& memory) = 0;
    /// Called for a value that cannot cross, before the caller gets MARSHAL: `what` is `an argument` or `its result`.
    virtual void value_refused(const char* name, const char* what, const std::string& reason) {
        static_cast<void>(name), static_cast<void>(what), static_cast<void>(reason);
    }
    /// Returns whether `_is_a` is true for a further interface, where the servant's repository id is a guess.
    virtual bool may_be(const char*) const { return false; }
    /// Returns whether calls can be executed now, which `_non_existent` reports to clients.
    virtual bool is_ready() const { return true; }
};

/// A CORBA object of any interface without a compiled skeleton: it converts arguments and results by type signature between
/// the ORB's stream and CDR, and passes the call to a CallTarget. It replaces CORBA's DynamicImplementation, which would
/// build an Any for every value. The first call from this process comes through the ORB; from then on the caller's object
/// reference calls call_from_here() (direct_identity.hpp).
class GenericServant : public virtual PortableServer::ServantBase {
  public:
    /// `repository_id` is the id that a client's _narrow() sees. _is_a() accepts it, its bases as far as this process has
    /// their stubs, and what the target accepts. The target must outlive the servant.
    GenericServant(std::string repository_id, CallTarget& target);

    _CORBA_Boolean _dispatch(omniCallHandle&) override;
    _CORBA_Boolean _is_a(const char* repository_id) override;
    _CORBA_Boolean _non_existent() override { return !target_.is_ready(); }

    /// Executes a call of a compiled stub in this process, from its arguments to its results. Returns false if there is no
    /// such operation.
    bool call_from_here(omniCallDescriptor& call);

  private:
    void execute(const wire::Operation& operation, omniCallDescriptor& call);
    std::span<const char*> exception_ids(const wire::Operation& operation);
    void* _ptrToInterface(const char* repository_id) override;
    const char* _mostDerivedRepoId() override;

    std::string repository_id_;
    CallTarget& target_;
    std::mutex exception_ids_mutex_;
    std::map<const wire::Operation*, std::vector<const char*>> exception_ids_; // of the target's operations
};

} // namespace tandem::interceptor
