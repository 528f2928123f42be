// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/control/control.hpp"

#include "apps/tandem/monitor/control/host_logs.hpp"
#include "apps/tandem/monitor/control/output_text.hpp"
#include "apps/tandem/monitor/control/recordings.hpp"
#include "host/text/printable.hpp"
#include "shm/segment/segment_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <set>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <system_error>
#include <unistd.h>

namespace tandem::monitor {
namespace {

constexpr std::chrono::milliseconds look_pause{20};

using PlainJson = nlohmann::json;

constexpr std::size_t max_arguments = 16, max_components = 100, max_argument = 300;
constexpr std::size_t max_replay_end = 2048; ///< in bytes, because each state contains it

std::string random_token() {
    std::array<unsigned char, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
        throw std::runtime_error(fmt::format("cannot create a token: {}", std::strerror(errno)));
    std::string text;
    for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
    return text;
}

/// Returns texts for a command line. Throws std::invalid_argument if a text could be an option or is too long. `what`: what
/// the texts are, in the plural, for its message.
std::vector<std::string> arguments_in(const PlainJson& list, const char* what = "arguments",
                                      std::size_t most = max_arguments) {
    std::vector<std::string> arguments;
    if (!list.is_array() || list.empty())
        throw std::invalid_argument(fmt::format("the request names no {}: name 1 to {}", what, most));
    if (list.size() > most)
        throw std::invalid_argument(
            fmt::format("the request names {} {}, but at most {} are allowed: name fewer, and the others in "
                        "a further request",
                        list.size(), what, most));
    for (const PlainJson& item : list) {
        const auto text = item.get<std::string>();
        if (text.empty() || text.size() > max_argument || text.front() == '-' ||
            text::printable_line(text) != text)
            throw std::invalid_argument(fmt::format(
                "'{}' among the {} is not valid: expected 1 to {} bytes, without control characters, that "
                "do not begin with -",
                text::printable_line(text.substr(0, 40)), what, max_argument));
        arguments.push_back(text);
    }
    return arguments;
}

/// Appends the arguments of a sub-command: `arguments`, and if it has them, `properties` of a connection (KEY=VALUE) or the
/// configuration set to change or to activate.
void add_arguments(const PlainJson& request, const std::string& name, std::vector<std::string>& command) {
    for (const auto& argument : arguments_in(request.at("arguments"))) command.push_back(argument);
    if (name == "connect" && request.contains("properties"))
        for (const auto& property : arguments_in(request["properties"]))
            command.insert(command.end(), {"-p", property});
    if (name == "disconnect" && request.contains("connection"))
        command.insert(command.end(),
                       {"--id", arguments_in(PlainJson::array({request["connection"]})).front()});
    for (const char* const option : {"set", "activate"})
        if (name == "conf" && request.contains(option))
            command.insert(command.end(), {std::string("--") + option,
                                           arguments_in(PlainJson::array({request[option]})).front()});
}

/// Returns the socket for stick positions, as published by the port `chair` of that link; empty if there is none.
std::string stick_socket_of(const State& state, const std::string& link_name) {
    for (const LinkState& link : state.links)
        if (link.name == link_name)
            for (const PortState& port : link.ports)
                if (port.name == "chair" && port.value.is_object() && port.value.contains("drive") &&
                    port.value["drive"].is_string())
                    return port.value["drive"].get<std::string>();
    return {};
}

/// Returns the links that a request names; without `links`, all that the monitor shows and can read.
std::vector<std::string> links_to_record(const PlainJson& request, const State& state) {
    if (request.contains("links")) return arguments_in(request["links"], "links");
    std::vector<std::string> links;
    for (const LinkState& link : state.links)
        if (link.readable) links.push_back(link.name);
    if (links.empty()) throw std::invalid_argument("there is no link to record: start the hosts of a link");
    return links;
}

/// Returns the last line that a program has written; empty if there is none.
std::string last_line(int output) {
    std::string lines = last_lines(output, max_replay_end);
    while (!lines.empty() && lines.back() == '\n') lines.pop_back();
    return lines.substr(lines.rfind('\n') + 1);
}

/// Repeats the members by which a client recognizes the request, whatever their types.
PlainJson answer(const PlainJson& request, bool ok, const std::string& text) {
    return {{"op", request.value("op", PlainJson(""))},
            {"ok", ok},
            {"text", text},
            {"id", request.value("id", PlainJson())}};
}

} // namespace

void Programs::run(const std::vector<std::string>& command, Done done) {
    if (jobs_.size() >= max_running) return done(false, "eight commands are already running; try again");
    process::FileDescriptor output(memfd_create("tandem-command", MFD_CLOEXEC));
    process::ChildOptions options;
    options.output = options.errors = output.get();
    try {
        jobs_.push_back({process::ChildProcess(command, options), std::move(output),
                         std::chrono::steady_clock::now() + max_time, std::move(done)});
    } catch (const std::system_error& error) {
        return done(false, error.what());
    }
    if (jobs_.size() == 1) look();
}

void Programs::look() {
    for (auto job = jobs_.begin(); job != jobs_.end();) {
        const bool late = std::chrono::steady_clock::now() > job->end;
        if (late) job->child.kill();
        const auto ended = job->child.poll();
        if (!ended && !late) {
            ++job;
            continue;
        }
        const std::size_t size = size_of(job->output.get());
        const bool cut = size > max_output;
        const std::string output = text_in(job->output.get(), std::min(max_output, size)) +
                                   (late ? "stopped: it took more than 15 s\n" : "") +
                                   (cut ? "\ncut: the output has more than 4 MiB\n" : "");
        const Done done = std::move(job->done);
        job = jobs_.erase(job);
        done(ended && ended->success() && !cut, output);
    }
    if (jobs_.empty()) return;
    timer_.expires_after(look_pause);
    timer_.async_wait([this](const boost::system::error_code& aborted) {
        if (!aborted) look();
    });
}

Control::Control(boost::asio::io_context& context, std::function<const State&()> state,
                 const std::string& systems)
    : state_(std::move(state)), token_(random_token()),
      program_(std::filesystem::read_symlink("/proc/self/exe").string()), programs_(context),
      publishing_(context, program_, "2"), calling_(context, program_, "5"),
      stick_socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    if (!systems.empty()) systems_.emplace(systems, program_);
}

Control::~Control() {
    // Asked before any is waited for. ~Systems(), which is next, asks its runs in the same way.
    if (player_) player_->stop();
    if (recorder_) recorder_->stop();
}

bool Control::is_token(std::string_view text) const {
    unsigned char different = text.size() == token_.size() ? 0 : 1;
    for (std::size_t i = 0; i < token_.size(); ++i)
        different |= static_cast<unsigned char>(token_[i] ^ (i < text.size() ? text[i] : '\0'));
    return different == 0;
}

std::string Control::recording() { return recorder_ && !recorder_->look() ? recorded_file_ : std::string(); }

nlohmann::ordered_json Control::status() {
    const std::string file = recording();
    nlohmann::ordered_json status{{"allowed", true},
                                  {"recording", file},
                                  {"recording_since_ms", file.empty() ? 0 : recorder_->since_ms()},
                                  {"replay", nullptr},
                                  {"systems", nullptr}};
    if (player_) {
        const bool running = !player_->look();
        status["replay"] = {{"file", replayed_file_},
                            {"running", running},
                            {"since_ms", player_->since_ms()},
                            {"end", running ? "" : last_lines(player_output_.get(), max_replay_end)}};
    }
    if (systems_) status["systems"] = systems_->runs();
    return status;
}

std::string Control::recording_failure() {
    if (!recorder_ || !recorder_->look() || recorder_->look()->success()) return "";
    const std::string line = last_line(recorder_output_.get());
    return fmt::format("recording to {}: tandem record {}{}{}", recorded_file_, recorder_->look()->text(),
                       line.empty() ? "" : ": ", line);
}

void Control::handle(const std::string& text, const Reply& reply) {
    const PlainJson request = PlainJson::parse(text, nullptr, false);
    if (!request.is_object()) return reply({{"op", ""}, {"ok", false}, {"text", "expected a JSON object"}});
    try {
        const auto op = request.value("op", std::string());
        if (op == "drive") return drive(request, reply);
        if (op == "rtm" || op == "opros") return run_tool(request, reply);
        if (op == "record") return record(request, reply);
        if (op == "replay") return replay(request, reply);
        if (op == "system") return change_systems(request, reply);
        if (op == "recordings" || op == "log") return report(request, op, reply);
        reply(answer(request, false,
                     "expected op drive, rtm, opros, record, recordings, replay, system or log"));
    } catch (const PlainJson::exception& error) {
        reply(answer(request, false,
                     fmt::format("a member of the request is missing or of another type: {}; "
                                 "docs/monitoring.md describes the requests",
                                 error.what())));
    } catch (const std::exception& error) {
        reply(answer(request, false, error.what()));
    }
}

void Control::drive(const PlainJson& request, const Reply& reply) {
    const std::string path = stick_socket_of(state_(), request.at("link").get<std::string>());
    if (path.empty()) return reply(answer(request, false, "expected a link of wheelchair --drive"));
    const double command[] = {request.at("x").get<double>(), request.at("y").get<double>(),
                              request.value("stop", false) ? 1.0 : 0.0};
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    const bool sent = sendto(stick_socket_.get(), command, sizeof command, 0,
                             reinterpret_cast<const sockaddr*>(&address), sizeof address) >= 0;
    if (!sent) return reply(answer(request, false, fmt::format("{}: {}", path, std::strerror(errno))));
    if (request.contains("id")) reply(answer(request, true, "sent"));
}

/// Runs a sub-command of `tandem rtm` or `tandem opros`. None of them may load code: `tandem opros info` is left out, because
/// it runs the library that its argument names.
void Control::run_tool(const PlainJson& request, const Reply& reply) {
    static const std::map<std::string, std::set<std::string>> allowed{
        {"rtm", {"list", "tree", "info", "activate", "deactivate", "reset", "connect", "disconnect", "conf"}},
        {"opros", {"list", "start", "stop", "recover", "conf"}}};
    const auto tool = request.at("op").get<std::string>(), name = request.at("command").get<std::string>();
    if (allowed.at(tool).count(name) == 0) return reply(answer(request, false, "unknown command: " + name));
    std::vector<std::string> command{program_, tool, name};
    if (name != "list" && name != "tree") add_arguments(request, name, command);
    if (request.value("json", false)) command.emplace_back("--json");
    run(command, request, reply);
}

void Control::run(const std::vector<std::string>& command, const PlainJson& request, const Reply& reply) {
    const PlainJson asked{{"op", request.value("op", PlainJson(""))},
                          {"id", request.value("id", PlainJson())}};
    programs_.run(command, [reply, asked](bool success, const std::string& output) {
        reply(answer(asked, success, output));
    });
}

/// A run's answer says only that it has begun: status() has its state.
void Control::change_systems(const PlainJson& request, const Reply& reply) {
    if (!systems_)
        return reply(
            answer(request, false,
                   "there is no folder for systems; start tandem monitor with --control --systems DIR"));
    const auto command = request.value("command", std::string());
    if (command == "list") return run(systems_->list_command(), request, reply);
    const auto name = request.at("name").get<std::string>();
    if (command == "new")
        return run(
            systems_->new_command(name, arguments_in(request.at("components"), "components", max_components)),
            request, reply);
    if (command == "save") {
        std::vector<std::string> hosts;
        for (const PlainJson& pid : request.at("hosts")) hosts.push_back(std::to_string(pid.get<unsigned>()));
        return run(systems_->save_command(name, hosts, request.value("replace", false)), request, reply);
    }
    if (command == "log") return reply(answer(request, true, systems_->log(name)));
    if (command != "start" && command != "stop")
        return reply(answer(request, false, "expected command list, new, save, start, stop or log"));
    if (command == "start")
        systems_->start(name);
    else
        systems_->stop(name);
    reply(answer(request, true, ""));
}

/// Runs `tandem replay` with a recording of this folder, in place of a host. status() has its state.
void Control::replay(const PlainJson& request, const Reply& reply) {
    const bool running = player_ && !player_->look();
    if (!request.value("on", false)) {
        if (player_) player_->stop();
        return reply(answer(request, true, ""));
    }
    if (running) return reply(answer(request, false, "already replaying " + replayed_file_));
    const auto name = request.at("file").get<std::string>();
    const auto file = find_recording(std::filesystem::current_path(), name);
    if (!file) return reply(answer(request, false, "there is no recording of this name; list them"));
    std::vector<std::string> command{program_, "replay", file->string()};
    for (const auto& [member, option] : {std::pair("in_place_of", "--in-place-of"), {"link", "--link"}})
        if (request.contains(member))
            command.insert(command.end(),
                           {option, arguments_in(PlainJson::array({request[member]})).front()});
    player_output_ = process::FileDescriptor(memfd_create("tandem-replay", MFD_CLOEXEC));
    player_.reset();
    player_.emplace(command, player_output_.get());
    replayed_file_ = name;
    reply(answer(request, true, ""));
}

void Control::report(const PlainJson& request, const std::string& op, const Reply& reply) const {
    PlainJson result = answer(request, true, "");
    result[op] = op == "log" ? read_host_logs(state_(), request.value("from", PlainJson::object()))
                             : list_recordings(std::filesystem::current_path());
    reply(result);
}

void Control::record(const PlainJson& request, const Reply& reply) {
    if (!request.value("on", false)) {
        if (recorder_) recorder_->stop(); // it writes the rest, and recording() detects its end
        return reply(answer(request, true, recorded_file_));
    }
    if (!recording().empty()) return reply(answer(request, false, "already recording to " + recorded_file_));
    std::vector<std::string> command{program_, "record"};
    for (const auto& link : links_to_record(request, state_())) {
        // tandem record would wait for it, without a page that says so.
        if (shm::list_generations(link).empty())
            return reply(
                answer(request, false,
                       fmt::format("link '{}' does not exist; tandem shm list shows existing links", link)));
        command.push_back(link);
    }
    recorded_file_ = (std::filesystem::current_path() / new_recording_name()).string();
    command.insert(command.end(), {"-o", recorded_file_});
    recorder_output_ = process::FileDescriptor(memfd_create("tandem-record", MFD_CLOEXEC));
    recorder_.reset();
    recorder_.emplace(command, recorder_output_.get());
    reply(answer(request, true, recorded_file_));
}

} // namespace tandem::monitor
