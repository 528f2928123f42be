// SPDX-License-Identifier: Apache-2.0
// Provides every operation of the matrix, and calls those of both providers that it is connected to.
#include "../opros/simple_component.h"

#include <OPRoSInclude.h>
#include <ServiceUtils.h>

#include "MatrixCells.h"
#include "cells.h"

#include <ProvidedMethod.h>
#include <ProvidedServicePort.h>
#include <RequiredMethod.h>
#include <RequiredServicePort.h>
#include <device/Property.h>

#include <atomic>
#include <cstring>
#include <limits>
#include <map>

// ---- the structures of the IDL, and values of a seed as ServiceMatrixRtc.cpp has them

enum Mode { off, slow, fast };

/// An any of the IDL: the signature of its value, and the value as CDR.
struct Anything {
    std::string signature;
    std::vector<unsigned char> value;
};
inline std::string typeName(Anything*) { return "Anything"; }
inline void save_this(opros::archive::oarchive& ar, Anything& any) { ar << any.signature << any.value; }
inline void load_this(opros::archive::iarchive& ar, Anything& any) { ar >> any.signature >> any.value; }

struct Point {
    double x = 0;
    int grid[3] = {};
};
inline std::string typeName(Point*) { return "Point"; }
inline void save_this(opros::archive::oarchive& ar, Point& point) { ar << point.x << point.grid; }
inline void load_this(opros::archive::iarchive& ar, Point& point) { ar >> point.x >> point.grid; }

struct Label {
    std::string text;
    Point place;
    bool valid = false;
};
inline std::string typeName(Label*) { return "Label"; }
inline void save_this(opros::archive::oarchive& ar, Label& label) {
    ar << label.text << label.place << label.valid;
}
inline void load_this(opros::archive::iarchive& ar, Label& label) {
    ar >> label.text >> label.place >> label.valid;
}

/// A union of the IDL: its discriminator, and the member that this selects.
struct Choice {
    int kind = 0;
    double number = 0;
    std::string text;
    Point place;
    template <class Archive>
    void both(Archive& ar) {
        ar& kind;
        if (kind == 0) ar& number;
        if (kind == 1) ar& text;
        if (kind > 1) ar& place;
    }
};
inline std::string typeName(Choice*) { return "Choice"; }
inline void save_this(opros::archive::oarchive& ar, Choice& choice) { choice.both(ar); }
inline void load_this(opros::archive::iarchive& ar, Choice& choice) {
    choice = Choice();
    choice.both(ar);
}

namespace {

/// The lowest number for a third of the seeds, the highest for another third. The sign of a character does not matter.
template <class T>
void set(T& value, int seed) {
    using Limits = std::numeric_limits<T>;
    const bool lowest = seed % 3 == 0, highest = seed % 3 == 1;
    if constexpr (sizeof(T) == 1)
        value = static_cast<T>(lowest ? 0x80 : highest ? 0xff : seed);
    else if constexpr (Limits::is_integer)
        value = lowest ? Limits::min() : highest ? Limits::max() : static_cast<T>(seed);
    else
        value = lowest ? Limits::lowest() : highest ? Limits::max() : static_cast<T>(seed) / 4;
}
void set(bool& value, int seed) { value = seed % 2 != 0; }
void set(wchar_t& value, int seed) { value = static_cast<wchar_t>(seed % 3 == 0 ? 0xffff : seed); }
void set(Mode& value, int seed) { value = static_cast<Mode>(seed % 3); }
// Also one of the type `fixed<6, 2>`, which is a string here.
void set(std::string& value, int seed) {
    value = seed % 3 == 0 ? "-9999.99" : seed % 3 == 1 ? "9999.99" : std::to_string(seed) + ".25";
}
void set(std::wstring& value, int seed) {
    value.assign(static_cast<std::size_t>(seed % 4), seed % 2 == 0 ? L'\uffff' : L'\u00e9');
}
void set(Anything& any, int seed) {
    const double number = seed + 0.25;
    any.signature = "d";
    any.value.resize(sizeof number);
    std::memcpy(any.value.data(), &number, sizeof number);
}
void set(std::map<std::string, double>& weights, int seed) {
    weights.clear();
    for (int i = 0; i < seed % 3; ++i) weights[std::string(1, static_cast<char>('a' + i))] = seed + i;
}
void set(Point& value, int seed) {
    value.x = seed + 0.25;
    for (int i = 0; i < 3; ++i) value.grid[i] = seed + i;
}
void set(Label& value, int seed) {
    set(value.text, seed);
    set(value.place, seed);
    value.valid = seed % 2 != 0;
}
void set(Choice& value, int seed) {
    value = Choice();
    value.kind = seed % 4;
    if (value.kind == 0) set(value.number, seed);
    if (value.kind == 1) set(value.text, seed);
    if (value.kind > 1) set(value.place, seed);
}
void set(Property& property, int seed) {
    std::map<std::string, std::string> settings;
    for (int i = 0; i < seed % 3; ++i)
        settings[std::string(1, static_cast<char>('a' + i))] = std::to_string(seed);
    property.SetProperty(settings);
}
template <class T>
void set(std::vector<T>& values, int seed) {
    values.resize(static_cast<std::size_t>(seed % 3));
    for (std::size_t i = 0; i < values.size(); ++i) set(values[i], seed + static_cast<int>(i));
}
template <class T>
void clear(T& value) {
    set(value, 98);
}
bool equal(const Point& a, const Point& b) { return a.x == b.x && std::equal(a.grid, a.grid + 3, b.grid); }
bool equal(const Label& a, const Label& b) {
    return a.text == b.text && equal(a.place, b.place) && a.valid == b.valid;
}
bool equal(const Choice& a, const Choice& b) {
    return a.kind == b.kind && a.number == b.number && a.text == b.text && equal(a.place, b.place);
}
bool equal(const Anything& a, const Anything& b) { return a.signature == b.signature && a.value == b.value; }
bool equal(Property a, Property b) { return a.GetProperty() == b.GetProperty(); }
template <class T>
bool equal(const T& a, const T& b) {
    return a == b;
}
template <class T>
bool equal(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(), [](const T& x, const T& y) { return equal(x, y); });
}
template <class T>
T made(int seed) {
    T value{};
    set(value, seed);
    return value;
}
template <class T>
bool same(const T& value, int seed) {
    return equal(value, made<T>(seed));
}

std::string what() {
    try {
        throw;
    } catch (const std::exception& error) {
        return error.what();
    }
}

#include "MatrixOpros.h"

} // namespace

class ServiceMatrixComp : public SimpleComponent, public MatrixService {
  public:
    ServiceMatrixComp() {
        addPort("first", first_);
        addPort("second", second_);
        addPort("matrix", new MatrixProvided(this));
    }
    ReturnType onExecute() override {
        if (done_) return OPROS_SUCCESS;
        done_ = true;
        for (auto* port : {first_, second_}) {
            Cells cells("OPRoS to RTM", what);
            call_all(*port, cells);
            cells.print();
        }
        return OPROS_SUCCESS;
    }

  private:
    MatrixRequired* first_ = new MatrixRequired; // the component deletes its service ports
    MatrixRequired* second_ = new MatrixRequired;
    bool done_ = false;
};

extern "C" {
Component* getComponent() { return new ServiceMatrixComp; }
void releaseComponent(Component* component) { delete component; }
}
