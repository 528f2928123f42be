// SPDX-License-Identifier: Apache-2.0
#include "host/log/log.hpp"

#include "host/log/log_output.hpp"
#include "host/text/printable.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <mutex>
#include <string>
#include <unistd.h>
#include <utility>

namespace tandem::log {
namespace {

/// Does not wait for the reader of standard error: threads of components with a period log, too.
class Sink final : public spdlog::sinks::base_sink<std::mutex> {
  public:
    explicit Sink(const std::string& program)
        : output_(STDERR_FILENO, program, std::chrono::milliseconds(0)) {}
    void print(std::string_view line) {
        const std::lock_guard lock(mutex_);
        output_.write(std::string(line) + "\n");
    }

  private:
    void sink_it_(const spdlog::details::log_msg& message) override {
        spdlog::memory_buf_t text;
        formatter_->format(message, text);
        output_.write({text.data(), text.size()});
    }
    void flush_() override {
        if (output_.missing() > 0) output_.write("");
    }

    LogOutput output_;
};

/// `%*`: the level by its name in the log of RT-Components, which is `warn` and not `warning`.
class LevelName final : public spdlog::custom_flag_formatter {
  public:
    void format(const spdlog::details::log_msg& message, const std::tm&,
                spdlog::memory_buf_t& text) override {
        const std::string_view name = message.level == spdlog::level::err    ? "error"
                                      : message.level == spdlog::level::warn ? "warn"
                                                                             : "info";
        text.append(name.data(), name.data() + name.size());
    }
    std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<LevelName>(); }
};

/// Never destroyed: the log is flushed while static objects are destroyed.
std::shared_ptr<Sink>& sink_of_process() {
    static auto* const sink = new std::shared_ptr<Sink>;
    return *sink;
}

} // namespace

void open(const std::string& program) {
    sink_of_process() = std::make_shared<Sink>(program);
    spdlog::set_default_logger(std::make_shared<spdlog::logger>(program, sink_of_process()));
    auto formatter = std::make_unique<spdlog::pattern_formatter>();
    formatter->add_flag<LevelName>('*').set_pattern("[%Y-%m-%d %H:%M:%S.%e] [%*] %n: %v");
    spdlog::set_formatter(std::move(formatter));
}

void write_errors_only() { spdlog::set_level(spdlog::level::err); }

void print(std::string_view line) {
    if (const auto sink = sink_of_process())
        sink->print(line);
    else
        std::fprintf(stderr, "%.*s\n", static_cast<int>(line.size()), line.data());
}

void flush() {
    if (const auto sink = sink_of_process()) sink->flush();
}

void error(std::string_view line) { spdlog::error(text::printable_text(line)); }
void warn(std::string_view line) { spdlog::warn(text::printable_text(line)); }
void info(std::string_view line) { spdlog::info(text::printable_text(line)); }

} // namespace tandem::log
