// SPDX-License-Identifier: Apache-2.0
// The compressions of chunks (specification: registry.md, "Compression formats"): lz4 (LZ4 frame format), zstd, and
// none.
#pragma once
#include "apps/tandem/mcap/records.hpp"

#include <memory>

namespace tandem::mcap {

enum class Compression { none, lz4, zstd };

/// Returns the content of a chunk's field `compression`; "" for none.
const char* compression_name(Compression compression);

/// Compresses chunks. Allocates memory only for a chunk that is larger than all earlier ones. [one thread at a time]
class Compressor {
  public:
    explicit Compressor(Compression compression);
    ~Compressor();
    /// Returns the compressed bytes. They are valid until the next call. Throws Error.
    ByteView compress(ByteView bytes);

  private:
    struct Contexts;
    Compression compression_;
    std::unique_ptr<Contexts> contexts_;
    Bytes out_;
};

/// Decompresses exactly `size` bytes and appends them to `out`. Memory grows with the actual output, not with the
/// claimed size. Throws Error for damaged bytes, another size, or an unknown compression.
void decompress(const std::string& compression, ByteView bytes, std::uint64_t size, Bytes& out);

} // namespace tandem::mcap
