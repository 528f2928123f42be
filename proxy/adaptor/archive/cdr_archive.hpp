// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/archive/refused_text.hpp"
#include "proxy/wire/cdr.hpp"

#include <archive/opros_archive.h>

namespace tandem::adaptor {

/// Makes a type's own serialization write CDR. The bytes are those of the IDL structure with the same members: a class adds
/// none, a sequence is its count and its elements, `long` is 8 bytes. Throws RefusedText for a string with a NUL and for
/// characters beyond U+FFFF, which CORBA's strings cannot hold.
class CdrOarchive final : public opros::archive::oarchive {
  public:
    /// `time`: for a value that begins with RTM's time. The time goes there, for the message header, and not into the
    /// payload. Otherwise NULL.
    explicit CdrOarchive(wire::CdrWriter& out, std::uint64_t* time = nullptr)
        : out_(out), time_(time), time_words_left_(time ? 2 : 0) {}

#define TANDEM_SAVE(type)                                                                                    \
    oarchive& save(type value) override;                                                                     \
    oarchive& save_array(const type* p, long size) override;                                                 \
    oarchive& save_sequence(const type* p, std::size_t count) override;
    OPROS_FOR_EACH_PRIMITIVE(TANDEM_SAVE)
#undef TANDEM_SAVE
    oarchive& save(const std::string& value) override;
    oarchive& save(const std::wstring& value) override;
    oarchive& save_binary(const char* p, long size) override;
    oarchive& write_sequence_head(std::size_t count) override;

    using oarchive::save;

  private:
    template <class T>
    bool store_time_word(T value);

    wire::CdrWriter& out_;
    std::uint64_t* const time_;
    int time_words_left_; ///< 2: seconds are next; 1: nanoseconds; 0: no time, or time complete
};

/// Makes a type's own serialization read CDR. The bytes come from another process: every read is checked. Throws
/// archive_type_exception if the bytes do not contain the requested value.
class CdrIarchive final : public opros::archive::iarchive {
  public:
    /// `has_time`: for a value that begins with RTM's time. The time comes from `time` (wire::pack_time()), not from `in`.
    explicit CdrIarchive(wire::CdrReader in, std::uint64_t time = 0, bool has_time = false)
        : in_(in), time_(time), time_words_left_(has_time ? 2 : 0) {}

#define TANDEM_LOAD(type)                                                                                    \
    iarchive& load(type& value) override;                                                                    \
    iarchive& load_array(type* p, long size) override;                                                       \
    iarchive& load_sequence(std::vector<type>& values) override;
    OPROS_FOR_EACH_PRIMITIVE(TANDEM_LOAD)
#undef TANDEM_LOAD
    iarchive& load(std::string& value) override;
    iarchive& load(std::wstring& value) override;
    iarchive& load_binary(char** p, long& size) override;
    std::size_t read_sequence_head() override;

    using iarchive::load;

  private:
    template <class T>
    bool load_time_word(T& value);
    void check() const;

    wire::CdrReader in_;
    std::uint64_t time_;
    int time_words_left_; ///< 2: seconds are next; 1: nanoseconds; 0: no time, or time complete
};

} // namespace tandem::adaptor
