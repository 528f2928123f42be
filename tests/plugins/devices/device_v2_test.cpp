// SPDX-License-Identifier: Apache-2.0
// The simulated devices, through the functions of OPRoS v2.
#include "tests/plugins/devices/device_under_test.hpp"

#include <device/AccelerationSensor.h>
#include <device/BumperTouchSensor.h>
#include <device/Camera.h>
#include <device/GyroSensor.h>
#include <device/InfraredSensor.h>
#include <device/LaserRangeFinder.h>
#include <device/Manipulator.h>
#include <device/MobileController.h>
#include <device/PositionSensor.h>
#include <device/ProximitySensor.h>
#include <device/ServoActuator.h>
#include <device/UltrasonicSensor.h>

namespace {

/// Returns what the sensor measures, two channels.
template <typename Sensor, typename Value>
std::vector<Value> measure(const std::string& name) {
    DeviceOfV2<Sensor> sensor(name, {{"Size", "2"}});
    std::vector<Value> values;
    REQUIRE(sensor->GetSensorValue(values) == API_SUCCESS);
    REQUIRE(values.size() == 2);
    CHECK(values[1].status == OPROS_SUCCESS);
    return values;
}

} // namespace

TEST_CASE("sensors have the functions of OPRoS v2 with as many values as the parameter Size") {
    const auto acceleration =
        measure<AccelerationSensor, OPRoS::AccelerationSensorData>("AccelerationSensorApi");
    CHECK(acceleration[1].zAcceleration == Approx(9.81));
    const auto turn = measure<GyroSensor, OPRoS::GyroSensorData>("GyroSensorApi");
    CHECK(turn[0].zAngleRate == Approx(0.2 * M_PI * std::cos(0.2 * M_PI * 0.5)));
    const auto place = measure<PositionSensor, OPRoS::ObjectPositionData>("PositionSensorApi");
    CHECK(std::hypot(place[0].x, place[0].y) == Approx(1));
    CHECK(measure<InfraredSensor, OPRoS::Float64>("InfraredSensorApi")[0].data > 0.1);
    CHECK(measure<UltrasonicSensor, OPRoS::Float64>("UltrasonicSensorApi")[0].data >= 1);
    CHECK(measure<ProximitySensor, OPRoS::Float64Array>("ProximitySensorApi")[0].data.size() == 1);
    CHECK_FALSE(measure<BumperTouchSensor, OPRoS::Bool>("BumperTouchSensorApi")[0].data);
    CHECK(measure<LaserRangeFinder, OPRoS::Float64Array>("LaserRangeFinderApi")[1].data.at(90) == Approx(2));
}

TEST_CASE("an arm has the functions of OPRoS v2 and still those of v1.1") {
    DeviceOfV2<Manipulator> arm("ManipulatorApi", {{"Size", "2"}});
    std::vector<OPRoS::Float64> positions, torques;
    CHECK(arm->SetPosition(std::vector<OPRoS::Float64>{1.0}, std::vector<OPRoS::UInt32>{0u}) == API_ERROR);
    CHECK(arm->SetPosition(std::vector<OPRoS::Float64>{1.0, 2.0}, std::vector<OPRoS::UInt32>{0u, 0u}) ==
          API_SUCCESS);
    CHECK(arm->GetPosition(positions) == API_SUCCESS);
    REQUIRE(positions.size() == 2);
    CHECK(positions[1].data == 2);
    CHECK(arm->SetTorque({3.0, 4.0}) == API_SUCCESS);
    CHECK(arm->GetTorque(torques) == API_SUCCESS);
    CHECK(torques.at(1).data == 4);
    CHECK(arm->SetVelocity({1.0, -1.0}) == API_SUCCESS);
    std::vector<double> of_v1;
    CHECK(arm->GetPosition(of_v1) == API_SUCCESS);
    CHECK(of_v1 == std::vector<double>{1.5, 1.5}); // half a second later
}

TEST_CASE("a servo and a base obey commands of OPRoS v2") {
    DeviceOfV2<ServoActuator> servo("ServoActuatorApi");
    OPRoS::Float64 position;
    CHECK(servo->SetPosition(OPRoS::Float64(2), OPRoS::UInt32(1000)) == API_SUCCESS);
    CHECK(servo->GetPosition(position) == API_SUCCESS);
    CHECK(position.data == Approx(1));

    DeviceOfV2<MobileController> base("MobileControllerApi");
    OPRoS::MobilePositionData here;
    std::vector<OPRoS::Int32> pulses;
    CHECK(base->SetVelocity(OPRoS::MobileVelocityData(1, 0, 0)) == API_SUCCESS);
    CHECK(base->GetPosition(here) == API_SUCCESS);
    CHECK(here.x == Approx(0.5));
    CHECK(base->SetVelocity(OPRoS::MobileVelocityData()) == API_SUCCESS);
    CHECK(base->GetOdometry(pulses) == API_SUCCESS);
    CHECK(pulses.at(0).data == 2122); // one metre on wheels of 0.15 m
    CHECK(base->SetPosition(OPRoS::MobilePositionData(7, 8, 0)) == API_SUCCESS);
    CHECK(base->GetPosition(here) == API_SUCCESS);
    CHECK(here.y == 8);
}

TEST_CASE("a camera gives a picture of OPRoS v2 with as many bytes as its size says") {
    DeviceOfV2<Camera> camera("CameraApi", {{"Width", "4"}, {"Height", "2"}, {"PixelBytes", "3"}});
    OPRoS::CameraData picture;
    picture.format = 2;
    REQUIRE(camera->GetImage(picture) == API_SUCCESS);
    CHECK(picture.data.size() == 24);
    CHECK(picture.width == 4);
    CHECK(picture.height == 2);
    CHECK(picture.format == 2);
}

TEST_CASE("properties of OPRoS v2 reach a device and come back") {
    DeviceOfV2<LaserRangeFinder> scanner("LaserRangeFinderApi");
    OPRoS::Property given, read_back;
    given.SetValue("Size", "3");
    CHECK(scanner->SetProperty(given) == API_SUCCESS);
    CHECK(scanner->GetProperty(read_back) == API_SUCCESS);
    CHECK(read_back.GetValue("Size") == "3");
}
