// SPDX-License-Identifier: Apache-2.0
// An image on a data port. Its copies share the pixels, also between components.
#ifndef DEVICE_RAWIMAGE_H_
#define DEVICE_RAWIMAGE_H_

#include <archive/opros_archive_smart_ptr.h>
#include <opros_smart_ptr.h>

#include <cstring>
#include <string>
#include <vector>

/// The pixels: `height` rows of `width` pixels of `pixelByte` bytes.
class RawImageData {
  public:
    RawImageData() : m_width(0), m_height(0), m_pixelByte(0) {}
    RawImageData(int width, int height, int pixelByte) { resize(width, height, pixelByte); }
    RawImageData(unsigned char* data, int width, int height, int pixelByte) {
        reset(data, width, height, pixelByte);
    }
    virtual ~RawImageData() {}

    void resize(int width, int height, int pixelByte) {
        m_width = width;
        m_height = height;
        m_pixelByte = pixelByte;
        m_data.resize(static_cast<std::size_t>(width) * height * pixelByte);
    }
    void reset(unsigned char* data, int width, int height, int pixelByte) {
        resize(width, height, pixelByte);
        if (!m_data.empty()) std::memcpy(&m_data[0], data, m_data.size());
    }
    void reset(RawImageData& other) { *this = other; }
    /// Returns NULL if there are no pixels.
    unsigned char* getData() { return m_data.empty() ? 0 : &m_data[0]; }
    unsigned long getSize() { return m_data.size(); }
    int getWidth() { return m_width; }
    int getHeight() { return m_height; }
    int getPixelByte() { return m_pixelByte; }

  private:
    std::vector<unsigned char> m_data;
    int m_width, m_height, m_pixelByte;
};

inline std::string typeName(RawImageData*) { return "RawImageData"; }

// The members and their order are those of RawImage.h in components of v1.1, so that both read each other's bytes.
inline void save_this(opros::archive::oarchive& ar, RawImageData& image) {
    std::string raw("raw");
    int width = image.getWidth(), height = image.getHeight(), pixelByte = image.getPixelByte();
    unsigned long size = image.getSize();
    ar << OPROS_SERIALIZATION_NVP(raw) << OPROS_SERIALIZATION_NVP(width) << OPROS_SERIALIZATION_NVP(height)
       << OPROS_SERIALIZATION_NVP(pixelByte) << OPROS_SERIALIZATION_NVP(size);
    ar.save(reinterpret_cast<const char*>(image.getData()), static_cast<long>(size));
}
/// Throws archive_format_exception if the sizes do not match each other.
inline void load_this(opros::archive::iarchive& ar, RawImageData& image) {
    std::string raw;
    int width = 0, height = 0, pixelByte = 0;
    unsigned long size = 0;
    ar >> OPROS_SERIALIZATION_NVP(raw) >> OPROS_SERIALIZATION_NVP(width) >> OPROS_SERIALIZATION_NVP(height) >>
        OPROS_SERIALIZATION_NVP(pixelByte) >> OPROS_SERIALIZATION_NVP(size);
    // The bytes may come from another process, so at most 1 GiB is allocated for them.
    const unsigned long most = 1ul << 30;
    // Checked first: more pixels times pixelByte could overflow an unsigned long.
    const unsigned long pixels = static_cast<unsigned long>(width) * static_cast<unsigned long>(height);
    if (width < 0 || height < 0 || pixelByte < 0 || pixelByte > 64 || pixels > most || size > most ||
        pixels * pixelByte != size)
        throw opros::archive::archive_format_exception();
    image.resize(width, height, pixelByte);
    char* bytes = reinterpret_cast<char*>(image.getData());
    long count = static_cast<long>(size);
    ar.load(&bytes, count);
    if (size == 0) delete[] bytes; // with no space given, the archive has allocated its own
    if (count != static_cast<long>(size)) throw opros::archive::archive_format_exception();
}

/// The type on a component's port: a counted reference to the pixels.
class RawImage {
  public:
    RawImage() : m_image(new RawImageData) {}
    RawImage(RawImageData& image) : m_image(new RawImageData(image)) {}
    virtual ~RawImage() {}
    RawImage(const RawImage&) = default;
    RawImage& operator=(const RawImage&) = default;

    RawImageData* getImage() { return m_image.get(); }
    /// Takes ownership.
    void setImage(RawImageData* image) { m_image.reset(image); }

    void save(opros::archive::oarchive& ar, const unsigned int) { ar << OPROS_SERIALIZATION_NVP(m_image); }
    void load(opros::archive::iarchive& ar, const unsigned int) { ar >> OPROS_SERIALIZATION_NVP(m_image); }

  private:
    friend class opros::archive::access;
    opros::smart_ptr<RawImageData> m_image;
};

inline std::string typeName(RawImage*) { return "RawImage"; }

#endif
