// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/check_file.hpp"

#include "apps/tandem/mcap/check/summary_section.hpp"
#include "apps/tandem/mcap/contents.hpp"
#include "apps/tandem/mcap/format/crc32.hpp"
#include "apps/tandem/mcap/read/summary.hpp"

#include <algorithm>
#include <cstring>

namespace tandem::mcap {
namespace {

class FileCheck {
  public:
    explicit FileCheck(File& file) : file_(file) {}

    std::vector<Finding> run() {
        const Header header = read_header(file_, position_);
        if (header.library.empty())
            findings_.warning("the Header does not name the library that wrote the file");
        if (!header.profile.empty() && header.profile != "ros1" && header.profile != "ros2")
            findings_.warning("the Header has the profile \"{}\", which is not well-known", header.profile);
        DataFacts facts = data_section();
        if (ended_) summary_section(facts);
        return findings_.take();
    }

  private:
    /// Calls `use` with each complete record from position_ until `use` returns false. Returns false if the file ends
    /// before.
    template <typename Use>
    bool records(Use use) {
        while (const auto place = file_.record_at(position_)) {
            if (place->op == OpCode{} || !file_.holds(*place)) {
                findings_.error("the {} at byte {} {}", record_name(place->op), place->offset,
                                place->op == OpCode{} ? "has no valid op code"
                                                      : "is longer than the rest of the file");
                return false;
            }
            position_ = place->content() + place->length;
            try {
                if (!use(*place)) return true;
            } catch (const Error& error) {
                findings_.error("the {} at byte {} {}", record_name(place->op), place->offset, error.what());
            }
        }
        return false;
    }

    DataFacts data_section() {
        DataSectionCheck check(file_, findings_);
        const bool found = records([&](const RecordPlace& place) {
            if (place.op == OpCode::footer) position_ = place.offset;
            if (place.op == OpCode::data_end) check_data_end(place);
            ended_ = place.op == OpCode::footer || place.op == OpCode::data_end;
            if (place.op == OpCode::footer) findings_.error("the file has no DataEnd record");
            if (!ended_) check.check(place);
            return !ended_;
        });
        if (!found) findings_.error("the file has no DataEnd record: it is incomplete");
        return check.finish();
    }

    void check_data_end(const RecordPlace& place) {
        const auto named = parsed<DataEnd>(file_.content_of(place)).data_section_crc;
        if (named == 0) return;
        std::uint32_t crc = 0;
        constexpr std::uint64_t step = 1 << 20;
        for (std::uint64_t at = 0; at < place.offset; at += step)
            crc = crc32(file_.read(at, std::min(step, place.offset - at)), crc);
        findings_.expect_equal(named, crc, "the DataEnd: data_section_crc");
    }

    void summary_section(DataFacts& facts) {
        const std::uint64_t begin = position_;
        SummarySectionCheck check(facts, findings_);
        std::uint64_t first_offset = 0, footer = 0;
        const bool found = records([&](const RecordPlace& place) {
            footer = place.offset;
            if (place.op == OpCode::footer) return false;
            if (place.op == OpCode::summary_offset && first_offset == 0) first_offset = place.offset;
            check.check({place.op, file_.content_of(place), place.offset});
            return true;
        });
        check.finish();
        const auto end = find_footer(file_);
        if (!found)
            findings_.error("the file has no Footer record: it is incomplete");
        else if (!end || end->offset != footer)
            findings_.error("the file does not end with the Footer at byte {} and \\x89MCAP0\\r\\n", footer);
        else
            check_footer(*end, begin, first_offset);
    }

    void check_footer(const FooterPlace& end, std::uint64_t begin, std::uint64_t first_offset) {
        const bool has_summary = end.offset > begin;
        findings_.expect_equal(end.footer.summary_start, has_summary ? begin : 0,
                               "the Footer: summary_start");
        findings_.expect_equal(end.footer.summary_offset_start, first_offset,
                               "the Footer: summary_offset_start");
        if (end.footer.summary_crc == 0) return;
        const std::uint64_t size = end.offset + record_head_size + 8 + 8 - begin;
        findings_.expect_equal(end.footer.summary_crc, crc32(file_.read(begin, size)),
                               "the Footer: summary_crc");
    }

    File& file_;
    Findings findings_;
    std::uint64_t position_ = 0;
    bool ended_ = false; // the data section has ended
};

} // namespace

std::vector<Finding> check_file(const std::filesystem::path& path) {
    File file(path);
    return FileCheck(file).run();
}

} // namespace tandem::mcap
