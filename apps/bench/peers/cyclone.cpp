// SPDX-License-Identifier: Apache-2.0
// Cyclone DDS (one of ROS 2's middlewares): reliable, keep-all topics over UDP on the loopback, taken by polling
// or by wait set.
#include "apps/bench/peers/peer_cases.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include <dds/dds.h>

#include "cyclone.h"

namespace tandem::bench {

namespace {

// Loopback only and no multicast, so that nothing leaves the machine. Discovery by unicast to the same
// address. The largest datagrams that UDP carries, so that 6 MiB need fewer fragments.
constexpr const char* configuration =
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name='lo'/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast><MaxMessageSize>65500B</MaxMessageSize></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex><Peers><Peer "
    "address='127.0.0.1'/></Peers></Discovery>"
    "<Tracing><Verbosity>severe</Verbosity><OutputFile>stderr</OutputFile></Tracing></Domain></CycloneDDS>";

// idlc generates a C type and a descriptor for each message size: DDS types have fixed arrays.
template <class T>
const dds_topic_descriptor_t& descriptor();
template <>
const dds_topic_descriptor_t& descriptor<TandemBench_Small>() {
    return TandemBench_Small_desc;
}
template <>
const dds_topic_descriptor_t& descriptor<TandemBench_Mebibyte>() {
    return TandemBench_Mebibyte_desc;
}
template <>
const dds_topic_descriptor_t& descriptor<TandemBench_SixMebibytes>() {
    return TandemBench_SixMebibytes_desc;
}

/// Returns the result. Throws std::runtime_error if it is an error code.
dds_entity_t entity_or_throw(dds_return_t result, const char* operation) {
    if (result < 0)
        throw std::runtime_error(fmt::format("Cyclone DDS: {}: {}", operation, dds_strretcode(result)));
    return result;
}

/// A participant with a writer of one topic and a reader of the other.
template <class T, Wake wake>
class CycloneEndpoint {
  public:
    explicit CycloneEndpoint(Session& session) : message_(std::make_unique<T>()) {
        // Read when the first participant is created.
        setenv("CYCLONEDDS_URI", configuration, 1);
        participant_ =
            entity_or_throw(dds_create_participant(DDS_DOMAIN_DEFAULT, nullptr, nullptr), "participant");
        dds_qos_t* qos = dds_create_qos();
        dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(10));
        dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
        // Bounded, so that the writer blocks instead of filling the memory when the reader is behind.
        const int depth = sizeof(T) <= 4096 ? 256 : 4;
        dds_qset_resource_limits(qos, depth, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
        const auto topic = [&](const char* end) {
            return entity_or_throw(dds_create_topic(participant_, &descriptor<T>(),
                                                    topic_name(session, end).c_str(), qos, nullptr),
                                   "topic");
        };
        writer_ = entity_or_throw(
            dds_create_writer(participant_, topic(session.is_side_a() ? "_0" : "_1"), qos, nullptr),
            "writer");
        reader_ = entity_or_throw(
            dds_create_reader(participant_, topic(session.is_side_a() ? "_1" : "_0"), qos, nullptr),
            "reader");
        dds_delete_qos(qos);
        if constexpr (wake == Wake::blocking) {
            wait_set_ = entity_or_throw(dds_create_waitset(participant_), "wait set");
            entity_or_throw(dds_set_status_mask(reader_, DDS_DATA_AVAILABLE_STATUS), "status mask");
            entity_or_throw(dds_waitset_attach(wait_set_, reader_, 0), "wait set");
        }
        wait_for_match();
    }
    ~CycloneEndpoint() { dds_delete(participant_); }
    CycloneEndpoint(const CycloneEndpoint&) = delete;
    CycloneEndpoint& operator=(const CycloneEndpoint&) = delete;

    // dds_write() serializes the sample; a reliable writer blocks while its history is full.
    void send(std::uint64_t sequence) {
        fill_message(message_->words, sizeof(T), sequence);
        entity_or_throw(dds_write(writer_, message_.get()), "write");
    }
    // Takes one sample at a time, without a copy out of the reader's cache.
    std::uint64_t receive() {
        for (;;) {
            void* sample = nullptr; // lent by the reader
            dds_sample_info_t info{};
            if (entity_or_throw(dds_take(reader_, &sample, &info, 1, 1), "take") > 0) {
                const bool valid = info.valid_data; // false: a change of state without data, as at the end
                const std::uint64_t sequence =
                    valid ? checked_sequence(static_cast<const T*>(sample)->words, sizeof(T)) : 0;
                entity_or_throw(dds_return_loan(reader_, &sample, 1), "return loan");
                if (valid) return sequence;
            } else if constexpr (wake == Wake::blocking) {
                entity_or_throw(dds_waitset_wait(wait_set_, nullptr, 0, DDS_SECS(1)), "wait");
            }
        }
    }

  private:
    /// Topic names may contain no hyphen.
    static std::string topic_name(const Session& session, const char* end) {
        std::string name = session.name() + end;
        for (char& c : name)
            if (c == '-') c = '_';
        return name;
    }
    /// Otherwise a message written before the peer is discovered would be kept for the peer and count as
    /// late.
    void wait_for_match() const {
        dds_publication_matched_status_t readers{};
        dds_subscription_matched_status_t writers{};
        while (readers.current_count == 0 || writers.current_count == 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            entity_or_throw(dds_get_publication_matched_status(writer_, &readers), "status");
            entity_or_throw(dds_get_subscription_matched_status(reader_, &writers), "status");
        }
    }

    std::unique_ptr<T> message_;
    dds_entity_t participant_ = 0, writer_ = 0, reader_ = 0, wait_set_ = 0;
};

template <Wake wake>
using Small = CycloneEndpoint<TandemBench_Small, wake>;

} // namespace

void add_cyclone_cases(Registry& registry) {
    PeerCases cases(registry, "cyclone-dds");
    cases.add_one_way<Small<Wake::spin>>(Wake::spin);
    cases.add_one_way<Small<Wake::blocking>>(Wake::blocking);
    cases.add_call<PairClientOf<Small<Wake::blocking>>, PairServerOf<Small<Wake::blocking>>>(Wake::blocking,
                                                                                             "pair");
    cases.add_small_stream<Small<Wake::blocking>>(Wake::blocking);
    cases.add_large_stream<CycloneEndpoint<TandemBench_Mebibyte, Wake::blocking>>(mebibyte, Wake::blocking,
                                                                                  "copy");
    cases.add_large_stream<CycloneEndpoint<TandemBench_SixMebibytes, Wake::blocking>>(6 * mebibyte,
                                                                                      Wake::blocking, "copy");
}

} // namespace tandem::bench
