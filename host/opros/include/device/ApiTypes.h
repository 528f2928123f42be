// SPDX-License-Identifier: Apache-2.0
// The data types on the ports of device components. Types of OPRoS v1.1 are global. Types of v2 are in namespace
// OPRoS and contain the status of the call that produced them.
#ifndef DEVICE_APITYPES_H_
#define DEVICE_APITYPES_H_

#include "../archive/opros_access.h"
#include "../archive/opros_archive.h"
#include "ApiMembers.h"
#include "ApiTypesV1.h"
#include "ApiValues.h"
#include "GeometryV1.h"
#include "OprosMath.h"

#include <assert.h>
#include <deque>
#include <string>
#include <valarray>
#include <vector>

using namespace std; // components rely on it

/// Upstream's arithmetic for its coordinate types: member by member, into the left operand.
#define OPROS_API_SIX(type, a, b, c, d, e, f)                                                                \
    double a, b, c, d, e, f;                                                                                 \
    type() : a(0), b(0), c(0), d(0), e(0), f(0) {}                                                           \
    type(double a_, double b_, double c_, double d_, double e_, double f_)                                   \
        : a(a_), b(b_), c(c_), d(d_), e(e_), f(f_) {}                                                        \
    type(const type&) = default;                                                                             \
    type& operator=(const type&) = default;                                                                  \
    virtual ~type() {}                                                                                       \
    OPROS_API_MEMBERS(a, b, c, d, e, f)                                                                      \
    type operator+(const type& o) {                                                                          \
        return *this = type(a + o.a, b + o.b, c + o.c, d + o.d, e + o.e, f + o.f);                           \
    }                                                                                                        \
    type operator-(const type& o) {                                                                          \
        return *this = type(a - o.a, b - o.b, c - o.c, d - o.d, e - o.e, f - o.f);                           \
    }                                                                                                        \
    type operator*(const type& o) {                                                                          \
        return *this = type(a * o.a, b * o.b, c * o.c, d * o.d, e * o.e, f * o.f);                           \
    }                                                                                                        \
    type operator/(const type& o) {                                                                          \
        return *this = type(a / o.a, b / o.b, c / o.c, d / o.d, e / o.e, f / o.f);                           \
    }

// Each class lists its members in the order in which they are archived. The order is part of the wire format between
// a v1.1 component and its peer, and must not change.
/// A position and an attitude.
class ObjectPosition {
  public:
    OPROS_API_SIX(ObjectPosition, x, y, z, roll, pitch, yaw)
};
OPROS_API_TYPE_NAME(ObjectPosition)

/// A pose of a hand or tool.
class CartesianCoordinate {
  public:
    OPROS_API_SIX(CartesianCoordinate, x, y, z, roll, pitch, yaw)
};
OPROS_API_TYPE_NAME(CartesianCoordinate)

/// Forces and torques in three axes.
class ForceTorqueSensorData {
  public:
    OPROS_API_SIX(ForceTorqueSensorData, fx, fy, fz, tx, ty, tz)
};
OPROS_API_TYPE_NAME(ForceTorqueSensorData)

/// An attitude. Its arithmetic changes the left operand, as in upstream.
class ObjectRotation {
  public:
    double roll, pitch, yaw;
    ObjectRotation() : roll(0), pitch(0), yaw(0) {}
    ObjectRotation(double roll_, double pitch_, double yaw_) : roll(roll_), pitch(pitch_), yaw(yaw_) {}
    ObjectRotation(const ObjectRotation&) = default;
    ObjectRotation& operator=(const ObjectRotation&) = default;
    virtual ~ObjectRotation() {}
    OPROS_API_MEMBERS(roll, pitch, yaw)
    ObjectRotation operator+(const ObjectRotation& o) {
        return *this = {roll + o.roll, pitch + o.pitch, yaw + o.yaw};
    }
    ObjectRotation operator-(const ObjectRotation& o) {
        return *this = {roll - o.roll, pitch - o.pitch, yaw - o.yaw};
    }
    ObjectRotation operator*(const ObjectRotation& o) {
        return *this = {roll * o.roll, pitch * o.pitch, yaw * o.yaw};
    }
    ObjectRotation operator/(const ObjectRotation& o) {
        return *this = {roll / o.roll, pitch / o.pitch, yaw / o.yaw};
    }
};
OPROS_API_TYPE_NAME(ObjectRotation)

namespace OPRoS {
/// Its name in the gyroscope component of OPRoS v1.1.
typedef ::ObjectRotation Rotation;
} // namespace OPRoS

/// Turning rates, accelerations and attitude of an inertial unit.
class ObjectPosture {
  public:
    double pRate = 0, qRate = 0, rRate = 0;
    double xAcceleration = 0, yAcceleration = 0, zAcceleration = 0;
    double roll = 0, pitch = 0, yaw = 0;
    OPROS_API_MEMBERS(pRate, qRate, rRate, xAcceleration, yAcceleration, zAcceleration, roll, pitch, yaw)
};
OPROS_API_TYPE_NAME(ObjectPosture)

/// A position and heading in the plane, with the arithmetic of coordinate frames.
class ObjectLocation {
  public:
    double x, y, theta;
    ObjectLocation() : x(0), y(0), theta(0) {}
    /// Constructs from polar coordinates. The heading is the angle.
    ObjectLocation(double length, double angle)
        : x(length * cos(angle)), y(length * sin(angle)), theta(angle) {}
    ObjectLocation(double x_, double y_, double theta_) : x(x_), y(y_), theta(theta_) {}
    OPROS_API_MEMBERS(x, y, theta)

    ObjectLocation& operator+=(const ObjectLocation& p) { return set(x + p.x, y + p.y, theta + p.theta); }
    ObjectLocation& operator-=(const ObjectLocation& p) { return set(x - p.x, y - p.y, theta - p.theta); }
    ObjectLocation& operator*=(const ObjectLocation& p) { return set(x * p.x, y * p.y, theta * p.theta); }
    ObjectLocation& operator/=(const ObjectLocation& p) { return set(x / p.x, y / p.y, theta / p.theta); }
    ObjectLocation& operator*=(double d) { return set(x * d, y * d, theta * d); }
    /// Rotates position and heading about the origin.
    ObjectLocation& Rotate(double rad) {
        return set(x * cos(rad) - y * sin(rad), x * sin(rad) + y * cos(rad), theta + rad);
    }
    ObjectLocation& Translate(double dx, double dy) { return set(x + dx, y + dy, theta); }
    /// Transforms from the frame with origin and heading p to the frame in which p is given.
    ObjectLocation& Transform(const ObjectLocation& p) {
        Rotate(p.theta);
        return Translate(p.x, p.y);
    }
    double Atan() const { return atan2(y, x); }
    double Length() const { return sqrt(x * x + y * y); }
    double Distance(const ObjectLocation& p) const { return ::Length(p.x - x, p.y - y); }

  private:
    ObjectLocation& set(double x_, double y_, double theta_) {
        x = x_;
        y = y_;
        theta = theta_;
        return *this;
    }
};
OPROS_API_TYPE_NAME(ObjectLocation)

inline ObjectLocation operator+(ObjectLocation a, const ObjectLocation& b) { return a += b; }
inline ObjectLocation operator-(ObjectLocation a, const ObjectLocation& b) { return a -= b; }
inline ObjectLocation operator*(ObjectLocation a, const ObjectLocation& b) { return a *= b; }
inline ObjectLocation operator/(ObjectLocation a, const ObjectLocation& b) { return a /= b; }
inline ObjectLocation diff(const ObjectLocation& a, const ObjectLocation& b) {
    return ObjectLocation(a.x - b.x, a.y - b.y, DeltaRad(a.theta, b.theta));
}

/// Axes and buttons.
class JoystickData {
  public:
    double x = 0, y = 0, z = 0;
    std::vector<bool> button;
    OPROS_API_MEMBERS(x, y, z, button)
};
OPROS_API_TYPE_NAME(JoystickData)

/// A position on the earth, with time and velocity.
class GpsData {
  public:
    double latitude = 0, longitude = 0;
    std::string time;
    double velocity = 0;
    OPROS_API_MEMBERS(latitude, longitude, time, velocity)
};
OPROS_API_TYPE_NAME(GpsData)

/// An object found in an image, and its four corners in pixels.
class VisionRecognitionResult {
  public:
    std::string name;
    int point1X = 0, point1Y = 0, point2X = 0, point2Y = 0, point3X = 0, point3Y = 0, point4X = 0,
        point4Y = 0;
    OPROS_API_MEMBERS(name, point1X, point1Y, point2X, point2Y, point3X, point3Y, point4X, point4Y)
};
OPROS_API_TYPE_NAME(VisionRecognitionResult)

/// The name of a colour and the ranges of its three channels.
class ColorRange {
  public:
    std::string name;
    unsigned char min1 = 0, max1 = 0, min2 = 0, max2 = 0, min3 = 0, max3 = 0;
    OPROS_API_MEMBERS(name, min1, max1, min2, max2, min3, max3)
};
OPROS_API_TYPE_NAME(ColorRange)

/// One frame on a CAN bus.
class CanData {
  public:
    long id;
    std::vector<unsigned char> data;
    CanData() : id(0) {}
    CanData(long id_, std::vector<unsigned char> data_) : id(id_), data(data_) {}
    OPROS_API_MEMBERS(id, data)
};
OPROS_API_TYPE_NAME(CanData)

#endif
