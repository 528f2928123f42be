// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/check/definitions.hpp"

#include "apps/tandem/mcap/format/utf8.hpp"

namespace tandem::mcap {
namespace {

void check_text(const RecordView& record, const char* field, const std::string& text, Findings& findings) {
    if (!is_utf8(text)) findings.error("{} has a {} that is not UTF-8", name_of(record), field);
}

template <typename Definition>
void add(const RecordView& record, Definition definition, std::map<std::uint16_t, Definition>& known,
         Findings& findings) {
    const auto [before, is_new] = known.try_emplace(definition.id, definition);
    if (!is_new && !(before->second == definition))
        findings.error("{} differs from an earlier one with the id {}", name_of(record), definition.id);
}

} // namespace

void check_schema(const RecordView& record, Definitions& known, Findings& findings) {
    auto schema = parsed<Schema>(record.content);
    if (schema.id == 0) findings.error("{} has the id 0, which is reserved", name_of(record));
    if (schema.encoding.empty() && !schema.data.empty())
        findings.error("{} (id {}) has data, but no encoding", name_of(record), schema.id);
    if (schema.encoding.empty() && schema.data.empty())
        findings.warning("{} (id {}) has neither encoding nor data", name_of(record), schema.id);
    check_text(record, "name", schema.name, findings);
    check_text(record, "encoding", schema.encoding, findings);
    add(record, std::move(schema), known.schemas, findings);
}

void check_channel(const RecordView& record, Definitions& known, Findings& findings) {
    auto channel = parsed<Channel>(record.content);
    if (channel.schema_id != 0 && !known.schemas.contains(channel.schema_id))
        findings.error("{} (id {}) has the schema {}, which the file does not define before it",
                       name_of(record), channel.id, channel.schema_id);
    check_text(record, "topic", channel.topic, findings);
    check_text(record, "message encoding", channel.message_encoding, findings);
    for (const auto& [key, value] : channel.metadata) {
        check_text(record, "metadata key", key, findings);
        check_text(record, "metadata value", value, findings);
    }
    add(record, std::move(channel), known.channels, findings);
}

} // namespace tandem::mcap
