// SPDX-License-Identifier: Apache-2.0
// A component in the style of OpenRTM-aist 2.x, with its headers in an unusual order.
#include <coil/PeriodicTask.h>
#include <rtm/ConnectorListener.h>
#include <rtm/CorbaNaming.h>
#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>
#include <rtm/ManagerServant.h>
#include <rtm/RingBuffer.h>
#include <rtm/ext/CameraCommonInterfaceSkel.h>
#include <rtm/idl/BasicDataTypeSkel.h>
#include <rtm/idl/InterfaceDataTypesSkel.h>

class Scale : public RTC::ConnectorDataListenerT<RTC::TimedPose2D> {
    USE_CONNLISTENER_STATUS;

  public:
    ReturnCode operator()(RTC::ConnectorInfo& info, RTC::TimedPose2D& data) override {
        data.data.heading *= info.ports.size() > 1 ? 2 : 1;
        return DATA_CHANGED;
    }
};
class Bytes : public RTC::ConnectorDataListener {
    USE_CONNLISTENER_STATUS;

  public:
    using RTC::ConnectorDataListener::operator();
    ReturnCode operator()(RTC::ConnectorInfo&, RTC::ByteData& data, const std::string& type) override {
        return type == "cdr" && data.getDataLength() == 0 ? INFO_CHANGED : NO_CHANGE;
    }
};

class New : public RTC::DataFlowComponentBase {
  public:
    explicit New(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

  protected:
    RTC::ReturnCode_t onInitialize() override {
        addInPort("pose", m_poseIn);
        addOutPort("image", m_imageOut);
        addPort(m_service);
        m_poseIn.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, new Scale());
        m_imageOut.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_SEND, new Bytes());
        bindParameter("rates", m_rates, "1,2,3");
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId /*ec_id*/) override {
        if (m_poseIn.isNew() && m_poseIn.read()) setTimestamp(m_image);
        switch (m_imageOut.write() ? RTC::DataPortStatus::PORT_OK : m_imageOut.getStatus(0)) {
        case RTC::DataPortStatus::PORT_OK:
            return RTC::RTC_OK;
        case RTC::DataPortStatus::CONNECTION_LOST:
            RTC_INFO(("lost"));
            return RTC::RTC_OK;
        default:
            RTC_ERROR(("%s", RTC::toString(m_imageOut.getStatus(0))));
            return RTC::RTC_ERROR;
        }
    }

  private:
    std::vector<double> m_rates;
    RTC::TimedPose2D m_pose{};
    Img::TimedCameraImage m_image{};
    RTC::InPort<RTC::TimedPose2D> m_poseIn{"pose", m_pose};
    RTC::OutPort<Img::TimedCameraImage> m_imageOut{"image", m_image};
    RTC::CorbaPort m_service{"service"};
};

extern "C" void NewInit(RTC::Manager* manager) {
    static const char* const spec[] = {"implementation_id", "New", "type_name", "New", ""};
    coil::Properties profile(spec);
    manager->registerFactory(profile, RTC::Create<New>, RTC::Delete<New>);
}
