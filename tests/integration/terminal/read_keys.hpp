// SPDX-License-Identifier: Apache-2.0
// Reads the keyboard as components do.
#pragma once

#include <cstdio>
#include <fcntl.h>
#include <iostream>
#include <string>
#include <syncstream>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

inline void print_line(const std::string& text) { std::osyncstream(std::cout) << text << std::endl; }

inline termios without_lines(termios settings) {
    settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    return settings;
}

/// Waits for a key without Enter, and prints it.
inline void wait_for_key() {
    termios before{};
    tcgetattr(STDIN_FILENO, &before);
    const termios keys = without_lines(before);
    tcsetattr(STDIN_FILENO, TCSANOW, &keys);
    const int key = std::getchar();
    print_line(key == EOF ? "end of keys" : std::string("key ") + static_cast<char>(key));
}

/// Prints a key if there is one, and leaves the terminal as it was.
inline void look_for_key() {
    termios before{};
    tcgetattr(STDIN_FILENO, &before);
    const termios keys = without_lines(before);
    tcsetattr(STDIN_FILENO, TCSANOW, &keys);
    const int flags = fcntl(STDIN_FILENO, F_GETFL);
    fcntl(STDIN_FILENO, F_SETFL, flags | O_NONBLOCK);
    char key = 0;
    if (read(STDIN_FILENO, &key, 1) == 1) print_line(std::string("key ") + key);
    fcntl(STDIN_FILENO, F_SETFL, flags);
    tcsetattr(STDIN_FILENO, TCSANOW, &before);
}

/// Waits for a line, and prints it and the width of the terminal.
inline void wait_for_line() {
    std::string line;
    std::getline(std::cin, line);
    winsize size{};
    ioctl(STDIN_FILENO, TIOCGWINSZ, &size);
    print_line("line " + line + ", " + std::to_string(size.ws_col) + " columns");
}

/// Closes its input, and counts its cycles from then on.
inline void close_input() {
    static int cycles = 0;
    if (cycles++ == 0) close(STDIN_FILENO);
    print_line("cycle " + std::to_string(cycles) + ".");
}

inline void read_keys(const std::string& how) {
    if (how == "wait_for_key") wait_for_key();
    if (how == "look_for_key") look_for_key();
    if (how == "wait_for_line") wait_for_line();
    if (how == "close_input") close_input();
}
