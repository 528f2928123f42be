// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/compression.hpp"

#include <algorithm>
#include <lz4frame.h>
#include <zstd.h>

namespace tandem::mcap {

/// Frees a context of a C library with the library's function.
template <auto release>
struct Release {
    void operator()(auto* context) const { release(context); }
};
template <typename Context, auto release>
using ContextPointer = std::unique_ptr<Context, Release<release>>;

namespace {

constexpr int zstd_level = 1; // the fastest regular level
constexpr std::size_t first_growth = std::size_t{256} * 1024;

LZ4F_preferences_t lz4_preferences(std::size_t size) {
    LZ4F_preferences_t preferences = LZ4F_INIT_PREFERENCES;
    preferences.frameInfo.blockSizeID = LZ4F_max4MB;
    preferences.frameInfo.contentSize = size;
    return preferences;
}

/// Decompresses with `step(room, in)`, which removes the used part of both and returns false for damaged bytes.
/// Enlarges `out` as needed, by at most `size` bytes. A decoder can hold back bytes after its input is used up, so the
/// loop ends with a step without progress.
template <typename Step>
void decompress_in_steps(const std::string& name, std::uint64_t size, ByteView in, Bytes& out, Step step) {
    const std::size_t begin = out.size();
    std::size_t filled = 0;
    for (bool progress = true; progress;) {
        if (out.size() == begin + filled && filled < size)
            out.resize(begin + std::min<std::uint64_t>(size, std::max(first_growth, 2 * filled)));
        std::span<std::byte> room = std::span(out).subspan(begin + filled);
        const std::size_t had_room = room.size(), had_input = in.size();
        if (!step(room, in)) throw Error(name + " data are damaged");
        filled += had_room - room.size();
        progress = room.size() < had_room || in.size() < had_input;
    }
    out.resize(begin + filled);
    if (!in.empty()) throw Error(name + " data are longer than the chunk states, or damaged");
    if (filled < size) throw Error(name + " data are shorter than the chunk states");
}

void decompress_zstd(ByteView in, std::uint64_t size, Bytes& out) {
    const ContextPointer<ZSTD_DStream, ZSTD_freeDStream> stream(ZSTD_createDStream());
    if (!stream) throw std::bad_alloc();
    decompress_in_steps("zstd", size, in, out, [&](std::span<std::byte>& room, ByteView& bytes) {
        ZSTD_outBuffer to{room.data(), room.size(), 0};
        ZSTD_inBuffer from{bytes.data(), bytes.size(), 0};
        const std::size_t state = ZSTD_decompressStream(stream.get(), &to, &from);
        room = room.subspan(to.pos);
        bytes = bytes.subspan(from.pos);
        return !ZSTD_isError(state);
    });
}

void decompress_lz4(ByteView in, std::uint64_t size, Bytes& out) {
    LZ4F_dctx* created = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&created, LZ4F_VERSION))) throw std::bad_alloc();
    const ContextPointer<LZ4F_dctx, LZ4F_freeDecompressionContext> context(created);
    decompress_in_steps("lz4", size, in, out, [&](std::span<std::byte>& room, ByteView& bytes) {
        std::size_t to = room.size(), from = bytes.size();
        const std::size_t state =
            LZ4F_decompress(context.get(), room.data(), &to, bytes.data(), &from, nullptr);
        room = room.subspan(to);
        bytes = bytes.subspan(from);
        return !LZ4F_isError(state);
    });
}

} // namespace

const char* compression_name(Compression compression) {
    switch (compression) {
    case Compression::lz4:
        return "lz4";
    case Compression::zstd:
        return "zstd";
    case Compression::none:
        break;
    }
    return "";
}

struct Compressor::Contexts {
    ContextPointer<ZSTD_CCtx, ZSTD_freeCCtx> zstd;
    ContextPointer<LZ4F_cctx, LZ4F_freeCompressionContext> lz4;
};

Compressor::Compressor(Compression compression)
    : compression_(compression), contexts_(std::make_unique<Contexts>()) {
    if (compression == Compression::zstd) {
        contexts_->zstd.reset(ZSTD_createCCtx());
        if (!contexts_->zstd) throw std::bad_alloc();
    }
    if (compression == Compression::lz4) {
        LZ4F_cctx* created = nullptr;
        if (LZ4F_isError(LZ4F_createCompressionContext(&created, LZ4F_VERSION))) throw std::bad_alloc();
        contexts_->lz4.reset(created);
    }
}

Compressor::~Compressor() = default;

ByteView Compressor::compress(ByteView bytes) {
    if (compression_ == Compression::none) return bytes;
    const auto checked = [](std::size_t result, bool error, const char* text) {
        if (error) throw Error(std::string("a chunk cannot be compressed: ") + text);
        return result;
    };
    if (compression_ == Compression::zstd) {
        out_.resize(std::max(out_.size(), ZSTD_compressBound(bytes.size())));
        const std::size_t size = ZSTD_compressCCtx(contexts_->zstd.get(), out_.data(), out_.size(),
                                                   bytes.data(), bytes.size(), zstd_level);
        return {out_.data(), checked(size, ZSTD_isError(size), ZSTD_getErrorName(size))};
    }
    const auto preferences = lz4_preferences(bytes.size());
    const auto lz4 = [&](std::size_t result) {
        return checked(result, LZ4F_isError(result), LZ4F_getErrorName(result));
    };
    LZ4F_cctx* context = contexts_->lz4.get();
    out_.resize(std::max(out_.size(), LZ4F_compressFrameBound(bytes.size(), &preferences)));
    std::size_t size = lz4(LZ4F_compressBegin(context, out_.data(), out_.size(), &preferences));
    size += lz4(LZ4F_compressUpdate(context, out_.data() + size, out_.size() - size, bytes.data(),
                                    bytes.size(), nullptr));
    size += lz4(LZ4F_compressEnd(context, out_.data() + size, out_.size() - size, nullptr));
    return {out_.data(), size};
}

void decompress(const std::string& compression, ByteView bytes, std::uint64_t size, Bytes& out) {
    if (compression == "zstd") return decompress_zstd(bytes, size, out);
    if (compression == "lz4") return decompress_lz4(bytes, size, out);
    if (!compression.empty())
        throw Error("compression \"" + compression + "\" is unknown: expected lz4, zstd or none");
    if (bytes.size() != size) throw Error("uncompressed data do not have the length that the chunk states");
    out.insert(out.end(), bytes.begin(), bytes.end());
}

} // namespace tandem::mcap
