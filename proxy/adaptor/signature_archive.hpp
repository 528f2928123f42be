// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <archive/opros_archive.h>

#include <string>

namespace tandem::adaptor {

/// Learns a type's signature by letting the type load itself: gives zeros, claims one element in every
/// sequence, and writes down what it is asked for. A user's load() that asks for different things depending
/// on what it was given shows the branch that zeros lead to.
class SignatureArchive final : public opros::archive::iarchive {
  public:
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
