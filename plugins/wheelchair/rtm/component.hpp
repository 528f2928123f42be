// SPDX-License-Identifier: Apache-2.0
// Shared by the three RTCs: their parameters, the type of their ports, and error reports.
#pragma once

#include <rtm/idl/BasicDataTypeSkel.h>

#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <span>
#include <string>

#include "plugins/wheelchair/core/body/ports.hpp"
#include "plugins/wheelchair/core/body/settings.hpp"

namespace tandem::wheelchair::component {

/// Limits the messages per tick, so that a continuous sender cannot block the tick.
constexpr int max_messages_per_tick = 4096;

/// An in-port and its variable for reading.
struct SequenceIn {
    explicit SequenceIn(const char* name) : port(name, value) {}

    /// Takes all messages from the port. [tick-thread]
    template <class T>
    Received<T> receive_all() {
        Received<T> in;
        for (int i = 0; i < max_messages_per_tick && port.isNew(); ++i) {
            port.read();
            // A span over the sequence's memory, without a copy.
            in.add(std::span<const double>(value.data.get_buffer(), value.data.length()));
        }
        return in;
    }

    RTC::TimedDoubleSeq value;
    RTC::InPort<RTC::TimedDoubleSeq> port;
};

/// An out-port and its variable for writing.
struct SequenceOut {
    explicit SequenceOut(const char* name) : port(name, value) {}

    /// Sends a value. Its stamp also becomes the time of RTM's Timed types. [tick-thread]
    template <class T>
    void write(const Stamped<T>& stamped) {
        const auto message = pack(stamped);
        value.tm.sec = static_cast<CORBA::ULong>(stamped.stamp);
        value.tm.nsec = static_cast<CORBA::ULong>((stamped.stamp - value.tm.sec) * 1e9);
        value.data.length(message.size());
        std::copy(message.begin(), message.end(), value.data.get_buffer());
        port.write();
    }

    RTC::TimedDoubleSeq value;
    RTC::OutPort<RTC::TimedDoubleSeq> port;
};

/// The common parameters of the three components, bound to their configuration sets.
struct Parameters {
    RawSettings texts;

    /// Call this in onInitialize(). Afterwards, the manager writes the active set's values to `texts`.
    template <class Component>
    void bind(Component& component) {
        component.bindParameter("scenario", texts.scenario, "step20");
        component.bindParameter("joystick_file", texts.joystick_file, "");
        component.bindParameter("clock", texts.clock, "monotonic");
        component.bindParameter("trace", texts.trace, "");
    }
};

/// Returns the component profile for the manager and for tools such as RTSystemEditor.
inline coil::Properties profile(const char* name, const char* description) {
    // OpenRTM-aist's tools expect kind, max_instance and similar keys. conf.default.* are the default set.
    const char* const spec[][2] = {{"implementation_id", name},
                                   {"type_name", name},
                                   {"description", description},
                                   {"version", "1.0.0"},
                                   {"vendor", "Tandem"},
                                   {"category", "wheelchair"},
                                   {"activity_type", "PERIODIC"},
                                   {"kind", "DataFlowComponent"},
                                   {"max_instance", "0"},
                                   {"language", "C++"},
                                   {"lang_type", "compile"},
                                   {"conf.default.scenario", "step20"},
                                   {"conf.default.joystick_file", ""},
                                   {"conf.default.clock", "monotonic"},
                                   {"conf.default.trace", ""}};
    coil::Properties properties;
    for (const auto& entry : spec) properties.setDefault(entry[0], entry[1]);
    return properties;
}

/// Runs a life-cycle callback. Converts an exception to one line on standard error and RTC_ERROR.
template <class Step>
RTC::ReturnCode_t run_guarded(const char* instance, Step step) {
    try {
        step();
        return RTC::RTC_OK;
    } catch (const std::exception& e) {
        std::cerr << instance << ": " << e.what() << std::endl;
    } catch (const CORBA::Exception& e) {
        // Not derived from std::exception.
        std::cerr << instance << ": a service did not answer (" << e._name()
                  << "); connect its port and activate its provider first" << std::endl;
    }
    return RTC::RTC_ERROR;
}

} // namespace tandem::wheelchair::component
