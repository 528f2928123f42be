// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/archive/cdr_archive.hpp"

#include "proxy/wire/time.hpp"
#include "proxy/wire/wide_text.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

namespace tandem::adaptor {

using opros::archive::archive_type_exception;
using opros::archive::iarchive;
using opros::archive::oarchive;

namespace {

template <class T>
void put(wire::CdrWriter& out, T value) {
    if constexpr (std::is_same_v<T, bool>)
        out.put_bool(value);
    else if constexpr (!std::is_same_v<T, wchar_t>)
        out.put(value);
    else if (!wire::put_wide_character(out, value))
        throw RefusedText::beyond_16_bits();
}

/// An array of primitives in one copy; `size` is its element count.
template <class T>
void put_all(wire::CdrWriter& out, const T* p, long size) {
    if constexpr (std::is_same_v<T, wchar_t>)
        for (long i = 0; i < size; ++i) put(out, p[i]);
    else if (size > 0)
        out.put_block(p, sizeof(T) * static_cast<std::size_t>(size), wire::cdr_alignment<T>);
}

template <class T>
void put_sequence(wire::CdrWriter& out, const T* p, std::size_t count) {
    if constexpr (std::is_same_v<T, wchar_t>) {
        out.put(static_cast<std::uint32_t>(count));
        put_all(out, p, static_cast<long>(count));
    } else {
        out.put_sequence(p, count);
    }
}

template <class T>
void get(wire::CdrReader& in, T& value) {
    if constexpr (std::is_same_v<T, bool>)
        value = in.get_bool();
    else if constexpr (std::is_same_v<T, wchar_t>)
        value = wire::get_wide_character(in);
    else
        value = in.get<T>();
}

template <class T>
void get_all(wire::CdrReader& in, T* p, long size) {
    if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, wchar_t>) {
        for (long i = 0; i < size; ++i) get(in, p[i]); // one by one: a byte of 2 is not a bool
    } else if (size > 0) {
        const auto block = in.get_block(sizeof(T) * static_cast<std::size_t>(size), wire::cdr_alignment<T>);
        wire::copy_long(p, block.data(), block.size());
    }
}

/// Copies numbers as one block if every bit pattern is valid. All others are checked one by one.
template <class T>
void get_sequence(wire::CdrReader& in, std::vector<T>& values) {
    if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, wchar_t>) {
        values.resize(in.get_count(1));
        for (std::size_t i = 0; i < values.size(); ++i) {
            T value{};
            get(in, value);
            values[i] = value;
        }
    } else {
        const auto block = in.get_sequence(sizeof(T), wire::cdr_alignment<T>);
        const std::size_t count = block.size() / sizeof(T);
        if (values.size() != count) values.resize(count);
        wire::copy_block(values.data(), block.data(), block.size());
    }
}

} // namespace

/// Takes `value` as a word of the leading time if one is still missing. The signatures were compared before,
/// so the first two words that the value writes are known to be RTM's seconds and nanoseconds.
template <class T>
bool CdrOarchive::store_time_word(T value) {
    if constexpr (std::is_same_v<T, unsigned int>) {
        if (time_words_left_ == 0) return false;
        const bool seconds = time_words_left_-- == 2;
        *time_ = seconds ? wire::pack_time(value, 0) : *time_ | wire::pack_time(0, value);
        return true;
    } else {
        return false;
    }
}

/// Returns the next word of the leading time in `value` if one is still missing.
template <class T>
bool CdrIarchive::load_time_word(T& value) {
    if constexpr (std::is_same_v<T, unsigned int>) {
        if (time_words_left_ == 0) return false;
        value = time_words_left_-- == 2 ? wire::stamp_seconds(time_) : wire::stamp_nanoseconds(time_);
        return true;
    } else {
        return false;
    }
}

#define TANDEM_SAVE(type)                                                                                    \
    oarchive& CdrOarchive::save(type value) {                                                                \
        if (!store_time_word(value)) put(out_, value);                                                       \
        return *this;                                                                                        \
    }                                                                                                        \
    oarchive& CdrOarchive::save_array(const type* p, long size) {                                            \
        put_all(out_, p, size);                                                                              \
        return *this;                                                                                        \
    }                                                                                                        \
    oarchive& CdrOarchive::save_sequence(const type* p, std::size_t count) {                                 \
        put_sequence(out_, p, count);                                                                        \
        return *this;                                                                                        \
    }
OPROS_FOR_EACH_PRIMITIVE(TANDEM_SAVE)
#undef TANDEM_SAVE

oarchive& CdrOarchive::save(const std::string& value) {
    // CORBA strings cannot hold a NUL: the receiver would silently lose what follows it.
    if (value.find('\0') != std::string::npos) throw RefusedText::with_nul();
    out_.put_string(value);
    return *this;
}

oarchive& CdrOarchive::save(const std::wstring& value) {
    if (value.find(L'\0') != std::wstring::npos) throw RefusedText::with_nul();
    if (!wire::put_wide_string(out_, value)) throw RefusedText::beyond_16_bits();
    return *this;
}

oarchive& CdrOarchive::save_binary(const char* p, long size) {
    // A user's save() gives the size, and may have computed it from anything.
    if (size < 0 || size > std::numeric_limits<std::uint32_t>::max())
        throw opros::archive::archive_array_size_exception();
    write_sequence_head(static_cast<std::size_t>(size));
    out_.put_block(p, static_cast<std::size_t>(size), 1);
    return *this;
}

oarchive& CdrOarchive::write_sequence_head(std::size_t count) {
    out_.put(static_cast<std::uint32_t>(count));
    return *this;
}

void CdrIarchive::check() const {
    if (!in_.ok()) throw archive_type_exception();
}

#define TANDEM_LOAD(type)                                                                                    \
    iarchive& CdrIarchive::load(type& value) {                                                               \
        if (load_time_word(value)) return *this;                                                             \
        get(in_, value);                                                                                     \
        check();                                                                                             \
        return *this;                                                                                        \
    }                                                                                                        \
    iarchive& CdrIarchive::load_array(type* p, long size) {                                                  \
        get_all(in_, p, size);                                                                               \
        check();                                                                                             \
        return *this;                                                                                        \
    }                                                                                                        \
    iarchive& CdrIarchive::load_sequence(std::vector<type>& values) {                                        \
        get_sequence(in_, values);                                                                           \
        check();                                                                                             \
        return *this;                                                                                        \
    }
OPROS_FOR_EACH_PRIMITIVE(TANDEM_LOAD)
#undef TANDEM_LOAD

iarchive& CdrIarchive::load(std::string& value) {
    value = in_.get_string();
    check();
    return *this;
}

iarchive& CdrIarchive::load(std::wstring& value) {
    wire::get_wide_string(in_, value);
    check();
    return *this;
}

iarchive& CdrIarchive::load_binary(char** p, long& size) {
    const std::size_t count = read_sequence_head();
    const auto block = in_.get_block(count, 1);
    check();
    // The archive's contract: without a buffer this function allocates one for the caller to delete.
    if (*p == nullptr)
        *p = new char[count];
    else if (static_cast<long>(count) > size)
        throw opros::archive::archive_array_size_exception();
    std::copy_n(reinterpret_cast<const char*>(block.data()), count, *p);
    size = static_cast<long>(count);
    return *this;
}

std::size_t CdrIarchive::read_sequence_head() {
    const auto count = in_.get_count(1); // an element takes a byte at least
    check();
    return count;
}

} // namespace tandem::adaptor
