// SPDX-License-Identifier: Apache-2.0
// Archives such as a bridge brings: one that only records which types it is asked for, one that keeps the
// numbers.
#pragma once

#include <archive/opros_archive.h>

#include <deque>
#include <string>

/// Every load appends a letter to the text; a sequence is a, an array [N].
class TypeRecorder : public opros::archive::iarchive {
  public:
    std::string text;
    using iarchive::load;

    opros::archive::iarchive& load(bool& v) override { return note("b", v); }
    opros::archive::iarchive& load(char& v) override { return note("c", v); }
    opros::archive::iarchive& load(signed char& v) override { return note("c", v); }
    opros::archive::iarchive& load(unsigned char& v) override { return note("y", v); }
    opros::archive::iarchive& load(wchar_t& v) override { return note("w", v); }
    opros::archive::iarchive& load(short& v) override { return note("n", v); }
    opros::archive::iarchive& load(unsigned short& v) override { return note("q", v); }
    opros::archive::iarchive& load(int& v) override { return note("i", v); }
    opros::archive::iarchive& load(unsigned int& v) override { return note("u", v); }
    opros::archive::iarchive& load(long& v) override { return note("x", v); }
    opros::archive::iarchive& load(unsigned long& v) override { return note("t", v); }
    opros::archive::iarchive& load(long long& v) override { return note("x", v); }
    opros::archive::iarchive& load(unsigned long long& v) override { return note("t", v); }
    opros::archive::iarchive& load(float& v) override { return note("f", v); }
    opros::archive::iarchive& load(double& v) override { return note("d", v); }
    opros::archive::iarchive& load(long double& v) override { return note("D", v); }
    opros::archive::iarchive& load(std::string&) override { return add("s"); }
    opros::archive::iarchive& load(std::wstring&) override { return add("w"); }
    opros::archive::iarchive& load_binary(char** p, long& size) override {
        if (!*p) *p = new char[1];
        size = 0;
        return add("ay");
    }
    opros::archive::iarchive& read_class_head(const std::string&) override { return add("("); }
    opros::archive::iarchive& read_class_end(const std::string&) override { return add(")"); }
    std::size_t read_sequence_head() override {
        add("a");
        return 1;
    }
    long read_array_head(long size, char, char) override {
        add("[" + std::to_string(size) + "]");
        return 1;
    }

  private:
    opros::archive::iarchive& add(const std::string& letters) {
        text += letters;
        return *this;
    }
    template <typename T>
    opros::archive::iarchive& note(const char* letter, T& value) {
        value = T();
        return add(letter);
    }
};

/// The memory that binary archives write to and read from.
class BinaryPipe {
  public:
    std::stringstream bytes;
    opros::archive::binary_oarchive out{&bytes};
    opros::archive::binary_iarchive in{&bytes};
};

template <typename T>
T through_archive(const T& value) {
    BinaryPipe pipe;
    pipe.out << value;
    T copy = T();
    pipe.in >> copy;
    return copy;
}
