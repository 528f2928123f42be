// SPDX-License-Identifier: Apache-2.0
// Segments under a kernel with pages of 16 or 64 KiB (tests/support/large_pages.cpp).
#include "shm/segment/truncation_guard.hpp"
#include "tests/shm/fixture.hpp"
#include "tests/support/large_pages.hpp"

#include <unistd.h>

using namespace tandem::shm;
using namespace tandem::shm::test;
using tandem::test::refused_for_page_size;

TEST_CASE("a process survives the truncation of a segment whatever pages the kernel has") {
    const std::size_t refused = refused_for_page_size();
    Child child([] {
        install_truncation_guard();
        Pair pair;
        const auto blob = pair.first->add_blob("b", 200'000);
        for (std::byte& byte : blob) byte = std::byte{7};
        if (truncate(pair.first->path().c_str(), 4096) != 0) return 2;
        for (std::size_t at = blob.size(); at-- > 0;)
            if (static_cast<volatile std::byte&>(blob[at]) != std::byte{0}) return 1;
        return 0;
    });
    CHECK(child.wait() == 0);
    CHECK(refused_for_page_size() == refused);
}

TEST_CASE("a sparse ring gets its pages before the first payload whatever pages the kernel has") {
    auto options = small();
    options.sparse = true;
    options.chunk_pool_bytes = std::size_t{4} << 20;
    const std::size_t refused = refused_for_page_size();
    Link link;
    const auto first = join(link, Side::first, options);
    options.chunk_pool_bytes = 0;
    const auto second = join(link, Side::second, options);
    // Wherever a ring lies, it begins within a page.
    first->add_blob("b", 5000);
    RingWriter writer(
        first->add_ring("r", {.max_record = 100, .capacity = 4096, .chunk_bytes = 300'000, .chunks = 3}));
    first->publish();
    RingReader reader(*second->find_ring(Side::first, "r"));
    for (const std::size_t bytes : {std::size_t{50}, std::size_t{300'000}}) {
        const std::string text(bytes, 'x');
        REQUIRE(writer.write(std::as_bytes(std::span(text)), 1));
        const auto record = reader.read();
        REQUIRE(record);
        CHECK(record->bytes.size() == bytes);
    }
    CHECK(refused_for_page_size() == refused);
}
