// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <archive/opros_archive.h>

#include <string>

namespace tandem::adaptor {

/// Learns a type's signature by letting the type's own load() read from it: returns zeros, claims one element
/// in every sequence, and appends the type code of whatever is asked for (see proxy/wire/README.md). A load()
/// that reads different members depending on the values it got shows the branch that zeros lead to. Throws
/// archive_type_exception for long double and wide characters, which CDR cannot carry here.
class SignatureArchive final : public opros::archive::iarchive {
  public:
    /// What was asked for so far; not in canonical form, since classes leave parentheses.
    const std::string& signature() const { return signature_; }

#define TANDEM_LOAD(type) iarchive& load(type& value) override;
    OPROS_FOR_EACH_PRIMITIVE(TANDEM_LOAD)
#undef TANDEM_LOAD
    iarchive& load(std::string& value) override;
    iarchive& load(std::wstring& value) override;
    iarchive& load_binary(char** p, long& size) override;
    std::size_t read_sequence_head() override;
    iarchive& read_class_head(const std::string&) override;
    iarchive& read_class_end(const std::string&) override;
    long read_array_head(long size, char, char) override;

    using iarchive::load;

  private:
    std::string signature_;
};

} // namespace tandem::adaptor
