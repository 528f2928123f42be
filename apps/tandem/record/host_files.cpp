// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/record/host_files.hpp"

#include "proxy/link/protocol/link_error.hpp"
#include "proxy/link/protocol/published_table.hpp"
#include "proxy/link/session/link_session.hpp"
#include "shm/inspect/observer.hpp"

#include <tandem_version.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
constexpr std::uintmax_t longest_file = 1 << 20;

std::string content_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// proc(5): arguments that end with a zero byte each.
std::vector<std::string> arguments_of(const fs::path& process) {
    std::vector<std::string> arguments;
    const std::string text = content_of(process / "cmdline");
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\0', begin), text.size());
        arguments.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return arguments;
}

void store_side(mcap::McapWriter& writer, const std::string& link, const shm::ObservedSide& side,
                const char* name) {
    const fs::path process = "/proc/" + std::to_string(side.pid);
    const auto arguments = arguments_of(process);
    std::error_code unreadable; // the process may belong to another user, or be gone
    const fs::path folder = fs::read_symlink(process / "cwd", unreadable);
    std::string line;
    for (const std::string& argument : arguments) {
        line += (line.empty() ? "" : " ") + argument;
        const fs::path file = folder / argument;
        if (&argument == &arguments[0] || argument.empty() || !fs::is_regular_file(file, unreadable) ||
            fs::file_size(file, unreadable) > longest_file)
            continue;
        const std::string content = content_of(file);
        const char* type = file.extension() == ".xml" ? "application/xml" : "text/plain";
        writer.attach(link + "/" + file.filename().string(), type, 0, 0, std::as_bytes(std::span(content)));
    }
    writer.add_metadata("tandem.host", {{"link", link},
                                        {"side", name},
                                        {"pid", std::to_string(side.pid)},
                                        {"command", line},
                                        {"version", tandem::version}});
}

} // namespace

void store_port_tables(mcap::McapWriter& writer, const std::string& link, std::uint64_t generation) {
    const auto observation = shm::observe(link, generation);
    if (!observation) return;
    for (const auto& blob : observation->blobs) {
        if (!blob.damage.empty() || blob.name != link::table_name) continue;
        try {
            if (const auto published = link::read_published_table(blob.content))
                writer.add_metadata("tandem.ports", {{"link", link},
                                                     {"side", shm::name_of(blob.owner)},
                                                     {"table", encode_as_text(published->table)}});
        } catch (const link::LinkError&) { // no table: its ports are not recorded either
        }
    }
}

void store_host_files(mcap::McapWriter& writer, const std::string& link, std::uint64_t generation) {
    const auto observation = shm::observe(link, generation);
    if (!observation) return;
    for (const shm::Side side : {shm::Side::first, shm::Side::second})
        if (observation->segment.side(side).state != shm::PeerState::absent)
            store_side(writer, link, observation->segment.side(side), shm::name_of(side));
}

} // namespace tandem::command
