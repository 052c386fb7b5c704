// Reading and inflating beside the work: the next section is read while the last one is worked on.
#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "regionmesh/section_reader.h"

namespace regionmesh {

/// Hands out the sections of another reader, which a thread of its own reads one section ahead. What that reader throws
/// is thrown by `next` in place of the section, after all sections before it, and again if asked again. Nothing is read
/// before the first `next`. Holds one section. The other reader is called by one thread at a time, and stands anywhere
/// after this one is gone.
class ReadAhead final : public SectionReader {
public:
    explicit ReadAhead(SectionReader& reader) : reader_(reader), info_(reader.info()) {}
    ReadAhead(const ReadAhead&) = delete;
    ReadAhead& operator=(const ReadAhead&) = delete;
    /// Waits for the section being read.
    ~ReadAhead() override { stop(); }

    const VolumeInfo& info() const override { return info_; }
    bool next(std::span<InputLabel> section) override;
    void rewind() override;

private:
    void start();
    void stop();
    void read_all();

    SectionReader& reader_;
    VolumeInfo info_;
    std::thread thread_;
    std::mutex mutex_;
    std::condition_variable changed_;
    // All below belongs to the thread while is_wanted_, to the caller while it is not.
    std::vector<InputLabel> section_;
    bool is_wanted_ = false, is_stopping_ = false;
    bool is_end_ = false;  // no section follows: the last one was read, or reading failed
    std::exception_ptr failure_;
};

}  // namespace regionmesh
