// SPDX-License-Identifier: Apache-2.0
// Counts the cells of the matrix; for both sides.
#pragma once

#include <chrono>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>
#include <syncstream>
#include <thread>

inline void require(bool holds) {
    if (!holds) throw std::logic_error("a value is not the expected one");
}

inline bool eventually(const std::function<bool()>& condition) {
    for (int i = 0; i < 1000; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
}

/// Counts the cells that pass, and prints each that fails, with why.
class Cells {
  public:
    /// `describe` turns what a cell throws into a text. failed() calls it, inside of the catch block.
    Cells(std::string direction, std::function<std::string()> describe)
        : direction_(std::move(direction)), describe_(std::move(describe)) {}

    void passed() { ++passed_; }
    void failed(const char* name) {
        ++failed_;
        std::osyncstream(std::cout) << "cell " << direction_ << " " << name << " failed: " << describe_()
                                    << std::endl;
    }
    void print() const {
        std::osyncstream(std::cout) << "cells " << direction_ << ": " << passed_ << " of "
                                    << passed_ + failed_ << " passed" << std::endl;
    }

  private:
    std::string direction_;
    std::function<std::string()> describe_;
    int passed_ = 0, failed_ = 0;
};
