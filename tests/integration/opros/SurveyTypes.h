// SPDX-License-Identifier: Apache-2.0
// A class of a user's own for each way in which real components serialize theirs.
#pragma once

#include <OPRoSTypes.h>

#include <string>
#include <vector>

/// save() and load().
class Mark {
  public:
    double x = 0, y = 0;
    std::string label;
    void save(opros::archive::oarchive& ar, const unsigned int) {
        ar << OPROS_SERIALIZATION_NVP(x) << OPROS_SERIALIZATION_NVP(y) << OPROS_SERIALIZATION_NVP(label);
    }
    void load(opros::archive::iarchive& ar, const unsigned int) {
        ar >> OPROS_SERIALIZATION_NVP(x) >> OPROS_SERIALIZATION_NVP(y) >> OPROS_SERIALIZATION_NVP(label);
    }
};
inline std::string typeName(Mark*) { return "Mark"; }

/// save_this() and load_this().
struct Scan {
    int id = 0;
    std::vector<Mark> marks;
    bool valid = false;
};
inline std::string typeName(Scan*) { return "Scan"; }
inline void save_this(opros::archive::oarchive& ar, Scan& scan) { ar << scan.id << scan.marks << scan.valid; }
inline void load_this(opros::archive::iarchive& ar, Scan& scan) { ar >> scan.id >> scan.marks >> scan.valid; }

/// serialize(), one for both directions, of OPRoS v1.
class Reading {
  public:
    int channel = 0;
    std::vector<double> values;
    template <class Archive>
    void serialize(Archive& ar, const unsigned int) {
        ar& BOOST_SERIALIZATION_NVP(channel);
        ar& BOOST_SERIALIZATION_NVP(values);
    }
};
