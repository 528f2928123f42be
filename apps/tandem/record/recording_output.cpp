// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/record/recording_output.hpp"

#include <fmt/format.h>

#include <utility>

namespace tandem::command {

RecordingOutput::RecordingOutput(const std::string& file, mcap::WriterOptions options)
    : name_(file), file_(file), writer_(file_, std::move(options)) {}

RecordingOutput::~RecordingOutput() {
    if (ended_) return;
    try {
        if (writer_.messages() == 0) {
            discard();
        } else {
            writer_.close();
            file_.close();
        }
    } catch (const mcap::Error&) { // the exception that ends the recording is more important
    }
}

void RecordingOutput::close() {
    try {
        writer_.close();
        file_.close();
    } catch (const mcap::Error& error) {
        end_after(error);
    }
    ended_ = true;
}

void RecordingOutput::end_after(const mcap::Error& error) {
    const std::string cause = error.what();
    if (std::exchange(ended_, true)) throw mcap::Error(cause);
    const auto rest = writer_.end_at_last_chunk();
    if (rest.messages == 0) {
        file_.discard();
        throw mcap::Error(cause + "; nothing was recorded");
    }
    bool closed = rest.closed;
    try {
        if (closed) file_.close();
    } catch (const mcap::Error&) { // the same disk
        closed = false;
    }
    throw mcap::Error(fmt::format(
        "{}; the recording ends there: it has {} messages, and the last {} are lost{}", cause, rest.messages,
        rest.lost_messages, closed ? "" : "; it is not closed, which tandem bag cut repairs"));
}

void RecordingOutput::discard() {
    ended_ = true;
    file_.discard();
}

} // namespace tandem::command
