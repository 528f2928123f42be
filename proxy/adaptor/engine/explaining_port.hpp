// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

namespace tandem::adaptor::engine {

/// Logs the line if the engine does not ask for it.
void report_type_error(const std::string& line);

/// A port that explains why it cannot be connected. `Base` is a port class of the API.
template <class Base>
class ExplainingPort : public Base {
  public:
    using Base::Base;
#ifndef TANDEM_OPROS_PUBLIC_API
    std::string typeError() const override { return type_error_; }
#endif

  protected:
    /// Sets what the engine reports about the last connection; empty if it was made.
    void set_type_error(std::string error) {
        type_error_ = std::move(error);
        if (!type_error_.empty()) report_type_error(type_error_);
    }
    const std::string& type_error() const { return type_error_; }

  private:
    std::string type_error_;
};

} // namespace tandem::adaptor::engine
