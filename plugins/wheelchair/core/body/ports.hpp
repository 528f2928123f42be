// SPDX-License-Identifier: Apache-2.0
#pragma once
// The port interface of the bodies. The OPRoS and RTM components implement it with their models' ports and share the
// bodies. The thread that ticks calls all functions.
#include "plugins/wheelchair/core/law/signals.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <tuple>

namespace tandem::wheelchair {

/// Sent by AdaptorComp and InterceptorComp on port `linkState`: time [s], number of the change, and 1 while the peer process
/// exists, otherwise 0.
struct LinkState {
    bool up = true;
};

using Elements3 = std::array<double, 3>;

// elements() returns a value as the elements of its message. assign() is the inverse.
inline Elements3 elements(const JoystickPosition& p) { return {p.x, p.y, p.emergency_stop ? 1.0 : 0.0}; }
inline std::array<double, 2> elements(const Reference& r) { return {r.direction_deg, r.speed}; }
inline std::array<double, 5> elements(const WheelSpeed& w) {
    return {w.left, w.right, w.emergency_stop ? 1.0 : 0.0, w.count_left, w.count_right};
}
inline Elements3 elements(const Voltage& v) { return {v.left, v.right, v.brake ? 1.0 : 0.0}; }
inline std::array<double, 1> elements(const LinkState& l) { return {l.up ? 1.0 : 0.0}; }

inline void assign(JoystickPosition& p, std::span<const double> e) { p = {e[0], e[1], e[2] != 0.0}; }
inline void assign(Reference& r, std::span<const double> e) { r = {e[0], e[1]}; }
inline void assign(WheelSpeed& w, std::span<const double> e) { w = {e[0], e[1], e[2] != 0.0, e[3], e[4]}; }
inline void assign(Voltage& v, std::span<const double> e) { v = {e[0], e[1], e[2] != 0.0}; }
inline void assign(LinkState& l, std::span<const double> e) { l = {e[0] != 0.0}; }

/// Number of doubles in a message of T.
template <class T>
inline constexpr std::size_t message_size = 2 + std::tuple_size_v<decltype(elements(T{}))>;

template <class T>
using Message = std::array<double, message_size<T>>;

template <class T>
Message<T> pack(const Stamped<T>& in) {
    Message<T> out{in.stamp, in.sequence};
    const auto values = elements(in.value);
    for (std::size_t i = 0; i < values.size(); ++i) out[2 + i] = values[i];
    return out;
}

/// Reverses pack(). Returns nullopt if the length is wrong for T, or stamp or sequence number are not finite,
/// because the sender may be another author's component.
template <class T>
std::optional<Stamped<T>> unpack(std::span<const double> in) {
    if (in.size() != message_size<T> || !std::isfinite(in[0]) || !std::isfinite(in[1])) return {};
    Stamped<T> out{in[0], in[1], {}};
    assign(out.value, in.subspan(2));
    return out;
}

/// All messages in an in-port: the newest one, and the number of messages.
template <class T>
struct Received {
    std::optional<Stamped<T>> newest;
    int count = 0;

    /// Adds a message that is newer than the previous ones. Ignores a malformed message and returns false.
    bool add(std::span<const double> message) {
        const auto value = unpack<T>(message);
        if (!value) return false;
        newest = value;
        ++count;
        return true;
    }
};

class JoystickPorts {
  public:
    virtual Received<JoystickPosition> positions() = 0;
    virtual void send(const Stamped<Reference>& reference) = 0;

  protected:
    ~JoystickPorts() = default;
};

class ControlPorts {
  public:
    virtual Received<Reference> references() = 0;
    virtual Received<WheelSpeed> wheels() = 0;
    virtual void send(const Stamped<Voltage>& voltage) = 0;

  protected:
    ~ControlPorts() = default;
};

class HWPorts {
  public:
    virtual Received<Voltage> voltages() = 0;
    virtual Received<LinkState> link_states() = 0; // empty if the port is not connected
    virtual void send(const Stamped<JoystickPosition>& position, const Stamped<WheelSpeed>& wheels) = 0;

  protected:
    ~HWPorts() = default;
};

} // namespace tandem::wheelchair
