// SPDX-License-Identifier: Apache-2.0
// The OPRoS side of those kinds that need a class, as a user would write it.
#pragma once

#include <OPRoSInclude.h>
#include <device/Property.h>

#include <limits>
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

/// A union of IDL with labels above INT64_MAX.
struct Selected {
    unsigned long long label = 0;
    int low = 0;
    std::string high;
    double other = 0;
    Selected() = default;
    explicit Selected(int i) : label(i == 1 ? 1ULL << 63 : i == 2 ? ~0ULL : 0) {
        if (i == 1) low = i;
        if (i == 2) high = "high";
        if (i == 3) other = i;
    }
    template <class Archive>
    void both(Archive& ar) {
        ar& label;
        if (label == 1ULL << 63)
            ar& low;
        else if (label == ~0ULL)
            ar& high;
        else
            ar& other;
    }
    void save(opros::archive::oarchive& ar, const unsigned int) { both(ar); }
    void load(opros::archive::iarchive& ar, const unsigned int) {
        *this = Selected(); // a port decodes into the object of an older value
        both(ar);
    }
};
inline bool operator==(const Selected& a, const Selected& b) {
    return a.label == b.label && a.low == b.low && a.high == b.high && a.other == b.other;
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

/// An any that returns, with its number.
struct Returned {
    int number = 0;
    Anything content;
    void save(opros::archive::oarchive& ar, const unsigned int) { ar << number << content; }
    void load(opros::archive::iarchive& ar, const unsigned int) { ar >> number >> content; }
};

/// The lowest value for the first of three messages, the highest for the second.
template <class T>
T extreme(int i) {
    return i == 1                               ? std::numeric_limits<T>::lowest()
           : i == 2                             ? std::numeric_limits<T>::max()
           : std::numeric_limits<T>::is_integer ? T()
                                                : std::numeric_limits<T>::denorm_min();
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
