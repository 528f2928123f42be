// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <omniORB4/CORBA.h>

#include <string>
#include <utility>

namespace tandem::interceptor {

/// A value that its type allows and that cannot cross, with the reason. Callers get CORBA::MARSHAL.
class RefusedValue final : public CORBA::MARSHAL {
  public:
    explicit RefusedValue(std::string reason, CORBA::CompletionStatus completed = CORBA::COMPLETED_NO)
        : CORBA::MARSHAL(0, completed), reason_(std::move(reason)) {}
    const std::string& reason() const { return reason_; }

  private:
    std::string reason_;
};

/// Returns the reason of a RefusedValue, or the name of another exception: `MARSHAL`.
inline std::string reason_of(const CORBA::Exception& error) {
    const auto* const refused = dynamic_cast<const RefusedValue*>(&error);
    return refused ? refused->reason() : error._name();
}

/// Runs a function that converts what a call returns: the exceptions say that the call has run.
template <class Function>
void convert_results(const Function& convert) {
    try {
        convert();
    } catch (const CORBA::SystemException& error) {
        throw RefusedValue(reason_of(error), CORBA::COMPLETED_YES);
    }
}

} // namespace tandem::interceptor
