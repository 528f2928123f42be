// SPDX-License-Identifier: Apache-2.0
// Features that few components use: the manager without its header, codes of 1.x, member functions as listeners, a composite
// and an execution context of one's own, names in name servers, streams of log lines.
#include <rtm/DataFlowComponentBase.h>

inline bool known(const char* name) { return RTC::Manager::instance().getComponent(name) != nullptr; }

#include <rtm/ECFactory.h>
#include <rtm/ExtTrigExecutionContext.h>
#include <rtm/LogstreamBase.h>
#include <rtm/NamingManager.h>
#include <rtm/PeriodicECSharedComposite.h>
#include <rtm/RingBuffer.h>
#include <rtm/SimulatorExecutionContext.h>

// 1.x returns codes of a class, 2.x those of an enumeration.
class Sink {
  public:
    DATAPORTSTATUS_ENUM;
    ReturnCode put(bool full) { return full ? BUFFER_FULL : PORT_OK; }
    RTC::DataPortStatus put() { return m_full ? RTC::DataPortStatus::BUFFER_FULL : last(); }
    RTC::DataPortStatus last() { return put(false); }
    bool m_full = false;
};
inline int number(RTC::DataPortStatus status) {
    switch (status) {
    case RTC::DataPortStatus::PORT_OK:
        return 0;
    case RTC::DataPortStatus::BUFFER_FULL:
        return 1;
    default:
        return 2;
    }
}
inline bool full(RTC::RingBuffer<int>& buffer) {
    RTC::BufferStatus::Enum written = buffer.write(1, 0, 1000);
    if (written == RTC::BufferStatus::BUFFER_OK) written = buffer.write(2);
    return written == RTC::BufferStatus::FULL;
}

class Composite : public RTC::PeriodicECSharedComposite {
  public:
    explicit Composite(RTC::Manager* manager) : RTC::PeriodicECSharedComposite(manager) {
        addPostComponentActionListener(RTC::POST_ON_RESET, *this, &Composite::afterReset);
        addConfigurationSetNameListener(RTC::ON_ACTIVATE_CONFIG_SET, *this, &Composite::activated);
        addPortConnectListener(RTC::ON_NOTIFY_CONNECT, *this, &Composite::connecting);
    }
    CORBA::ULong members() {
        ::SDOPackage::SDOList_var sdos(m_org->get_members());
        return sdos->length();
    }
    void afterReset(RTC::UniqueId, RTC::ReturnCode_t) { m_org->updateDelegatedPorts(); }
    void activated(const char*) { m_org->removeAllMembers(); }
    void connecting(const char* port, RTC::ConnectorProfile& profile) {
        std::cout << port << profile.name << std::endl;
    }
};

class Lines : public coil::LogStreamBuffer {
  public:
    void write(int level, const std::string& name, const std::string&, const std::string& mes) override {
        std::cout << RTC::Logger::getLevelString(level) << name << mes << std::endl;
    }
};

// The names of an interface's consumers are looked up like those of types.
const char* const interface_names[] = {
    CORBA_Util::toRepositoryId<RTC::RTObject>(), CORBA_Util::toRepositoryId<RTC::RTObject_ptr>(),
    CORBA_Util::toTypename<RTC::RTObject>(), CORBA_Util::toTypenameOfObject<RTC::RTObject>()};

class Slow : public RTC::ExtTrigExecutionContext {};

extern "C" void RareInit(RTC::Manager* manager) {
    static const char* spec[] = {"implementation_id", "Composite", "type_name", "Composite", ""};
    coil::Properties profile(spec);
    manager->registerFactory(profile, RTC::Create<Composite>, RTC::Delete<Composite>);
    manager->registerECFactory("Slow", RTC::ECCreate<Slow>, RTC::ECDelete<Slow>);
    RTC::ExecutionContextFactory::instance().addFactory("Slow2",
                                                        coil::Creator<RTC::ExecutionContextBase, Slow>,
                                                        coil::Destructor<RTC::ExecutionContextBase, Slow>);
    SimulatorExecutionContextInit(manager);
    static Lines lines;
    manager->getLogStreamBuf().addStream(&lines);
    manager->getNaming()->registerNameServer("corba", "localhost");
    RTC::Manager::removeTask(manager->addTask([] {}, std::chrono::seconds(1)));
}
