// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/directory.hpp"

#include "shm/os/error.hpp"
#include "shm/os/shared_copy.hpp"
#include "shm/segment/segment_file.hpp"

namespace tandem::shm {

Directory::Directory(std::shared_ptr<const Mapping> mapping) : mapping_(std::move(mapping)) {}

std::span<std::byte> Directory::add(const std::string& name, layout::ObjectKind kind, std::uint64_t bytes,
                                    std::uint64_t reserved_bytes) {
    const Side own = mapping_->side();
    const std::string where = mapping_->path() + ": object '" + name + "'";
    if (name.empty() || name.size() >= layout::name_bytes || name.find('\0') != std::string::npos)
        throw Error(where + ": a name of 1 to " + std::to_string(layout::name_bytes - 1) +
                    " characters is expected");
    for (std::uint32_t i = 0; i < added_; ++i)
        if (entry(own, i).name == name)
            throw Error(where + " already exists on this side; choose another name");
    if (added_ == layout::max_objects)
        throw Error(where + " does not fit: at most " + std::to_string(layout::max_objects) +
                    " objects per side");
    const std::uint64_t free = mapping_->arena(own).size() - used_;
    if (bytes > free || round_up(bytes, layout::line_pair) > free)
        throw ArenaFull(where + " needs " + std::to_string(bytes) + " bytes, " + std::to_string(free) +
                            " are left in the arena; raise JoinOptions::arena_bytes",
                        bytes, free);

    const auto memory = mapping_->arena(own).subspan(used_, bytes);
    if (mapping_->sparse() && reserved_bytes != 0)
        reserve(mapping_->fd(), where, mapping_->offset_in_file(memory.data()), reserved_bytes);

    layout::DirectoryEntry listed{};
    name.copy(listed.name, layout::name_bytes - 1);
    listed.kind = static_cast<std::uint32_t>(kind);
    listed.offset = used_;
    listed.bytes = bytes;
    copy_to_shared(&mapping_->side_header(own).directory[added_], &listed, sizeof listed);
    used_ += round_up(bytes, layout::line_pair);
    ++added_;
    return memory;
}

void Directory::publish() {
    mapping_->side_header(mapping_->side()).published.store(1 + added_, std::memory_order_release);
}

std::uint32_t Directory::count(Side owner) const {
    if (owner == mapping_->side()) return added_;
    const std::uint32_t published = mapping_->side_header(owner).published.load(std::memory_order_acquire);
    if (published > 1 + layout::max_objects)
        throw Error(mapping_->path() + ": directory of side " + name_of(owner) +
                    " is damaged; restart that side");
    return published == 0 ? 0 : published - 1;
}

ObjectInfo Directory::entry(Side owner, std::uint32_t index) const {
    layout::DirectoryEntry copy;
    copy_from_shared(&copy, &mapping_->side_header(owner).directory[index], sizeof copy);
    const auto arena = mapping_->arena(owner);
    const bool valid = copy.name[layout::name_bytes - 1] == '\0' && copy.kind >= 1 && copy.kind <= 3 &&
                       copy.offset % layout::line_pair == 0 && copy.offset <= arena.size() &&
                       copy.bytes <= arena.size() - copy.offset;
    if (!valid)
        throw Error(mapping_->path() + ": entry " + std::to_string(index) + " in the directory of side " +
                    name_of(owner) + " is damaged; restart that side");
    return {copy.name, static_cast<layout::ObjectKind>(copy.kind), arena.subspan(copy.offset, copy.bytes)};
}

std::vector<ObjectInfo> Directory::list(Side owner) const {
    std::vector<ObjectInfo> found;
    const std::uint32_t entries = count(owner);
    for (std::uint32_t i = 0; i < entries; ++i) found.push_back(entry(owner, i));
    return found;
}

std::optional<std::span<std::byte>> Directory::find(Side owner, const std::string& name,
                                                    layout::ObjectKind kind) const {
    const std::uint32_t entries = count(owner);
    for (std::uint32_t i = 0; i < entries; ++i) {
        const ObjectInfo found = entry(owner, i);
        if (found.kind == kind && found.name == name) return found.memory;
    }
    return std::nullopt;
}

} // namespace tandem::shm
