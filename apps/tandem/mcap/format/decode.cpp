// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/format/decode.hpp"

#include "apps/tandem/mcap/format/fields.hpp"

#include <array>

namespace tandem::mcap {
namespace {

template <std::integral Number>
void get(FieldReader& from, Number& number) {
    number = from.number<Number>();
}

void get(FieldReader& from, OpCode& op) { op = OpCode{from.number<std::uint8_t>()}; }

void get(FieldReader& from, std::string& text) { text = from.text(); }

void get(FieldReader& from, Bytes& data) {
    const ByteView bytes = from.take(from.number<std::uint32_t>());
    data.assign(bytes.begin(), bytes.end());
}

void get(FieldReader& from, StringMap& map) {
    FieldReader entries(from.take(from.number<std::uint32_t>()));
    while (!entries.rest().empty()) {
        auto key = entries.text();
        map[std::move(key)] = entries.text();
    }
}

template <typename First, typename Second>
void get(FieldReader& from, std::vector<std::pair<First, Second>>& pairs) {
    const ByteView entries = from.take(from.number<std::uint32_t>());
    constexpr std::size_t size = sizeof(First) + sizeof(Second);
    if (entries.size() % size != 0) throw Error("has an array that ends within an entry");
    pairs.reserve(entries.size() / size);
    FieldReader fields(entries);
    while (!fields.rest().empty()) {
        const auto first = fields.number<First>();
        pairs.emplace_back(first, fields.number<Second>());
    }
}

} // namespace

ByteView FieldReader::take(std::uint64_t size) {
    if (size > rest_.size()) throw Error("is shorter than its fields");
    const ByteView taken = rest_.first(size);
    rest_ = rest_.subspan(size);
    return taken;
}

std::string FieldReader::text() {
    const ByteView bytes = take(number<std::uint32_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

template <typename Record>
Record parsed(ByteView content) {
    FieldReader from(content);
    Record record;
    std::apply([&](auto&... field) { (get(from, field), ...); }, fields_of(record));
    if constexpr (std::same_as<Record, Message>) record.data = from.rest();
    return record;
}

template Header parsed(ByteView);
template Footer parsed(ByteView);
template Schema parsed(ByteView);
template Channel parsed(ByteView);
template Message parsed(ByteView);
template ChunkHead parsed(ByteView);
template MessageIndex parsed(ByteView);
template ChunkIndex parsed(ByteView);
template AttachmentIndex parsed(ByteView);
template Metadata parsed(ByteView);
template MetadataIndex parsed(ByteView);
template Statistics parsed(ByteView);
template SummaryOffset parsed(ByteView);
template DataEnd parsed(ByteView);

std::string record_name(OpCode op) {
    constexpr std::array names{"",           "Header",        "Footer",          "Schema",
                               "Channel",    "Message",       "Chunk",           "MessageIndex",
                               "ChunkIndex", "Attachment",    "AttachmentIndex", "Statistics",
                               "Metadata",   "MetadataIndex", "SummaryOffset",   "DataEnd"};
    const auto code = static_cast<std::size_t>(op);
    if (code > 0 && code < names.size()) return names[code];
    constexpr const char* digits = "0123456789ABCDEF";
    return std::string("record 0x") + digits[code / 16] + digits[code % 16];
}

std::optional<RecordView> RecordSequence::next() {
    const ByteView rest = records_.subspan(position_);
    if (rest.size() < record_head_size) return {};
    const auto length = FieldReader(rest.subspan(1)).number<std::uint64_t>();
    if (length > rest.size() - record_head_size) return {};
    const RecordView record{OpCode{std::to_integer<std::uint8_t>(rest[0])},
                            rest.subspan(record_head_size, length), position_};
    position_ += record.size();
    return record;
}

} // namespace tandem::mcap
