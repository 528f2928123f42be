// SPDX-License-Identifier: Apache-2.0
// What the three RTCs share: their parameters, their ports' type, and how they report a refusal.
#pragma once

#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <span>
#include <string>

#include "plugins/wheelchair/core/body/ports.hpp"
#include "plugins/wheelchair/core/body/settings.hpp"

namespace tandem::wheelchair::component {

constexpr int max_messages_per_tick =
    4096; // messages read from a port, so a fast sender cannot hold the tick

/// An in-port with the variable it reads into.
struct SequenceIn {
    explicit SequenceIn(const char* name) : port(name, value) {}

    template <class T>
    Received<T> receive_all() {
        Received<T> in;
        for (int i = 0; i < max_messages_per_tick && port.isNew(); ++i) {
            port.read();
            in.add(std::span<const double>(value.data.get_buffer(), value.data.length()));
        }
        return in;
    }

    RTC::TimedDoubleSeq value;
    RTC::InPort<RTC::TimedDoubleSeq> port;
};

/// An out-port with the variable it writes from.
struct SequenceOut {
    explicit SequenceOut(const char* name) : port(name, value) {}

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

/// The parameters every component of the run has, bound to its configuration sets.
struct Parameters {
    RawSettings texts;

    template <class Component>
    void bind(Component& component) {
        component.bindParameter("scenario", texts.scenario, "step20");
        component.bindParameter("joystick_file", texts.joystick_file, "");
        component.bindParameter("clock", texts.clock, "monotonic");
        component.bindParameter("trace", texts.trace, "");
    }
};

/// The component's own description, for the manager and for tools.
inline coil::Properties profile(const char* name, const char* description) {
    const char* const spec[] = {"implementation_id",
                                name,
                                "type_name",
                                name,
                                "description",
                                description,
                                "version",
                                "1.0.0",
                                "vendor",
                                "Tandem",
                                "category",
                                "wheelchair",
                                "activity_type",
                                "PERIODIC",
                                "kind",
                                "DataFlowComponent",
                                "max_instance",
                                "0",
                                "language",
                                "C++",
                                "lang_type",
                                "compile",
                                "conf.default.scenario",
                                "step20",
                                "conf.default.joystick_file",
                                "",
                                "conf.default.clock",
                                "monotonic",
                                "conf.default.trace",
                                "",
                                ""};
    return coil::Properties(spec);
}

/// Runs a step of the component's life; a refusal becomes one line and RTC_ERROR.
template <class Step>
RTC::ReturnCode_t guarded(const char* instance, Step step) {
    try {
        step();
        return RTC::RTC_OK;
    } catch (const std::exception& e) {
        std::cerr << instance << ": " << e.what() << std::endl;
    } catch (const CORBA::Exception& e) {
        std::cerr << instance << ": a service did not answer (" << e._name()
                  << "); connect its port and activate its provider first" << std::endl;
    }
    return RTC::RTC_ERROR;
}

} // namespace tandem::wheelchair::component
