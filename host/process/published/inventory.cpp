// SPDX-License-Identifier: Apache-2.0
#include "host/process/published/inventory.hpp"

#include "host/process/file_descriptor.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <set>
#include <utility>

namespace tandem::process {
namespace {

using Head = InventoryHead;

/// Written with pwrite(), because a mapping without memory behind it would end the process.
class Inventory {
  public:
    Inventory() : file_(memfd_create(Head::file_name, MFD_CLOEXEC)) {
        if (file_.get() >= 0 && ftruncate(file_.get(), Head::file_bytes) != 0) file_ = {};
        std::memcpy(head_.magic, Head::magic_text, sizeof head_.magic);
    }

    void put(const void* part, const std::string& line) {
        const std::lock_guard lock(mutex_);
        const auto place = places_.find(part);
        if (place != places_.end() && text_.compare(place->second.at, line.size(), line) == 0) return;
        begin_change();
        if (place != places_.end() && line.size() <= place->second.bytes)
            overwrite(place->second, line);
        else {
            blank(part);
            append(part, line);
        }
        end_change();
    }

    void remove(const void* part) {
        const std::lock_guard lock(mutex_);
        if (left_out_.erase(part) == 0 && !places_.contains(part)) return;
        begin_change();
        blank(part);
        end_change();
    }

  private:
    struct Place {
        std::size_t at, bytes; ///< with the newline
    };

    void overwrite(const Place& place, std::string line) {
        line.insert(line.size() - 1, place.bytes - line.size(), ' ');
        text_.replace(place.at, place.bytes, line);
        touch(place.at, place.bytes);
    }

    void blank(const void* part) {
        const auto place = places_.find(part);
        if (place == places_.end()) return;
        overwrite(place->second, "\n");
        unused_ += place->second.bytes;
        places_.erase(place);
    }

    void append(const void* part, const std::string& line) {
        const bool has_room = text_.size() + line.size() <= Head::max_text_bytes;
        if (unused_ > text_.size() / 2 || (unused_ > 0 && !has_room)) compact();
        if (text_.size() + line.size() > Head::max_text_bytes) {
            left_out_.insert(part);
            return;
        }
        left_out_.erase(part);
        places_[part] = {text_.size(), line.size()};
        touch(text_.size(), line.size());
        text_ += line;
    }

    void compact() {
        std::string packed;
        for (auto& [part, place] : places_) {
            const std::size_t at = packed.size();
            packed.append(text_, place.at, place.bytes);
            place.at = at;
        }
        text_ = std::move(packed);
        unused_ = 0;
        changed_from_ = 0; // bytes of an earlier change of this text may remain beyond its new end
        changed_to_ = text_.size();
    }

    void touch(std::size_t at, std::size_t bytes) {
        changed_from_ = std::min(changed_from_, at);
        changed_to_ = std::max(changed_to_, at + bytes);
    }

    void begin_change() {
        ++head_.sequence;
        changed_from_ = Head::max_text_bytes;
        changed_to_ = 0;
        write(&head_, sizeof head_, 0);
    }

    void end_change() {
        if (changed_from_ < changed_to_)
            write(text_.data() + changed_from_, changed_to_ - changed_from_, sizeof head_ + changed_from_);
        head_.text_bytes = text_.size();
        head_.left_out = left_out_.size();
        ++head_.sequence;
        write(&head_, sizeof head_, 0);
    }

    /// Without memory, closes the file: the list would be wrong from now on.
    void write(const void* data, std::size_t bytes, std::size_t at) {
        if (file_.get() >= 0 &&
            pwrite(file_.get(), data, bytes, static_cast<off_t>(at)) != static_cast<ssize_t>(bytes))
            file_ = {};
    }

    std::mutex mutex_;
    FileDescriptor file_;
    Head head_{};
    std::string text_; ///< of the file
    std::map<const void*, Place> places_;
    std::set<const void*> left_out_;
    std::size_t unused_ = 0; ///< bytes of text_ without a part
    std::size_t changed_from_ = 0, changed_to_ = 0;
};

/// Never deleted: parts may end after static objects are destroyed.
Inventory& inventory() {
    static auto* const the_inventory = new Inventory;
    return *the_inventory;
}

} // namespace

void list_part(const void* part, const std::vector<std::string>& fields) {
    std::string line;
    for (const std::string& field : fields) {
        if (!line.empty()) line += '\t';
        for (const char c : field) line += static_cast<unsigned char>(c) < ' ' ? '?' : c;
    }
    inventory().put(part, line + '\n');
}

void unlist_part(const void* part) { inventory().remove(part); }

} // namespace tandem::process
