// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/host/opros/runtime/archive_source.hpp"
#include "tests/host/opros/runtime/recording_archive.hpp"

#include <deque>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

/// Encoded numbers that wait outside the component.
class TestSource : public ArchiveSource {
  public:
    void send(double value) {
        BinaryPipe pipe;
        pipe.out << value;
        waiting.push_back(pipe.bytes.str());
    }
    opros::archive::iarchive* next() override {
        ++next_calls;
        if (waiting.empty()) return nullptr;
        bytes_ = std::istringstream(waiting.front());
        archive_ = std::make_unique<opros::archive::binary_iarchive>(&bytes_);
        return archive_.get();
    }
    void done() override {
        waiting.pop_front();
        ++finished;
    }
    void undecodable(const std::string& why) override { error = why; }

    std::deque<std::string> waiting;
    std::string error;
    int finished = 0, next_calls = 0;

  private:
    std::istringstream bytes_;
    std::unique_ptr<opros::archive::binary_iarchive> archive_;
};

/// Offers the same encoded numbers whenever asked to, without allocating itself.
class RepeatingSource : public ArchiveSource {
  public:
    explicit RepeatingSource(const std::vector<double>& values) {
        BinaryPipe pipe;
        pipe.out << values;
        bytes_.str(pipe.bytes.str());
    }
    opros::archive::iarchive* next() override {
        if (!ready) return nullptr;
        bytes_.clear();
        bytes_.seekg(0);
        return &archive_;
    }
    void done() override { ready = false; }
    bool again(opros_any& value) override {
        ++repeats;
        ready = true;
        return take(&value);
    }

    bool ready = false;
    int repeats = 0;

  private:
    std::istringstream bytes_;
    opros::archive::binary_iarchive archive_{&bytes_};
};

/// Counts how often its pixels are copied.
struct Picture {
    Picture() = default;
    Picture(const Picture& other) : pixels(other.pixels) { copies += !pixels.empty(); }
    Picture& operator=(const Picture& other) {
        pixels = other.pixels;
        copies += !pixels.empty();
        return *this;
    }
    void save(opros::archive::oarchive& ar, const unsigned int) { ar << pixels; }
    void load(opros::archive::iarchive& ar, const unsigned int) { ar >> pixels; }
    std::vector<unsigned char> pixels;
    static inline int copies = 0;
};
inline std::string typeName(Picture*) { return "Picture"; }

class PictureSource : public ArchiveSource {
  public:
    using ArchiveSource::take;
    void take(unsigned char shade) { waiting_.push_back(shade); }
    opros::archive::iarchive* next() override {
        if (waiting_.empty()) return nullptr;
        Picture picture;
        picture.pixels.assign(1000, waiting_.front());
        BinaryPipe pipe;
        pipe.out << picture;
        bytes_ = std::istringstream(pipe.bytes.str());
        archive_ = std::make_unique<opros::archive::binary_iarchive>(&bytes_);
        return archive_.get();
    }
    void done() override { waiting_.pop_front(); }

  private:
    std::deque<unsigned char> waiting_;
    std::istringstream bytes_;
    std::unique_ptr<opros::archive::binary_iarchive> archive_;
};
