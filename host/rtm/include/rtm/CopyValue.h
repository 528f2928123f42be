// SPDX-License-Identifier: Apache-2.0
// Ours: copies the values of data ports.
#ifndef RTC_COPYVALUE_H
#define RTC_COPYVALUE_H
#include <rtm/CopyBytes.h>
#include <rtm/idl/BasicDataTypeSkel.h>
#include <type_traits>
#include <utility>

namespace RTC {
namespace detail {

/// Copies like `to = from`. omniORB assigns element by element, which takes 0.4 ns per byte of an octet sequence,
/// because the compiler must assume that writing a byte may change the sequence's length.
template <class Sequence>
void copy_numbers(Sequence& to, const Sequence& from) {
    if (&to == &from) return;
    const CORBA::ULong length = from.length();
    if (to.maximum() < length) to.length(0); // otherwise its content would be copied into the larger buffer
    to.length(length);
    copyBytes(to.get_buffer(), from.NP_data(), length * sizeof(*from.NP_data()));
}

/// Exchanges the memory of two sequences. Returns false, without side effects, if one of them does not own its memory
/// or their length is bounded.
template <class Sequence>
auto exchange_numbers(Sequence& to, Sequence& from, int)
    -> decltype(to.replace(0, 0, to.get_buffer(), true), bool()) {
    if (&to == &from || !to.release() || !from.release()) return false;
    const CORBA::ULong length = from.length(), room = from.maximum(), other_room = to.maximum();
    auto* const numbers = from.get_buffer(true);
    from.replace(other_room, 0, to.get_buffer(true), true);
    to.replace(room, length, numbers, true);
    return true;
}
template <class Sequence>
bool exchange_numbers(Sequence&, Sequence&, long) {
    return false;
}

template <class Sequence>
using has_numbers = std::is_arithmetic<
    typename std::remove_reference<decltype(*std::declval<Sequence&>().get_buffer())>::type>;

/// Tests for exactly `struct { Time tm; sequence<a number> data; }`.
template <class DataType, class = void>
struct is_timed_sequence : std::false_type {};
template <class DataType>
struct is_timed_sequence<DataType,
                         typename std::enable_if<std::is_same<decltype(DataType::tm), Time>::value &&
                                                 has_numbers<decltype(DataType::data)>::value>::type> {
    struct Form {
        Time tm;
        decltype(DataType::data) data;
    };
    typedef std::integral_constant<bool, sizeof(DataType) == sizeof(Form)> type;
};

/// Tests for exactly the members of RTC::CameraImage.
template <class DataType, class = void>
struct is_camera_image : std::false_type {};
template <class DataType>
struct is_camera_image<DataType,
                       typename std::enable_if<std::is_same<decltype(DataType::tm), Time>::value &&
                                               has_numbers<decltype(DataType::pixels)>::value>::type> {
    struct Form {
        Time tm;
        decltype(DataType::width) width;
        decltype(DataType::height) height;
        decltype(DataType::bpp) bpp;
        decltype(DataType::format) format;
        decltype(DataType::fDiv) fDiv;
        decltype(DataType::pixels) pixels;
    };
    typedef std::integral_constant<bool, sizeof(DataType) == sizeof(Form)> type;
};

template <class DataType>
void copy_value(DataType& to, const DataType& from, std::false_type, std::false_type) {
    to = from;
}
template <class DataType>
void copy_value(DataType& to, const DataType& from, std::true_type, std::false_type) {
    to.tm = from.tm;
    copy_numbers(to.data, from.data);
}
template <class DataType>
void copy_all_but_pixels(DataType& to, const DataType& from) {
    to.tm = from.tm;
    to.width = from.width;
    to.height = from.height;
    to.bpp = from.bpp;
    to.format = from.format;
    to.fDiv = from.fDiv;
}
template <class DataType>
void copy_value(DataType& to, const DataType& from, std::false_type, std::true_type) {
    copy_all_but_pixels(to, from);
    copy_numbers(to.pixels, from.pixels);
}

/// Return the size of a value's numbers in bytes, and exchange them after copying everything else. 0 or false for
/// other types.
template <class DataType>
std::size_t number_bytes(const DataType&, std::false_type, std::false_type) {
    return 0;
}
template <class DataType>
std::size_t number_bytes(const DataType& value, std::true_type, std::false_type) {
    return value.data.length() * sizeof(*value.data.NP_data());
}
template <class DataType>
std::size_t number_bytes(const DataType& value, std::false_type, std::true_type) {
    return value.pixels.length() * sizeof(*value.pixels.NP_data());
}
template <class DataType>
bool exchange_value(DataType&, DataType&, std::false_type, std::false_type) {
    return false;
}
template <class DataType>
bool exchange_value(DataType& to, DataType& from, std::true_type, std::false_type) {
    to.tm = from.tm;
    return exchange_numbers(to.data, from.data, 0);
}
template <class DataType>
bool exchange_value(DataType& to, DataType& from, std::false_type, std::true_type) {
    copy_all_but_pixels(to, from);
    return exchange_numbers(to.pixels, from.pixels, 0);
}

} // namespace detail

/// Copies like `to = from`. Fast also for a long sequence of numbers in a Timed type, and for images.
template <class DataType>
void copyValue(DataType& to, const DataType& from) {
    detail::copy_value(to, from, typename detail::is_timed_sequence<DataType>::type(),
                       typename detail::is_camera_image<DataType>::type());
}

/// Returns true if a value (numbers or an image) is so long that takeValue() saves more than it costs to move the
/// value's memory.
template <class DataType>
bool isLong(const DataType& value) {
    return detail::number_bytes(value, typename detail::is_timed_sequence<DataType>::type(),
                                typename detail::is_camera_image<DataType>::type()) >= 65536;
}

/// Assigns like copyValue(), for a long value that is no longer needed. Returns true if the two values have exchanged
/// the memory of their numbers (`from` then no longer has its value), false if the value was copied.
template <class DataType>
bool takeValue(DataType& to, DataType& from) {
    if (detail::exchange_value(to, from, typename detail::is_timed_sequence<DataType>::type(),
                               typename detail::is_camera_image<DataType>::type()))
        return true;
    copyValue(to, from);
    return false;
}

} // namespace RTC
#endif
