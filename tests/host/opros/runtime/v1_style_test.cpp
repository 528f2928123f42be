// SPDX-License-Identifier: Apache-2.0
// What sources of OPRoS v1 take for granted: one serialize() for both directions, Boost's name for the value
// of a port, images that share their pixels.
#include <Component.h>
#include <EventData.h>
#include <InputDataPort.h>
#include <OutputDataPort.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <device/ApiTypes.h>
#include <device/Property.h>
#include <device/RawImage.h>
#include <sstream>

namespace {

class Reading {
  public:
    int channel = 0;
    std::vector<double> values;
    template <class Archive>
    void serialize(Archive& ar, const unsigned int) {
        ar& BOOST_SERIALIZATION_NVP(channel) & values;
    }
};
struct Unrelated {
    std::string serialize() const { return "no archive"; }
};

template <typename T>
T through_binary(T& value) {
    std::stringstream bytes;
    opros::archive::binary_oarchive out(&bytes);
    out << value;
    opros::archive::binary_iarchive in(&bytes);
    T copy;
    in >> copy;
    return copy;
}

} // namespace

TEST_CASE("a type with one serialize for both directions crosses an archive") {
    CHECK(opros::archive::is_serializable<Reading>::value);
    CHECK(opros::archive::is_serializable<std::vector<Reading>>::value);
    CHECK_FALSE(opros::archive::is_serializable<Unrelated>::value);
    Reading reading;
    reading.channel = 3;
    reading.values = {1, 2.5};
    const Reading copy = through_binary(reading);
    CHECK(copy.channel == 3);
    CHECK(copy.values == std::vector<double>{1, 2.5});
}

TEST_CASE("the value of a port can be used under the name boost::any") {
    InputDataPort<std::vector<bool>> in;
    const opros_any pushed(std::vector<bool>{true, false});
    opros_any value(pushed);
    REQUIRE(in.push(value) == OPROS_SUCCESS);
    boost::any* popped = in.pop();
    REQUIRE(popped);
    std::vector<bool>* content = boost::unsafe_any_cast<std::vector<bool>>(popped);
    CHECK(*content == std::vector<bool>{true, false});
    CHECK(boost::any_cast<int>(popped) == nullptr);
    delete popped;
}

TEST_CASE("a source of v1 exports its factory without a macro of its makefile") {
#ifdef MAKE_COMPONENT_DLL
    SUCCEED();
#else
    FAIL("Component.h must define MAKE_COMPONENT_DLL");
#endif
    IComponent* component = new Component("c");
    CHECK(component->getId() == "c");
    delete component;
}

TEST_CASE("copies of an image share its pixels and an archive copies them") {
    RawImage image;
    image.getImage()->resize(4, 2, 3);
    image.getImage()->getData()[5] = 9;
    RawImage other = image;
    CHECK(other.getImage() == image.getImage());
    RawImage crossed = through_binary(image);
    CHECK(crossed.getImage() != image.getImage());
    CHECK(crossed.getImage()->getSize() == 24);
    CHECK(crossed.getImage()->getData()[5] == 9);
    RawImage empty;
    CHECK(through_binary(empty).getImage()->getData() == nullptr);
}

TEST_CASE("an image whose sizes and bytes do not fit each other is refused") {
    struct Sizes {
        int width, height, pixel_byte;
        unsigned long size, bytes;
    };
    constexpr int half = 1 << 30; // half x half x 16 is 0 in 64 bits
    for (const auto& [width, height, pixel_byte, size, bytes] :
         {Sizes{1000, 1000, 3, 12, 12}, Sizes{half, half, 16, 0, 0}, Sizes{half, half, 0, 0, 0},
          Sizes{2, 2, 1, 4, 3}, Sizes{2, 2, 1, 4, 5}, Sizes{0, 0, 0, 0, 3}, Sizes{-2, -2, 1, 4, 4},
          Sizes{2, 2, 65, 260, 260}}) {
        INFO(width << " x " << height << " x " << pixel_byte << ", size " << size << ", bytes " << bytes);
        std::stringstream stream;
        opros::archive::raw_oarchive out(&stream);
        out << std::string("raw") << width << height << pixel_byte << size;
        const std::string pixels(bytes, 'x');
        out.save(pixels.data(), static_cast<long>(bytes));
        opros::archive::raw_iarchive in(&stream);
        RawImageData image;
        CHECK_THROWS_AS(load_this(in, image), std::exception);
    }
}

TEST_CASE("data types of v1 have the type names that its ports use") {
    CHECK(getTypeName<GPSData>() == "GPSData");
    CHECK(getTypeName<CANObject>() == "CANObject");
    CHECK(getTypeName<WheelControlVelocity>() == "WheelControlVelocity");
    CHECK(getTypeName<std::vector<OPRoS::Rotation>>() == "std::vector<ObjectRotation>");
    const ObjectLocation sum = ObjectLocation(1, 2, 3) + ObjectLocation(1, 1, 1);
    CHECK(sum.x == 2);
    CHECK(sum.theta == 4);
}

TEST_CASE(
    "RectSolid3D has the same corners from a centre or from two corners, and tells which points lie in it") {
    RectSolid3D box, same;
    box.setRectSolid(Point3D(1, 2, 3), 2, -4, 6);
    same.setRectSolid2Corner(Point3D(2, 0, 9), Point3D(0, 4, 3));
    for (RectSolid3D* each : {&box, &same}) {
        CHECK(each->includecheck_point(Point3D(0, 0, 3)));
        CHECK(each->includecheck_point(Point3D(2, 4, 9)));
        CHECK_FALSE(each->includecheck_point(Point3D(2.1, 4, 9)));
        CHECK_FALSE(each->includecheck_point(Point3D(1, 2, 2.9)));
    }
    double area = 0;
    const auto triangles = box.get_triangleset();
    for (const Triangle3D& t : triangles) {
        CHECK(box.includecheck_triangle(t));
        Point3D a = t.pos2, b = t.pos3;
        a - t.pos1;
        b - t.pos1;
        area += std::hypot(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x) / 2;
    }
    CHECK(triangles.size() == 12);
    CHECK(area == Approx(2 * (2 * 4 + 2 * 6 + 4 * 6)));
}

TEST_CASE("shapes of v1 can be archived") {
    Obstacle3D wall;
    wall.name = "wall";
    wall.surface.resize(2);
    wall.surface[1].pos3 = Point3D(1, 2, 3);
    const Obstacle3D crossed = through_binary(wall);
    CHECK(crossed.name == "wall");
    REQUIRE(crossed.surface.size() == 2);
    CHECK(crossed.surface[1].pos3.y == 2);
    RectSolid3D box;
    box.setRectSolid(Point3D(), 2, 2, 2);
    CHECK(through_binary(box).includecheck_point(Point3D(1, 1, 2)));
    CHECK(getTypeName<RectSolid3D>() == "RectSolid3D");
}
