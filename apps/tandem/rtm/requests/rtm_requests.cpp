// SPDX-License-Identifier: Apache-2.0
// `tandem rtm requests`: processes requests from standard input in a loop.
#include "apps/tandem/rtm/requests/frame.hpp"
#include "apps/tandem/rtm/running/conf.hpp"
#include "apps/tandem/rtm/running/context_info.hpp"
#include "apps/tandem/rtm/running/local_managers.hpp"
#include "apps/tandem/rtm/running/rtm_client.hpp"
#include "apps/tandem/rtm/running/running_commands.hpp"
#include "apps/tandem/rtm/stream/untyped_ports.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include "proxy/interceptor/corba/generic_call.hpp"
#include "proxy/interceptor/corba/transcoder.hpp"
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/operation.hpp"
#include "proxy/wire/time.hpp"
#include "proxy/wire/type.hpp"

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <rtm/CorbaPort.h>
#include <rtm/NVUtil.h>
#include <span>
#include <string>
#include <tuple>
#include <unistd.h>

namespace tandem::command {
namespace {

/// Finds components of RTM hosts on this machine by the hosts' pids. Links contain these pids, and several hosts may
/// have components with the same name. [one thread]
class HostComponents {
  public:
    /// `client` must outlive this object.
    explicit HostComponents(const RtmClient& client) : client_(client) {}

    /// Returns the component with this instance name. Throws std::runtime_error with one line.
    RemoteComponent find(std::uint32_t pid, const std::string& instance) {
        return search(pid, [&](const std::string& manager) {
            const std::string address = "rtcloc://" + manager + "/" + instance;
            return RemoteComponent{RTC::resolve_component(client_.orb(), address, {}, client_.timeout_ms()),
                                   address, instance};
        });
    }

    /// Returns the host's end of a link, an InterceptorComp. Throws std::runtime_error with one line.
    RemoteComponent find_interceptor(std::uint32_t pid, const std::string& link) {
        return search(pid, [&](const std::string& address) -> RemoteComponent {
            RTM::Manager_var manager = RTC::resolve_manager(client_.orb(), address, client_.timeout_ms());
            RTC::RTCList_var components = manager->get_components();
            for (CORBA::ULong i = 0; i < components->length(); ++i) {
                RTC::ComponentProfile_var profile = components[i]->get_component_profile();
                if (std::string(profile->type_name) != "InterceptorComp" ||
                    NVUtil::toString(profile->properties, "link") != link)
                    continue;
                const std::string instance(profile->instance_name);
                return {RTC::RTObject::_duplicate(components[i]), "rtcloc://" + address + "/" + instance,
                        instance};
            }
            throw std::runtime_error(fmt::format("process {} has no InterceptorComp of link {}", pid, link));
        });
    }

    const RtmClient& client() const { return client_; }

  private:
    const std::string& manager_of(std::uint32_t pid) {
        if (const auto known = managers_.find(pid); known != managers_.end()) return known->second;
        if (pid == 0)
            throw std::runtime_error("the RTM host runs in another pid namespace (a container), where its "
                                     "manager cannot be found; run tandem there");
        const auto found = find_local_managers(client_.orb(), static_cast<pid_t>(pid));
        if (found.empty())
            throw std::runtime_error(fmt::format("process {} is not an RTM host, or does not answer", pid));
        return managers_[pid] = found.front();
    }

    /// Forgets a manager after an error, because its process may be gone and the pid reused.
    template <class Search>
    RemoteComponent search(std::uint32_t pid, Search search) {
        try {
            return search(manager_of(pid));
        } catch (const std::runtime_error&) {
            managers_.erase(pid);
            throw;
        } catch (const CORBA::Exception& e) {
            managers_.erase(pid);
            throw_corba_error(fmt::format("the RTM host of process {}", pid), e);
        }
    }

    const RtmClient& client_;
    std::map<std::uint32_t, std::string> managers_; ///< HOST:PORT by pid
};

/// Encodes a message like RTC::write(). Throws std::runtime_error if the bytes are not a message of the type.
RTC::ByteData encode_message(const wire::Type& message, const std::string& bytes, bool add_time) {
    cdrMemoryStream stream;
    if (add_time) { // 8 bytes, which keep the alignment
        const std::uint64_t now = wire::wall_clock_stamp();
        wire::stamp_seconds(now) >>= stream;
        wire::stamp_nanoseconds(now) >>= stream;
    }
    wire::CdrReader reader(std::as_bytes(std::span(bytes)));
    try {
        interceptor::from_cdr(message, reader, stream);
    } catch (const CORBA::SystemException&) {
        reader.fail();
    }
    // CDR writers may pad the end of a message.
    if (!reader.ok() || reader.remaining() >= 8)
        throw std::runtime_error(fmt::format("the message of {} bytes is not a valid {}", bytes.size(),
                                             wire::to_named_signature(message)));
    RTC::ByteData data;
    data.writeData(static_cast<unsigned char*>(stream.bufPtr()), stream.bufSize());
    data.isLittleEndian(true);
    return data;
}

/// OutPorts of this program. Each is connected to an InPort of an RTM host while a client publishes there. [one thread]
class Publishers {
  public:
    explicit Publishers(HostComponents& components) : components_(components) {}

    /// Connects to an InPort. `publisher`: its number; `pid`, `link`; `component`: empty for the end of the link;
    /// `port`; `type`: empty if unknown to the link; `signature`; `add_time`. Throws std::runtime_error with one line,
    /// even if the type differs.
    void open(const nlohmann::json& request) {
        const auto pid = request.at("pid").get<std::uint32_t>();
        const auto link = request.at("link").get<std::string>(), port = request.at("port").get<std::string>();
        const auto component = request.at("component").get<std::string>();
        const auto type = request.at("type").get<std::string>();
        const bool mirror = component.empty();
        RemotePort receiver = get_port(
            mirror ? components_.find_interceptor(pid, link) : components_.find(pid, component), port);
        const std::string actual = require_data_type(receiver, "DataInPort");
        if (!type.empty() && actual != type)
            throw std::runtime_error(fmt::format("{} carries {}, not {}", receiver.name, actual, type));
        // "flush" reports the result of each send().
        std::vector<std::string> properties{"interface_type=corba_cdr", "dataflow_type=push",
                                            "subscription_type=flush", "serializer.cdr.endian=little"};
        // The buffer at the link's own end is the ring. The host writes there, in turn with its other writers.
        if (mirror)
            for (const auto& property : {std::string("inport.buffer_type=tandem_link"),
                                         "inport.buffer.channel=" + link + "/" + port})
                properties.push_back(property);
        auto publisher = std::unique_ptr<Publisher>(new Publisher{
            std::move(receiver), wire::parse_signature(request.at("signature").get<std::string>()),
            UntypedOutPort("publish", actual.c_str()), request.at("add_time").get<bool>(), nullptr});
        publisher->connection = std::make_unique<PortConnection>(publisher->receiver, publisher->port,
                                                                 properties, "tandem-monitor");
        publishers_[request.at("publisher").get<int>()] = std::move(publisher);
    }

    /// Sends a message (CDR without encapsulation) and waits until the InPort has accepted it. Throws
    /// std::runtime_error with one line if the bytes are not a message of the type, or if it is not accepted.
    void send(const Frame& request) {
        const auto found = publishers_.find(request.head.at("publisher").get<int>());
        if (found == publishers_.end()) return; // opening it has failed, and this was reported
        Publisher& publisher = *found->second;
        const auto message = encode_message(publisher.message, request.bytes, publisher.add_time);
        try {
            publisher.port.send(message, publisher.receiver.name);
        } catch (const ConnectionLost& error) { // reported once; further messages are ignored
            publishers_.erase(found);
            throw std::runtime_error(std::string(error.what()) + ": advertise it again");
        }
    }

    void close(const nlohmann::json& request) { publishers_.erase(request.at("publisher").get<int>()); }

  private:
    struct Publisher {
        RemotePort receiver;
        wire::Type message;
        UntypedOutPort port;
        bool add_time; ///< prepend a time to each message, because an OPRoS port has none
        std::unique_ptr<PortConnection> connection; ///< last, so that it ends first
    };

    HostComponents& components_;
    std::map<int, std::unique_ptr<Publisher>> publishers_;
};

/// Limit for open connections. When it is exceeded, all are closed and made again as needed.
constexpr std::size_t max_consumers = 64;

/// Returns the interface that the port provides, with this instance name if given. Throws std::runtime_error.
RTC::PortInterfaceProfile provided_interface(const RemotePort& port, const std::string& instance) {
    const auto& interfaces = port.profile->interfaces;
    for (CORBA::ULong i = 0; i < interfaces.length(); ++i)
        if (interfaces[i].polarity == RTC::PROVIDED &&
            (instance.empty() || instance == static_cast<const char*>(interfaces[i].instance_name)))
            return interfaces[i];
    throw std::runtime_error(fmt::format("{} provides no interface {}", port.name, instance));
}

/// This program's port, and the provider's object reference from the connection.
struct Consumer {
    explicit Consumer(RemotePort of, const std::string& instance) : remote(std::move(of)), port("calls") {
        const auto interface = provided_interface(remote, instance);
        port.registerConsumer(interface.instance_name, interface.type_name, provider);
        connection =
            std::make_unique<PortConnection>(remote, port, std::vector<std::string>{}, "tandem-monitor");
    }

    RemotePort remote;
    RTC::CorbaConsumerBase provider;
    RTC::CorbaPort port;
    std::unique_ptr<PortConnection> connection;
};

/// Calls operations of provided service ports through a port of this program, which stays connected to each. [one
/// thread]
class ServiceCalls {
  public:
    explicit ServiceCalls(HostComponents& components) : components_(components) {}
    ServiceCalls(const ServiceCalls&) = delete;
    ServiceCalls& operator=(const ServiceCalls&) = delete;

    /// Calls an operation: `pid`, `link`; `component`: empty for the end of the link; `port`, `instance`, `operation`,
    /// `signature`, and the request's message as bytes. Returns the reply's message. Throws std::runtime_error with one
    /// line.
    std::string call(const Frame& request) {
        const auto text = [&](const char* name) { return request.head.at(name).get<std::string>(); };
        const Key key(request.head.at("pid").get<std::uint32_t>(), text("link"), text("component"),
                      text("port"), text("instance"));
        const auto operation = wire::parse_operation(text("signature"));
        Consumer& consumer = connect(key);
        wire::MessageBuffer memory;
        std::optional<interceptor::GenericCallFailure> failure;
        const auto results = interceptor::generic_call(
            consumer.provider.getObject(), text("operation"), operation,
            std::as_bytes(std::span(request.bytes)),
            std::chrono::milliseconds(components_.client().timeout_ms()), memory, failure);
        if (results) return {reinterpret_cast<const char*>(results->data()), results->size()};
        if (failure->status == interceptor::GenericCallFailure::Status::unreachable)
            consumers_.erase(key); // its host is gone; the next call reconnects
        throw std::runtime_error(failure->text);
    }

  private:
    using Key = std::tuple<std::uint32_t, std::string, std::string, std::string, std::string>;

    Consumer& connect(const Key& key) {
        if (const auto known = consumers_.find(key); known != consumers_.end()) return *known->second;
        if (consumers_.size() >= max_consumers) consumers_.clear();
        const auto& [pid, link, component, port, instance] = key;
        RemotePort remote = get_port(component.empty() ? components_.find_interceptor(pid, link)
                                                       : components_.find(pid, component),
                                     port);
        return *(consumers_[key] = std::make_unique<Consumer>(std::move(remote), instance));
    }

    HostComponents& components_;
    std::map<Key, std::unique_ptr<Consumer>> consumers_;
};

nlohmann::json active_values(const RemoteComponent& component) {
    SDOPackage::Configuration_var configuration = component.object->get_configuration();
    for (const auto& set : sets_json(configuration.in()))
        if (set["active"].get<bool>()) return set["values"];
    return nlohmann::json::object();
}

/// Returns the values of the active configuration sets. `components`: a list of {pid, component}. Returns {values: a
/// list of {pid, component, values: {NAME: TEXT}}, errors: [one line each]}. A component that does not answer does not
/// affect the others.
nlohmann::json read_parameters(HostComponents& components, const nlohmann::json& request) {
    nlohmann::json reply{{"values", nlohmann::json::array()}, {"errors", nlohmann::json::array()}};
    for (const auto& wanted : request.at("components")) {
        try {
            const RemoteComponent component = components.find(wanted.at("pid").get<std::uint32_t>(),
                                                              wanted.at("component").get<std::string>());
            call_configuration(component, [&] {
                nlohmann::json entry = wanted;
                entry["values"] = active_values(component);
                reply["values"].push_back(entry);
            });
        } catch (const std::runtime_error& error) {
            reply["errors"].push_back(error.what());
        }
    }
    return reply;
}

/// Sets `values` {NAME: TEXT} of `component` in the host `pid` like `tandem rtm conf`. Throws std::runtime_error with
/// one line.
void set_parameters(HostComponents& components, const nlohmann::json& request) {
    const RemoteComponent component =
        components.find(request.at("pid").get<std::uint32_t>(), request.at("component").get<std::string>());
    ConfOptions options;
    for (const auto& [name, value] : request.at("values").items())
        options.values.push_back(name + "=" + value.get<std::string>());
    call_configuration(component, [&] {
        SDOPackage::Configuration_var configuration = component.object->get_configuration();
        change_configuration(configuration.in(), options, is_in_tandem_host(component.object.in()));
    });
}

/// Dispatches requests.
class RequestServer {
  public:
    explicit RequestServer(const RtmClient& client)
        : components_(client), publishers_(components_), calls_(components_) {}

    /// Answers a request with an `id` by `id`, `ok` and `text`. Answers a request without an `id` only if it fails.
    std::optional<Frame> handle(const Frame& request) {
        Frame reply{{{"op", request.head.value("op", "")}, {"ok", true}, {"text", ""}}};
        for (const char* name : {"id", "publisher"})
            if (request.head.contains(name)) reply.head[name] = request.head[name];
        try {
            carry_out(request, reply);
        } catch (const std::exception& error) {
            reply.head["ok"] = false;
            reply.head["text"] = error.what();
        } catch (const CORBA::Exception& error) { // not a std::exception
            reply.head["ok"] = false;
            reply.head["text"] = std::string("CORBA exception ") + error._name();
        }
        if (!request.head.contains("id") && reply.head["ok"].get<bool>()) return std::nullopt;
        return reply;
    }

  private:
    void carry_out(const Frame& request, Frame& reply) {
        const auto op = request.head.at("op").get<std::string>();
        if (op == "send") return publishers_.send(request);
        if (op == "open") return publishers_.open(request.head);
        if (op == "close") return publishers_.close(request.head);
        if (op == "read") return reply.head.update(read_parameters(components_, request.head));
        if (op == "set") return set_parameters(components_, request.head);
        if (op == "call") {
            reply.bytes = calls_.call(request);
            return;
        }
        throw std::runtime_error("unknown request: " + op);
    }

    HostComponents components_;
    Publishers publishers_;
    ServiceCalls calls_;
};

void write_all(const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
        const auto written = ::write(STDOUT_FILENO, text.data() + done, text.size() - done);
        if (written < 0 && errno != EINTR) throw std::runtime_error("the monitor has ended");
        if (written > 0) done += static_cast<std::size_t>(written);
    }
}

} // namespace

int rtm_requests(const RtmClientOptions& options) {
    RtmClientOptions no_search = options;
    no_search.name_servers = {"localhost"}; // unused, because components are found by their hosts' pids
    const RtmClient client(no_search, true);
    RequestServer server(client);
    std::string received;
    char bytes[65536];
    while (true) {
        while (const auto request = take_frame(received))
            if (const auto reply = server.handle(*request)) write_all(encode(*reply));
        const auto count = ::read(STDIN_FILENO, bytes, sizeof bytes);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return 0;
        received.append(bytes, static_cast<std::size_t>(count));
    }
}

} // namespace tandem::command
