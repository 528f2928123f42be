// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace tandem::monitor {

class Place;

/// Counts WebSockets: in all, and by peer. Some places are only for clients with the token of --control, so that other
/// clients cannot keep them out. [one thread]
class Places {
  public:
    static constexpr std::size_t max_open = 64;      ///< without the reserved ones
    static constexpr std::size_t max_of_a_peer = 24; ///< without the reserved ones
    static constexpr std::size_t reserved = 8;       ///< additional places of clients with the token

    /// Takes a place until the end of its object. Returns nothing if none is free for this peer.
    std::optional<Place> take(const std::string& peer, bool has_token);
    bool is_peer_full(const std::string& peer) const;

  private:
    friend class Place;
    void leave(const std::string& peer, bool is_reserved);

    std::map<std::string, std::size_t> open_; ///< by peer
    std::size_t all_ = 0, reserved_taken_ = 0;
};

/// A taken place. It moves with the connection and is released at its end.
class Place {
  public:
    Place(Place&& from) noexcept
        : places_(std::exchange(from.places_, nullptr)), peer_(std::move(from.peer_)),
          is_reserved_(from.is_reserved_) {}
    Place& operator=(Place&&) = delete;
    ~Place() {
        if (places_ != nullptr) places_->leave(peer_, is_reserved_);
    }

  private:
    friend class Places;
    Place(Places& places, std::string peer, bool is_reserved)
        : places_(&places), peer_(std::move(peer)), is_reserved_(is_reserved) {}

    Places* places_;
    std::string peer_;
    bool is_reserved_;
};

} // namespace tandem::monitor
