// SPDX-License-Identifier: Apache-2.0
// A component in the style of OPRoS v1, as its code generator and people wrote it: no header included for what other
// headers bring, names of Boost, `#ifdef MAKE_COMPONENT_DLL`, device headers by their v1 names.
#include <Component.h>
#include <Event.h>
#include <EventData.h>
#include <InputDataPort.h>
#include <InputEventPort.h>
#include <OPRoSTypes.h>
#include <OutputDataPort.h>
#include <OutputEventPort.h>

#include "device/AnalogDigitalIO.h"
#include "device/CAN.h"
#include "device/GPS.h"
#include "device/GyroSensor.h"
#include "device/LaserScanner.h"
#include "device/OprosPrintMessage.h"
#include "device/RawImage.h"
#include "device/TCPIP.h"
#include "device/UART.h"
#include "device/USB.h"
#include "device/WheelController.h"

// Names of std that v1's headers did not bring: the headers of devices say `using namespace std`. As C++20, the
// library's own headers bring std::mutex.
class queue {
  public:
    void push(int) {}
};
class stack : public queue {};
#if __cplusplus < 202002L
int mutex = 0;
inline int next_number() { return ++mutex; }
#endif
class Path {
    queue open;
    stack closed;

  public:
    void visit(int node) {
        open.push(node);
        closed.push(node);
    }
};

class Velocity {
    friend class boost::serialization::access;

  public:
    double forward, angular;
    template <class Archive>
    void serialize(Archive& ar, const unsigned int) {
        ar& forward& angular;
    }
};

class V1Comp : public Component {
  public:
    V1Comp() : wheels(NULL) {
        addPort("velocity", &velocity);
        addPort("image", &image);
        addPort("scan", &scan);
    }
    ReturnType onExecute() {
        boost::any* data = velocity.pop();
        if (data == NULL) return OPROS_SUCCESS;
        Velocity v = *boost::unsafe_any_cast<Velocity>(data);
        delete data;
        const double fastest = max(Limit(v.forward, -1, 1), 0.5);
        if (wheels && wheels->Drive(fastest, v.angular) != API_SUCCESS) return OPROS_CALL_API_ERROR;
        scan.push(vector<double>(3));
        return OPROS_SUCCESS;
    }

  protected:
    InputDataPort<Velocity> velocity;
    OutputDataPort<RawImage> image;
    OutputDataPort<vector<double>> scan;
    WheelController* wheels;
    AnalogDigitalIO* io;
    CAN* can;
    UART* uart;
    USB* usb;
    TCPIP* tcp;
    GPS* gps;
};

#ifdef MAKE_COMPONENT_DLL
extern "C" {
Component* getComponent();
void releaseComponent(IComponent* com);
}
Component* getComponent() { return new V1Comp(); }
void releaseComponent(IComponent* com) { delete com; }
#else
#error "the factory is exported without a definition on the command line"
#endif

static_assert(opros::archive::is_serializable<std::vector<Velocity>>::value, "");
