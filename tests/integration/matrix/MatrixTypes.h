// SPDX-License-Identifier: Apache-2.0
// The OPRoS side of those kinds that need a class, as a user would write it.
#pragma once

#include <OPRoSInclude.h>
#include <device/Property.h>

#include <map>
#include <string>
#include <valarray>
#include <vector>

namespace matrix {

enum Mode { off, slow, fast };

struct Row {
    double values[3] = {};
    Row() = default;
    explicit Row(int i) : values{1.0 * i, 2.0 * i, 3.0 * i} {}
    void save(opros::archive::oarchive& ar, const unsigned int) { ar << values; }
    void load(opros::archive::iarchive& ar, const unsigned int) { ar >> values; }
};
inline bool operator==(const Row& a, const Row& b) { return std::equal(a.values, a.values + 3, b.values); }

typedef std::map<std::string, double> Weights;
inline Weights weights(int i) {
    Weights all;
    all["left"] = i;
    all["right"] = -i;
    return all;
}

inline Property settings(int i) {
    Property all;
    all.SetValue("speed", std::to_string(i));
    all.SetValue("name", "left");
    return all;
}

struct Record {
    int id = 0;
    double x = 0, y = 0;
    std::string label;
    Record() = default;
    explicit Record(int i) : id(i), x(2 * i), y(-i), label(std::to_string(i)) {}
    struct Place {
        double *x, *y;
        void save(opros::archive::oarchive& ar, const unsigned int) { ar << *x << *y; }
        void load(opros::archive::iarchive& ar, const unsigned int) { ar >> *x >> *y; }
    };
    void save(opros::archive::oarchive& ar, const unsigned int) {
        Place place{&x, &y};
        ar << OPROS_SERIALIZATION_NVP(id) << OPROS_SERIALIZATION_NVP(place) << OPROS_SERIALIZATION_NVP(label);
    }
    void load(opros::archive::iarchive& ar, const unsigned int) {
        Place place{&x, &y};
        ar >> OPROS_SERIALIZATION_NVP(id) >> OPROS_SERIALIZATION_NVP(place) >> OPROS_SERIALIZATION_NVP(label);
    }
};
inline bool operator==(const Record& a, const Record& b) {
    return a.id == b.id && a.x == b.x && a.y == b.y && a.label == b.label;
}

/// A union of IDL: a kind, and what that kind has.
struct Choice {
    int kind = 0;
    double number = 0;
    std::string text;
    Record place;
    Choice() = default;
    explicit Choice(int i) : kind(i % 4) {
        if (kind == 0) number = i;
        if (kind == 1) text = std::to_string(i);
        if (kind > 1) place.x = i;
    }
    template <class Archive, class Place>
    void both(Archive& ar, Place inner) {
        ar& kind;
        if (kind == 0) ar& number;
        if (kind == 1) ar& text;
        if (kind > 1) ar& inner;
    }
    void save(opros::archive::oarchive& ar, const unsigned int) {
        both(ar, Record::Place{&place.x, &place.y});
    }
    void load(opros::archive::iarchive& ar, const unsigned int) {
        *this = Choice(); // a port decodes into the object of an older value
        both(ar, Record::Place{&place.x, &place.y});
    }
};
inline bool operator==(const Choice& a, const Choice& b) {
    return a.kind == b.kind && a.number == b.number && a.text == b.text && a.place == b.place;
}

/// An any of CORBA: the signature of its value, and the value in CDR.
struct Anything {
    std::string signature = "d";
    std::vector<unsigned char> value;
    Anything() = default;
    explicit Anything(int i) : value(8) {
        const double number = i;
        std::copy_n(reinterpret_cast<const unsigned char*>(&number), 8, value.begin());
    }
    void save(opros::archive::oarchive& ar, const unsigned int) { ar << signature << value; }
    void load(opros::archive::iarchive& ar, const unsigned int) { ar >> signature >> value; }
};
inline bool operator==(const Anything& a, const Anything& b) {
    return a.signature == b.signature && a.value == b.value;
}

template <class T>
bool same(const T& a, const T& b) {
    return a == b;
}
inline bool same(const std::valarray<double>& a, const std::valarray<double>& b) {
    return a.size() == b.size() && std::equal(std::begin(a), std::end(a), std::begin(b));
}

inline bool same(Property a, Property b) { return a.GetProperty() == b.GetProperty(); }

} // namespace matrix
