// SPDX-License-Identifier: Apache-2.0
// A component in the style of OpenRTM-aist 1.x: ports before types, coil's time and locks, plain listener names, listeners
// without a result, log macros without a semicolon, the former names of headers and functions.
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/idl/BasicDataTypeSkel.h>
#include <rtm/idl/ExtendedDataTypesSkel.h>
#include <rtm/idl/InterfaceDataTypesSkel.h>

#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/Manager.h>

class Seen : public RTC::ConnectorDataListenerT<RTC::TimedLong> {
  public:
    virtual ~Seen() {}
    virtual void operator()(const RTC::ConnectorInfo& info, const RTC::TimedLong& data) {
        std::cout << info.name << " " << data.data << std::endl;
    }
};
class SeenBytes : public RTC::ConnectorDataListener {
  public:
    virtual void operator()(const RTC::ConnectorInfo&, const cdrMemoryStream& data) {
        size += data.bufSize();
    }
    unsigned long size = 0;
};
class Joined : public RTC::ConnectorListener {
  public:
    virtual void operator()(const RTC::ConnectorInfo& info) { std::cout << info.id << std::endl; }
};

class Old : public RTC::DataFlowComponentBase {
    typedef coil::Guard<coil::Mutex> Lock;

  public:
    Old(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), m_inIn("in", m_in), m_outOut("out", m_out) {
        registerInPort("in", m_inIn);
        registerOutPort("out", m_outOut);
        bindParameter("gain", m_gain, "1.0");
        m_inIn.addConnectorDataListener(RTC::ON_BUFFER_WRITE, new Seen());
        m_inIn.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, new SeenBytes());
        m_outOut.addConnectorListener(RTC::ON_CONNECT, new Joined());
    }
    virtual RTC::ReturnCode_t onExecute(RTC::UniqueId) {
        Lock lock(m_mutex);
        coil::TimeValue begin(coil::gettimeofday());
        coil::TimeValue half = 0.5, none;
        if (coil::gettimeofday() - begin > half)
            RTC_WARN(("late by %f s", (double)(coil::gettimeofday() - begin)))
        m_left = half - coil::TimeValue(0, 250000) - none;
        if (m_inIn.isNew()) {
            m_inIn >> m_in;
            m_out.tm.sec = begin.sec();
            m_out.tm.nsec = begin.usec() * 1000;
            m_out.data = m_in.data;
            m_outOut << m_out;
        }
        coil::usleep(100);
        coil::sleep(coil::TimeValue(0, 1));
        RTC_DEBUG(("done"))
        return RTC::RTC_OK;
    }

  private:
    coil::Mutex m_mutex;
    coil::TimeValue m_left;
    double m_gain;
    RTC::TimedLong m_in, m_out;
    RTC::InPort<RTC::TimedLong> m_inIn;
    RTC::OutPort<RTC::TimedLong> m_outOut;
};

extern "C" void OldInit(RTC::Manager* manager) {
    static const char* spec[] = {"implementation_id", "Old", "type_name", "Old", ""};
    coil::Properties profile(spec);
    manager->registerFactory(profile, RTC::Create<Old>, RTC::Delete<Old>);
}
