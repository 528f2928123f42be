// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_RINGBUFFER_H
#define RTC_RINGBUFFER_H
#include <algorithm>
#include <coil/stringutil.h>
#include <condition_variable>
#include <mutex>
#include <rtm/BufferBase.h>
#include <rtm/CopyValue.h>
#include <rtm/DataMutex.h>
#include <vector>

namespace RTC {

/// A bounded queue with OpenRTM-aist's policies. [any-thread] Properties (all below `buffer.`): `length` (8),
/// `write.full_policy` overwrite | do_nothing | block, `read.empty_policy` readback | do_nothing | block,
/// `write.timeout`, `read.timeout` in seconds (1). readback: an empty buffer returns the last value again.
template <class DataType>
class RingBuffer : public BufferBase<DataType> {
  public:
    explicit RingBuffer(long int length = 8) : slots_(static_cast<std::size_t>(length > 0 ? length : 1)) {}

    void init(const coil::Properties& prop) override {
        std::size_t n = 0;
        // A length from another process must not exhaust the memory. Ignores invalid lengths.
        if (coil::stringTo(n, prop.getProperty("length").c_str()) && n > 0 && n <= 1000000) length(n);
        read_policy(prop, "write.full_policy", "overwrite", overwrite_, block_write_);
        read_policy(prop, "read.empty_policy", "readback", readback_, block_read_);
        coil::stringTo(write_timeout_, prop.getProperty("write.timeout").c_str());
        coil::stringTo(read_timeout_, prop.getProperty("read.timeout").c_str());
    }

    std::size_t length() const override {
        Lock lock(mutex_);
        return slots_.size();
    }
    /// Drops the values in the buffer.
    BufferStatus length(std::size_t n) override {
        if (n == 0) return BufferStatus::NOT_SUPPORTED;
        Lock lock(mutex_);
        slots_.resize(n);
        clear();
        return BufferStatus::OK;
    }
    BufferStatus reset() override {
        Lock lock(mutex_);
        clear();
        return BufferStatus::OK;
    }

    /// Ours: makes each value readable once. A value that arrives in the empty buffer takes the slot of the last read
    /// value. Reading a long value does not copy it, but exchanges its memory with the reader's variable. Therefore
    /// advanceRptr() does not find the last value again. After a long value, readback works only with this variable, and
    /// returns it with any changes that its user has made.
    void readOnce() { reads_once_ = true; }

    // wptr(), rptr(), put() and get() access slots without moving. The mutex does not protect the pointers.
    DataType* wptr(long int n = 0) override {
        Lock lock(mutex_);
        return &slots_[wrapped_index(write_, n)];
    }
    BufferStatus advanceWptr(long int n = 1, bool /*unlock_enable*/ = true) override {
        Lock lock(mutex_);
        if (n > static_cast<long int>(slots_.size() - fill_) || n < -static_cast<long int>(fill_))
            return BufferStatus::PRECONDITION_NOT_MET;
        write_ = wrapped_index(write_, n);
        fill_ = static_cast<std::size_t>(static_cast<long int>(fill_) + n);
        written_ = written_ || n > 0;
        not_empty_.notify_all();
        return BufferStatus::OK;
    }
    BufferStatus put(const DataType& value) override {
        Lock lock(mutex_);
        copyValue(slots_[write_], value);
        return BufferStatus::OK;
    }
    /// `timeout` > 0: waits this long for room, independent of the policy; 0: does not wait; < 0: uses the policy.
    BufferStatus write(const DataType& value,
                       std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1)) override {
        bool ignored = false;
        return store(
            timeout, [&value](DataType& slot) { copyValue(slot, value); }, ignored);
    }
    BufferStatus writeReporting(const DataType& value, bool& overwritten) override {
        return store(
            std::chrono::nanoseconds(-1), [&value](DataType& slot) { copyValue(slot, value); }, overwritten);
    }
    /// Ours: does the same with a value that is no longer needed. A long value exchanges its memory with a slot's. As long
    /// as nobody has read, only the newest long value is kept: its slot's memory is still in the processor's caches.
    BufferStatus writeTaking(DataType& value, bool& overwritten) {
        if (isLong(value) && replace_unread(value)) {
            overwritten = true;
            return BufferStatus::OK;
        }
        return store(
            std::chrono::nanoseconds(-1),
            [&value](DataType& slot) {
                if (isLong(value))
                    takeValue(slot, value);
                else
                    copyValue(slot, value);
            },
            overwritten);
    }
    /// 1.x: the timeout in seconds and nanoseconds.
    BufferStatus write(const DataType& value, long int sec, long int nsec = 0) {
        return write(value, std::chrono::seconds(sec) + std::chrono::nanoseconds(nsec));
    }
    std::size_t writable() const override {
        Lock lock(mutex_);
        return slots_.size() - fill_;
    }
    bool full() const override {
        Lock lock(mutex_);
        return fill_ == slots_.size();
    }

    DataType* rptr(long int n = 0) override {
        Lock lock(mutex_);
        return &slots_[wrapped_index(read_, n)];
    }
    BufferStatus advanceRptr(long int n = 1, bool /*unlock_enable*/ = true) override {
        Lock lock(mutex_);
        if (n > static_cast<long int>(fill_) || n < -static_cast<long int>(slots_.size() - fill_))
            return BufferStatus::PRECONDITION_NOT_MET;
        read_ = wrapped_index(read_, n);
        fill_ = static_cast<std::size_t>(static_cast<long int>(fill_) - n);
        not_full_.notify_all();
        return BufferStatus::OK;
    }
    BufferStatus get(DataType& value) override {
        Lock lock(mutex_);
        copyValue(value, slots_[read_]);
        return BufferStatus::OK;
    }
    DataType& get() override {
        Lock lock(mutex_);
        return slots_[read_];
    }
    /// `timeout` as in write().
    BufferStatus read(DataType& value,
                      std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1)) override {
        Lock lock(mutex_);
        if (fill_ == 0) {
            const bool block = timeout.count() > 0 || (timeout.count() < 0 && block_read_);
            if (block) {
                auto bound = timeout.count() > 0 ? timeout : read_timeout_;
                if (!not_empty_.wait_for(lock, bound, [this] { return fill_ > 0; }))
                    return BufferStatus::TIMEOUT;
            } else if (readback_ && written_) {
                return readLast(value);
            } else {
                return BufferStatus::EMPTY;
            }
        }
        takeOut(value, slots_[read_]);
        read_ = wrapped_index(read_, 1);
        --fill_;
        if (block_write_) not_full_.notify_all();
        return BufferStatus::OK;
    }
    BufferStatus read(DataType& value, long int sec, long int nsec = 0) {
        return read(value, std::chrono::seconds(sec) + std::chrono::nanoseconds(nsec));
    }
    std::size_t readable() const override {
        Lock lock(mutex_);
        return fill_;
    }
    bool empty() const override { return readable() == 0; }

  private:
    using Lock = std::unique_lock<DataMutex>;

    static void read_policy(const coil::Properties& prop, const char* key, const char* default_word,
                            bool& default_policy, bool& block) {
        const std::string policy = coil::normalize(prop.getProperty(key));
        if (policy.empty()) return;
        default_policy = policy == default_word;
        block = policy == "block";
    }
    template <class Put>
    BufferStatus store(std::chrono::nanoseconds timeout, const Put& put, bool& overwritten) {
        overwritten = false;
        Lock lock(mutex_);
        if (fill_ == slots_.size()) {
            const bool block = timeout.count() > 0 || (timeout.count() < 0 && block_write_);
            if (block) {
                auto bound = timeout.count() > 0 ? timeout : write_timeout_;
                if (!not_full_.wait_for(lock, bound, [this] { return fill_ < slots_.size(); }))
                    return BufferStatus::TIMEOUT;
            } else if (overwrite_) {
                read_ = wrapped_index(read_, 1);
                --fill_;
                overwritten = true;
            } else {
                return BufferStatus::FULL;
            }
        }
        // In the slot of the last value, the new value finds memory that is still in the processor's caches.
        if (reads_once_ && fill_ == 0 && write_ > 0) read_ = --write_;
        put(slots_[write_]);
        write_ = wrapped_index(write_, 1);
        ++fill_;
        written_ = true;
        if (block_read_) not_empty_.notify_all(); // otherwise no reader waits
        return BufferStatus::OK;
    }
    /// Returns false, without side effects, if a value was read before, or there is none to replace.
    bool replace_unread(DataType& value) {
        Lock lock(mutex_);
        if (was_read_ || fill_ == 0 || !overwrite_) return false;
        takeValue(slots_[wrapped_index(write_, -1)], value);
        return true;
    }
    void takeOut(DataType& value, DataType& slot) {
        was_read_ = true;
        if (__builtin_expect(reads_once_ && isLong(slot), false)) {
            taken_by_ = takeValue(value, slot) ? &value : nullptr;
        } else {
            copyValue(value, slot);
            taken_by_ = nullptr;
        }
    }
    // The slot before the read position still has the last value, unless the value was taken out.
    BufferStatus readLast(DataType& value) {
        if (taken_by_ == nullptr)
            copyValue(value, slots_[wrapped_index(read_, -1)]);
        else if (taken_by_ != &value)
            return BufferStatus::EMPTY;
        return BufferStatus::OK;
    }
    std::size_t wrapped_index(std::size_t index, long int n) const {
        if (n == 1)
            return index + 1 == slots_.size() ? 0 : index + 1; // for each message; a division takes longer
        const long int size = static_cast<long int>(slots_.size());
        return static_cast<std::size_t>(((static_cast<long int>(index) + n) % size + size) % size);
    }
    void clear() {
        write_ = read_ = fill_ = 0;
        written_ = false;
        taken_by_ = nullptr;
    }

    std::vector<DataType> slots_;
    std::size_t write_ = 0;
    std::size_t read_ = 0;
    std::size_t fill_ = 0;
    bool written_ = false; // since the last reset: readback has a value
    bool reads_once_ = false;
    bool was_read_ = false; // ever
    // the variable with the only copy of the last value; NULL: it is in the slot
    const DataType* taken_by_ = nullptr;
    bool overwrite_ = true;
    bool block_write_ = false;
    bool readback_ = true;
    bool block_read_ = false;
    std::chrono::nanoseconds write_timeout_ = std::chrono::seconds(1);
    std::chrono::nanoseconds read_timeout_ = std::chrono::seconds(1);
    mutable DataMutex mutex_;
    std::condition_variable_any not_empty_;
    std::condition_variable_any not_full_;
};

} // namespace RTC
#endif
