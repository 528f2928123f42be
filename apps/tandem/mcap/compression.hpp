// SPDX-License-Identifier: Apache-2.0
// The compressions of chunks (specification: registry.md, "Compression formats"): lz4, which is its frame format, zstd,
// and none.
#pragma once
#include "apps/tandem/mcap/records.hpp"

#include <memory>

namespace tandem::mcap {

enum class Compression { none, lz4, zstd };

/// As the field `compression` of a chunk says it; "" for none.
const char* compression_name(Compression compression);

/// Compresses chunk after chunk, without an allocation once it has seen the largest. Used by one thread at a time.
class Compressor {
  public:
    explicit Compressor(Compression compression);
    ~Compressor();
    /// The compressed bytes, valid until the next call. Throws Error.
    ByteView compress(ByteView bytes);

  private:
    struct Contexts;
    Compression compression_;
    std::unique_ptr<Contexts> contexts_;
    Bytes out_;
};

/// Appends to `out` what the bytes contain, which must be exactly `size` bytes: memory grows with what comes out, not
/// with what the file claims. Throws Error for damaged bytes, another size, or a compression that is not known.
void decompress(const std::string& compression, ByteView bytes, std::uint64_t size, Bytes& out);

} // namespace tandem::mcap
