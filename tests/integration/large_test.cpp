// SPDX-License-Identifier: Apache-2.0
// Pictures of up to 64 MiB, from an OPRoS component to an RTC and back, and pictures of cameras with any `bpp`.
#include "two_hosts.hpp"

#include <catch2/catch.hpp>

namespace {

struct Pictures : TwoHosts {
    Pictures() {
        set_talker("CameraComp");
        set_connections(connection("data", "Talker", "picture", "Adaptor", "picture") +
                        connection("data", "Adaptor", "pictureBack", "Talker", "pictureBack"));
    }
    bool back_whole(std::size_t bytes, std::size_t from = 0) const {
        return says("opros", "picture of " + std::to_string(bytes) + " bytes came back whole", from);
    }
    std::size_t said(const std::string& host, const std::string& text) const {
        const auto all = output(host);
        std::size_t count = 0;
        for (auto at = all.find(text); at != all.npos; at = all.find(text, at + 1)) ++count;
        return count;
    }
};

} // namespace

TEST_CASE("pictures of 100 bytes to 64 MiB go to an RTC and return intact, whichever side sets large_kib") {
    Pictures hosts;
    const bool adaptor_asks = GENERATE(true, false);
    if (adaptor_asks)
        hosts.set_large_kib("65537");
    else
        hosts.set_interceptor("rtc=EchoRtc0&large_kib=65537");
    hosts.start_opros();
    hosts.start_rtm();
    for (const std::size_t bytes : {1 << 20, 6 << 20, 640 * 480 * 3, 100, 64 << 20}) {
        CAPTURE(bytes);
        CHECK(hosts.back_whole(bytes));
    }
    INFO(hosts.output("opros") + hosts.output("rtm"));
    CHECK(hosts.said("opros", "broken") == 0);
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
    CHECK(hosts.said("opros", "error") + hosts.said("rtm", "error") == 0);
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE(
    "without large_kib a picture of 6 MiB passes, and one of 64 MiB is reported once and blocks no other") {
    Pictures hosts;
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "port 'picture': a message of 67108868 bytes is longer than 8388608"));
    const auto from = hosts.output("opros").size();
    CHECK(hosts.back_whole(6 << 20, from));
    CHECK(hosts.says("opros", "came back", hosts.output("opros").size()));
    CHECK(hosts.said("opros", "raise large_kib to 65537 or more") == 1);
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
}

TEST_CASE("a host killed with pictures in transit is replaced, and pictures pass again") {
    Pictures hosts;
    hosts.set_large_kib("65537");
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.back_whole(64 << 20));
    const auto from = hosts.restart_rtm("opros");
    CHECK(hosts.back_whole(6 << 20, from));
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("pictures of 25 cameras with any bpp go to a component that trusts their sizes and return, or are "
          "refused") {
    TwoHosts hosts;
    hosts.set_talker("GalleryComp");
    hosts.set_rtc("GalleryRtc");
    hosts.set_adaptor_property("ring_kib",
                               "8192"); // room for all of them, so none is dropped for a newer one
    hosts.set_interceptor("rtc=GalleryRtc0&ring_kib=8192");
    hosts.set_connections(TwoHosts::connection("data", "Adaptor", "camera", "Talker", "camera") +
                          TwoHosts::connection("data", "Talker", "shown", "Adaptor", "shown"));
    hosts.start_opros();
    hosts.start_rtm();
    // 14 of the 25 are pictures, with each of 8 values of bpp; and the last one.
    constexpr long bytes =
        320 * 240 * 4 + 64 * 48 * (3 + 3 + 4 + 2 + 1 + 2 + 12) + 3 + 64 + 65535 + 33 * 24 * 3;
    CHECK(hosts.says("opros", "GalleryComp: 113 pictures of " + std::to_string(8 * bytes + 2) + " bytes\n"));
    CHECK(hosts.says("rtm", "GalleryRtc: 113 pictures, 0 of other sizes\n"));
    CHECK(hosts.says("opros", "'pixels' has 4608 elements, expected 1, 2, ... for each of "
                              "width x height = 64 x 48"));
    INFO(hosts.output("opros") + hosts.output("rtm"));
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
    CHECK_FALSE(hosts.left_in_shared_memory());
}
