// SPDX-License-Identifier: Apache-2.0
// A component and a device library in the style of OPRoS v2. Its classes of devices have the names of those of v1.1.
#include <OPRoSInclude.h>
#include <device/AccelerationSensor.h>
#include <device/BumperTouchSensor.h>
#include <device/Camera.h>
#include <device/CartesianCoordinateData.h>
#include <device/DeviceParameters.h>
#include <device/GeoMagneticSensorData.h>
#include <device/GpsData.h>
#include <device/GyroSensor.h>
#include <device/ImuData.h>
#include <device/InfraredSensor.h>
#include <device/LaserRangeFinder.h>
#include <device/Manipulator.h>
#include <device/ManipulatorControl.h>
#include <device/MobileAccelerationData.h>
#include <device/MobileController.h>
#include <device/ObjectAccelerationData.h>
#include <device/ObjectVelocityData.h>
#include <device/OprosPrintMessage.h>
#include <device/PositionSensor.h>
#include <device/ProximitySensor.h>
#include <device/ServoActuator.h>
#include <device/Uart.h>
#include <device/UltrasonicSensor.h>
#include <device/VisionRecognitionResultData.h>

/// A user's device library.
class Arm : public Manipulator {
    OPRoS::Property settings;
    std::vector<OPRoS::Float64> joints;

  public:
    virtual int32_t Initialize(OPRoS::Property props) {
        settings = props;
        return props.FindName("Size") ? API_SUCCESS : API_ERROR;
    }
    virtual int32_t Finalize(void) { return API_SUCCESS; }
    virtual int32_t SetProperty(OPRoS::Property props) {
        settings = props;
        return API_SUCCESS;
    }
    virtual int32_t GetProperty(OPRoS::Property& props) {
        props = settings;
        return API_SUCCESS;
    }
    virtual int32_t SetTorque(std::vector<OPRoS::Float64>) { return API_EXECUTING; }
    virtual int32_t SetPosition(std::vector<OPRoS::Float64> position, std::vector<OPRoS::UInt32>) {
        joints = position;
        return API_SUCCESS;
    }
    virtual int32_t GetPosition(std::vector<OPRoS::Float64>& position) {
        position = joints;
        return API_SUCCESS;
    }
};
extern "C" OprosDevice* GetAPI() { return new Arm; }

class UsesDevices : public Component {
    OprosDeviceHandle library;
    Manipulator* arm;
    GyroSensor* gyro;
    Camera* camera;
    ReturnType lastError;
    InputDataPort<OPRoS::MobileVelocityData> velocity;
    OutputDataPort<std::vector<OPRoS::GyroSensorData>> angles;
    OutputDataPort<OPRoS::CameraData> picture;
    OutputDataPort<OPRoS::GpsData> place;
    OutputDataPort<std::vector<OPRoS::Float64Array>> scans;

  public:
    UsesDevices() : library(NULL), arm(NULL), gyro(NULL), camera(NULL), lastError(OPROS_SUCCESS) {
        addPort("velocity", &velocity);
        addPort("angles", &angles);
        addPort("picture", &picture);
        addPort("place", &place);
        addPort("scans", &scans);
    }
    virtual ReturnType onInitialize() {
        OPRoS::Property props;
        props.SetProperty(getPropertyMap());
        library = dlopen(props.GetValue("ApiName").c_str(), RTLD_LAZY);
        if (library == NULL) return lastError = OPROS_FIND_DLL_ERROR;
        GET_OPROS_DEVICE get = (GET_OPROS_DEVICE)dlsym(library, "GetAPI");
        if (get == NULL) return lastError = OPROS_LOAD_DLL_ERROR;
        arm = dynamic_cast<Manipulator*>(get());
        if (arm == NULL || arm->Initialize(props) != API_SUCCESS)
            return lastError = OPROS_INITIALIZE_API_ERROR;
        return arm->SetProperty(props) == API_NOT_SUPPORTED ? OPROS_API_NOT_SUPPORTED_ERROR : OPROS_SUCCESS;
    }
    virtual ReturnType onExecute() {
        std::vector<OPRoS::Float64> joints;
        std::vector<OPRoS::UInt32> time;
        joints.push_back(1.5);
        time.push_back(100);
        if (arm->SetPosition(joints, time) != API_SUCCESS || arm->GetPosition(joints) != API_SUCCESS)
            return OPROS_ERROR;
        std::vector<OPRoS::GyroSensorData> turn;
        if (gyro->GetSensorValue(turn) == API_SUCCESS) angles.push(turn);
        OPRoS::CameraData image(0, 4, 2, std::vector<uint8_t>(8));
        unsigned char plain[8];
        // A component of v2 may call the function of v1.1.
        if (camera->GetImage(image) == API_NOT_SUPPORTED && camera->GetImage(plain) == API_SUCCESS)
            image.data.assign(plain, plain + 8);
        picture.push(image);
        place.push(OPRoS::GpsData(36.4, 127.4, "120000", 0.5));
        opros_any* any = velocity.pop();
        if (any == NULL) return OPROS_SUCCESS;
        OPRoS::MobileVelocityData wanted = velocity.getContent(*any);
        delete any;
        PrintMessage("%f %f\n", wanted.x, wanted.theta);
        return wanted.status;
    }
};
static_assert(opros::archive::is_serializable<OPRoS::ImuData>::value, "");
static_assert(opros::archive::is_serializable<OPRoS::GeoMagneticSensorData>::value, "");
static_assert(opros::archive::is_serializable<OPRoS::CartesianCoordinate>::value, "");
static_assert(opros::archive::is_serializable<OPRoS::VisionRecognitionResult>::value, "");
extern "C" Component* getComponent() { return new UsesDevices; }
