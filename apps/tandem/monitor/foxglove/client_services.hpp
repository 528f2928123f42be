// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/control/request_program.hpp"
#include "apps/tandem/monitor/foxglove/client_line.hpp"
#include "apps/tandem/monitor/state.hpp"
#include "proxy/wire/operation.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace tandem::monitor {

/// The operations of service ports on links, as services `/LINK/PORT/OPERATION` of the specification. [one thread]
class ClientServices : public std::enable_shared_from_this<ClientServices> {
  public:
    static constexpr std::size_t max_services = 2000;
    static constexpr int max_calls = 16; ///< open calls of a client

    ClientServices(RequestProgram& program, ClientLine line) : program_(program), line_(std::move(line)) {}

    /// Advertises new services and withdraws those that disappeared.
    void update(const State& state);
    /// Executes a service call request of the specification. `request`: without its op.
    void call(std::string_view request);

  private:
    // NOLINTNEXTLINE(bugprone-exception-escape): moving a nlohmann::json throws nothing
    struct Service {
        std::uint32_t id = 0;
        nlohmann::json target{}; ///< for `tandem rtm requests`
        wire::Operation operation{};
        bool present = true;
    };
    void answer(std::uint32_t service, std::uint32_t call, const std::string& encoding,
                const wire::Operation& operation, const command::Frame& reply);
    void refuse(std::uint32_t service, std::uint32_t call, const std::string& text);

    RequestProgram& program_;
    const ClientLine line_;
    std::map<std::string, Service>
        services_; ///< by name, owner and signature; removed services keep their number
    int open_calls_ = 0;
};

} // namespace tandem::monitor
