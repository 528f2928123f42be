// SPDX-License-Identifier: Apache-2.0
// Points, triangles and boxes of OPRoS v1, and the results of its 3D recognition. Part of ApiTypes.h, which
// components include.
#ifndef DEVICE_GEOMETRYV1_H_
#define DEVICE_GEOMETRYV1_H_

#include "ApiMembers.h"

#include <math.h>
#include <string>
#include <vector>

struct _IplImage; // OpenCV's
struct CvMat;

/// The arithmetic works member by member, into the left operand, as in upstream.
class Point3D {
  public:
    double x, y, z;
    Point3D() : x(0), y(0), z(0) {}
    Point3D(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
    Point3D operator+(const Point3D& o) { return *this = Point3D(x + o.x, y + o.y, z + o.z); }
    Point3D operator-(const Point3D& o) { return *this = Point3D(x - o.x, y - o.y, z - o.z); }
    Point3D operator*(const Point3D& o) { return *this = Point3D(x * o.x, y * o.y, z * o.z); }
    Point3D operator/(const Point3D& o) { return *this = Point3D(x / o.x, y / o.y, z / o.z); }
    OPROS_API_MEMBERS(x, y, z)
};
OPROS_API_TYPE_NAME(Point3D)

class Triangle3D {
  public:
    Point3D pos1, pos2, pos3;
    OPROS_API_MEMBERS(pos1, pos2, pos3)
};
OPROS_API_TYPE_NAME(Triangle3D)

class Obstacle3D {
  public:
    std::string name;
    std::vector<Triangle3D> surface;
    OPROS_API_MEMBERS(name, surface)
};
OPROS_API_TYPE_NAME(Obstacle3D)

/// Eight corners: 0 to 3 around the bottom, 4 to 7 above them.
class Hexahedron3D {
  public:
    OPROS_API_MEMBERS(Ver[0], Ver[1], Ver[2], Ver[3], Ver[4], Ver[5], Ver[6], Ver[7])

  protected:
    Point3D Ver[8];
};
OPROS_API_TYPE_NAME(Hexahedron3D)

/// A box along the axes. Corner 0 has the least x, y and z. Corner 1 is its neighbour in x, corner 3 in y.
class RectSolid3D : public Hexahedron3D {
  public:
    /// Copies the other's corners, as in upstream.
    RectSolid3D operator+(const RectSolid3D& other) { return *this = other; }

    /// Sets the box. `origin_point` is the centre of the bottom; width is along x, length along y.
    void setRectSolid(Point3D origin_point, double width, double length, double height) {
        const double dx = fabs(width) / 2, dy = fabs(length) / 2;
        for (int i = 0; i < 8; ++i) {
            const int corner = i % 4;
            Ver[i].x = origin_point.x + (corner == 1 || corner == 2 ? dx : -dx);
            Ver[i].y = origin_point.y + (corner >= 2 ? dy : -dy);
            Ver[i].z = origin_point.z + (i >= 4 ? fabs(height) : 0);
        }
    }
    /// Sets the box from two opposite corners.
    void setRectSolid2Corner(Point3D one_corner, Point3D two_corner) {
        const Point3D bottom((one_corner.x + two_corner.x) / 2, (one_corner.y + two_corner.y) / 2,
                             fmin(one_corner.z, two_corner.z));
        setRectSolid(bottom, one_corner.x - two_corner.x, one_corner.y - two_corner.y,
                     one_corner.z - two_corner.z);
    }
    /// Return true if the point, or the whole triangle, is in the box or on its surface.
    bool includecheck_point(Point3D P) {
        return Ver[0].x <= P.x && P.x <= Ver[1].x && Ver[0].y <= P.y && P.y <= Ver[3].y && Ver[0].z <= P.z &&
               P.z <= Ver[4].z;
    }
    bool includecheck_triangle(Triangle3D T) {
        return includecheck_point(T.pos1) && includecheck_point(T.pos2) && includecheck_point(T.pos3);
    }
    /// Returns the surface, two triangles per side: top, bottom, front, back, right, left.
    std::vector<Triangle3D> get_triangleset() {
        static const int corners[12][3] = {{4, 5, 7}, {6, 7, 5}, {0, 3, 1}, {2, 1, 3}, {0, 1, 4}, {5, 4, 1},
                                           {2, 3, 6}, {7, 6, 3}, {1, 2, 5}, {6, 5, 2}, {0, 4, 3}, {7, 3, 4}};
        std::vector<Triangle3D> triangles(12);
        for (int i = 0; i < 12; ++i) {
            triangles[i].pos1 = Ver[corners[i][0]];
            triangles[i].pos2 = Ver[corners[i][1]];
            triangles[i].pos3 = Ver[corners[i][2]];
        }
        return triangles;
    }
};
OPROS_API_TYPE_NAME(RectSolid3D)

/// The image and the matrix stay in their process: only the name is archived.
class VisionRecognition3DResult {
  public:
    std::string name;
    _IplImage* cvImage;
    CvMat* mat3d;
    VisionRecognition3DResult() : cvImage(NULL), mat3d(NULL) {}
    OPROS_API_MEMBERS(name)
};
OPROS_API_TYPE_NAME(VisionRecognition3DResult)

#endif
