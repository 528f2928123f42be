// SPDX-License-Identifier: Apache-2.0
// The simulated devices, through the two functions by which a component gets them.
#include "tests/plugins/devices/device_under_test.hpp"
#include "tests/support/comma_locale.hpp"

#include <device/AnalogDigitalIO.h>
#include <device/BatteryManagementSystem.h>
#include <device/CAN.h>
#include <device/GPS.h>
#include <device/Gripper.h>
#include <device/GyroSensor.h>
#include <device/I2C.h>
#include <device/InertiaMeasurementUnit.h>
#include <device/Joystick.h>
#include <device/LaserScanner.h>
#include <device/MultiCamera.h>
#include <device/PositionSensor.h>
#include <device/ServoActuator.h>
#include <device/Speech.h>
#include <device/TCPIP.h>
#include <device/WheelController.h>
#include <filesystem>
#include <memory>

TEST_CASE("a device library has the names that profiles of both versions of OPRoS give it") {
    for (const std::string name :
         {"AnalogDigitalIO", "AnalogIO", "DigitalIO", "CAN", "GPS", "I2C", "TCPIP", "UART", "USB"})
        for (const char* suffix : {"API.so", "Api.so"}) {
            INFO(name + suffix);
            CHECK(std::filesystem::exists(DEVICES "/" + name + suffix));
        }
}

TEST_CASE("every device library creates a device that goes through its states") {
    int devices = 0;
    for (const auto& entry : std::filesystem::directory_iterator(DEVICES)) {
        const std::string name = entry.path().stem();
        if (name.size() < 4 ||
            (name.substr(name.size() - 3) != "Api" && name.substr(name.size() - 3) != "API"))
            continue;
        INFO(name);
        ++devices;
        void* library = dlopen(entry.path().c_str(), RTLD_NOW);
        REQUIRE(library);
        const auto get = reinterpret_cast<GET_OPROS_API>(dlsym(library, "GetAPI"));
        const auto release = reinterpret_cast<void (*)(OprosApi*)>(dlsym(library, "ReleaseAPI"));
        REQUIRE(get);
        REQUIRE(release);
        OprosApi* device = get();
        CHECK(device->Enable() == API_ERROR); // not before Initialize()
        Property given;
        given.SetValue("Size", "2");
        CHECK(device->Initialize(given) == API_SUCCESS);
        CHECK(device->Enable() == API_SUCCESS);
        CHECK(device->OnExecute() == API_SUCCESS);
        Property read_back;
        CHECK(device->GetParameter(read_back) == API_SUCCESS);
        CHECK(read_back.GetValue("Size") == "2");
        CHECK(device->Disable() == API_SUCCESS);
        CHECK(device->Finalize() == API_SUCCESS);
        CHECK(device->Enable() == API_ERROR);
        release(device);
        dlclose(library);
    }
    CHECK(devices >= 68);
}

TEST_CASE("a sensor has as many channels as its parameter Size and both names of its function") {
    DeviceUnderTest<PositionSensor> sensor("PositionSensorApi", {{"Size", "3"}});
    std::vector<ObjectPosition> values;
    REQUIRE(sensor->GetSensorValue(values) == API_SUCCESS);
    CHECK(values.size() == 3);
    REQUIRE(sensor->GetPositionSensorData(values) == API_SUCCESS);
    CHECK(std::hypot(values[0].x, values[0].y) == Approx(1));

    DeviceUnderTest<GyroSensor> gyro("GyroSensorAPI");
    std::vector<ObjectRotation> rotations;
    std::vector<ObjectLocation> headings;
    CHECK(gyro->GetSensorValue(rotations) == API_SUCCESS);
    CHECK(gyro->GetGyroSensorData(headings) == API_SUCCESS);
    CHECK(headings.size() == rotations.size());
}

TEST_CASE("with a time step, two runs of a sensor are identical") {
    std::vector<ObjectPosture> once, again;
    for (std::vector<ObjectPosture>* run : {&once, &again}) {
        DeviceUnderTest<InertiaMeasurementUnit> imu("InertiaMeasurementUnitApi");
        for (int i = 0; i < 5; ++i) REQUIRE(imu->GetSensorValue(*run) == API_SUCCESS);
    }
    CHECK(once[0].yaw == again[0].yaw);
    CHECK(once[0].yaw != 0);
    CHECK(once[0].zAcceleration == Approx(9.81));
}

TEST_CASE("a parameter has a decimal point, whatever locale a component has set") {
    std::vector<ObjectPosture> usual, with_comma;
    {
        DeviceUnderTest<InertiaMeasurementUnit> imu("InertiaMeasurementUnitApi");
        REQUIRE(imu->GetSensorValue(usual) == API_SUCCESS);
    }
    const tandem::test::CommaLocale locale;
    DeviceUnderTest<InertiaMeasurementUnit> imu("InertiaMeasurementUnitApi");
    REQUIRE(imu->GetSensorValue(with_comma) == API_SUCCESS);
    CHECK(usual[0].yaw != 0);
    CHECK(usual[0].yaw == with_comma[0].yaw);
}

TEST_CASE("a laser scanner in a square room measures its walls") {
    DeviceUnderTest<LaserScanner> scanner(
        "LaserScannerApi", {{"ScanPoints", "3"}, {"StartAngle", "0"}, {"DeltaAngle", "0.78539816"}});
    std::vector<double> ranges;
    REQUIRE(scanner->GetLaserScannerData(ranges) == API_SUCCESS);
    REQUIRE(ranges.size() == 3);
    CHECK(ranges[0] == Approx(2));
    CHECK(ranges[1] == Approx(2 * std::sqrt(2)));
    CHECK(ranges[2] == Approx(2));
}

TEST_CASE("a base moves as it is driven") {
    DeviceUnderTest<WheelController> base("WheelControllerApi");
    ObjectLocation here;
    bool running = true;
    std::vector<long> pulses;
    REQUIRE(base->DriveWheel(1, 0) == API_SUCCESS);
    REQUIRE(base->GetPosition(here) == API_SUCCESS);
    CHECK(here.x == Approx(0.5));
    REQUIRE(base->StopWheel() == API_SUCCESS); // another half second has passed
    REQUIRE(base->IsWheelRunning(running) == API_SUCCESS);
    CHECK_FALSE(running);
    REQUIRE(base->GetPosition(here) == API_SUCCESS);
    CHECK(here.x == Approx(1));
    CHECK(here.y == Approx(0).margin(1e-12));
    REQUIRE(base->GetOdometery(pulses) == API_SUCCESS);
    CHECK(pulses == std::vector<long>{2122, 2122}); // one metre on wheels of 0.15 m

    REQUIRE(base->RotateWheel(-M_PI / 2, 1) == API_SUCCESS);
    for (int i = 0; i < 5; ++i) REQUIRE(base->GetPosition(here) == API_SUCCESS);
    CHECK(here.theta == Approx(-M_PI / 2));
    REQUIRE(base->SetPosition(ObjectLocation(7, 8, 0)) == API_SUCCESS);
    REQUIRE(base->Drive(0, 0) == API_SUCCESS);
    REQUIRE(base->GetPosition(here) == API_SUCCESS);
    CHECK(here.x == Approx(7));
}

TEST_CASE("joints reach their positions in the time given") {
    DeviceUnderTest<ServoActuator> servo("ServoActuatorApi");
    double position = -1, velocity = -1;
    REQUIRE(servo->SetPosition(2, 1000) == API_SUCCESS);
    REQUIRE(servo->GetPosition(position) == API_SUCCESS);
    CHECK(position == Approx(1));
    REQUIRE(servo->GetPosition(position) == API_SUCCESS);
    CHECK(position == 2);
    REQUIRE(servo->GetVelocity(velocity) == API_SUCCESS);
    CHECK(velocity == 0);

    DeviceUnderTest<Gripper> hand("GripperApi", {{"Size", "2"}});
    std::vector<double> positions;
    CHECK(hand->SetPosition({1, 2, 3}, {0, 0, 0}) == API_ERROR);
    CHECK(hand->SetPosition({1, 2}, {0, 0}) == API_SUCCESS);
    CHECK(hand->GetPosition(positions) == API_SUCCESS);
    CHECK(positions == std::vector<double>{1, 2});
    CHECK(hand->StartGripping() == API_SUCCESS);
    bool gripped = false;
    CHECK(hand->IsGripped(gripped) == API_SUCCESS);
    CHECK(gripped);
    CHECK(hand->IsGripped() == 1);
}

TEST_CASE("what is written to a bus can be read") {
    unsigned char out[3] = {1, 2, 3}, in[8] = {};
    DeviceUnderTest<TCPIP> socket("TCPIPAPI");
    CHECK(socket->Read(in, 8) == 0);
    CHECK(socket->Write(out, 3) == 3);
    CHECK(socket->Read(in, 2) == 2);
    CHECK(socket->Read(in + 2, 6) == 1);
    CHECK(std::equal(out, out + 3, in));
    CHECK(socket->Write(nullptr, 3) == API_ERROR);

    DeviceUnderTest<CAN> can("CANAPI");
    long id = 0;
    CHECK(can->Write(5, out, 3) == API_SUCCESS);
    CHECK(can->Write(5, out, 9) == API_ERROR);
    CHECK(can->Read(id, in, 8) == API_SUCCESS);
    CHECK(id == 5);
    CHECK(in[2] == 3);
    CHECK(in[3] == 0);

    DeviceUnderTest<I2C> i2c("I2CAPI");
    CHECK(i2c->Write(0x21, out, 3) == API_SUCCESS);
    CHECK(i2c->Read(0x22, in, 1) == API_SUCCESS);
    CHECK(in[0] == 0);
    CHECK(i2c->Read(0x21, in, 3) == API_SUCCESS);
    CHECK(in[1] == 2);
}

TEST_CASE("outputs come back as inputs") {
    DeviceUnderTest<AnalogDigitalIO> io("AnalogDigitalIoAPI");
    std::vector<double> analog;
    std::vector<bool> digital;
    CHECK(io->SetAnalogOutputData({1.5, 2}) == API_SUCCESS);
    CHECK(io->SetDigitalOutputData({true, false, true}) == API_SUCCESS);
    CHECK(io->GetAnalogInputData(analog) == API_SUCCESS);
    CHECK(io->GetDigitalInputData(digital) == API_SUCCESS);
    CHECK(analog == std::vector<double>{1.5, 2});
    CHECK(digital == std::vector<bool>{true, false, true});
}

TEST_CASE("cameras fill a picture of the configured size and nothing beyond it") {
    DeviceUnderTest<MultiCamera> cameras(
        "MultiCameraApi", {{"Count", "2"}, {"Width1", "4"}, {"Height1", "2"}, {"PixelBytes1", "1"}});
    std::vector<unsigned char> picture(9, 255);
    REQUIRE(cameras->GetImage(1, picture.data()) == API_SUCCESS);
    CHECK(picture[1] == picture[0] + 1);
    CHECK(picture[4] == picture[0]);
    CHECK(picture[8] == 255);
    Property parameters;
    REQUIRE(cameras->GetParameter(parameters) == API_SUCCESS); // also those that the profile lacks
    CHECK(parameters.GetValue("Width0") == "320");
    CHECK(parameters.GetValue("Width1") == "4");
    CHECK(cameras->GetImage(2, picture.data()) == API_ERROR);
}

TEST_CASE("the other devices give values") {
    double value = 0;
    std::vector<double> cells;
    DeviceUnderTest<BatteryManagementSystem> battery("BatteryManagementSystemApi", {{"CellCount", "3"}});
    CHECK(battery->GetCellVoltage(cells) == API_SUCCESS);
    CHECK(cells.size() == 3);
    CHECK(battery->GetBatteryVoltage(value) == API_SUCCESS);
    CHECK(value == Approx(12.6).margin(0.01));

    JoystickData stick;
    DeviceUnderTest<Joystick> joystick("JoystickAPI");
    CHECK(joystick->GetJoystickData(stick) == API_SUCCESS);
    CHECK(std::count(stick.button.begin(), stick.button.end(), true) == 1);

    GPSData place;
    DeviceUnderTest<GPS> gps("GPSAPI");
    CHECK(gps->GetGPSData(place) == API_SUCCESS);
    CHECK(place.latitude == Approx(37.29).margin(1e-4));

    DeviceUnderTest<Speech> speech("SpeechApi");
    CHECK(speech->PlaySpeech("hello", SPEECH_TEXT_STREAM) == API_SUCCESS);
    CHECK(speech->StopSpeech() == API_SUCCESS);
}
