// SPDX-License-Identifier: Apache-2.0
// A client of the HTTP server of `tandem monitor`. Without a header of Boost, as running_monitor.hpp.
#pragma once
#include "running_monitor.hpp"

#include <memory>
#include <nlohmann/json.hpp>

namespace tandem::monitor::test {

struct Answer {
    unsigned status = 0;
    std::string type, body;
    std::vector<std::pair<std::string, std::string>> fields;
    /// Empty if there is none; capital letters do not count in names.
    std::string field(const std::string& name) const;
};

/// A connection on which bytes are sent as they are.
class Connection {
  public:
    explicit Connection(const RunningMonitor& monitor);
    ~Connection();
    void send(const std::string& bytes);
    /// Status 0: the server has closed without an answer.
    Answer answer();

  private:
    struct Stream;
    std::unique_ptr<Stream> stream_;
};

inline Answer get(const RunningMonitor& monitor, const std::string& target, const std::string& method = "GET",
                  const std::string& more = "") {
    Connection connection(monitor);
    connection.send(method + " " + target + " HTTP/1.1\r\nHost: " + monitor.host() + "\r\n" + more + "\r\n");
    return connection.answer();
}

inline nlohmann::json state(const RunningMonitor& monitor) {
    return nlohmann::json::parse(get(monitor, "/api/state").body);
}

} // namespace tandem::monitor::test
