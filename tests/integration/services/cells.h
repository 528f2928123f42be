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

/// Runs cells and prints each that fails, with why.
class Cells {
  public:
    /// `describe` turns what a cell throws into a text; called inside of a catch block.
    Cells(std::string direction, std::function<std::string()> describe)
        : direction_(std::move(direction)), describe_(std::move(describe)) {}

    template <class Cell>
    void run(const char* name, Cell cell) {
        const auto call = [](void* typed) { (*static_cast<Cell*>(typed))(); };
        run(name, call, &cell);
    }
    void print() const {
        std::osyncstream(std::cout) << "cells " << direction_ << ": " << passed_ << " of " << count_
                                    << " passed" << std::endl;
    }

  private:
    // Without std::function, of which some hundred different ones would be compiled.
    void run(const char* name, void (*call)(void*), void* cell) {
        ++count_;
        try {
            call(cell);
            ++passed_;
        } catch (...) { // CORBA exceptions are no std::exception
            std::osyncstream(std::cout)
                << "cell " << direction_ << " " << name << " failed: " << describe_() << std::endl;
        }
    }

    std::string direction_;
    std::function<std::string()> describe_;
    int count_ = 0, passed_ = 0;
};
