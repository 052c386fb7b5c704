// Reads and decompresses the next section while the last one is worked on.
#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "regionmesh/section_reader.h"

namespace regionmesh {

/// Returns the sections of another reader, which a thread of its own reads one section ahead. An exception of that
/// reader is thrown by `next` in place of the section, after all sections before it, and again at later calls. Nothing
/// is read before the first `next`. Holds one section. The other reader is called by one thread at a time; its position
/// is not defined after this object is destroyed.
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
    // All members below belong to the thread while is_wanted_, and else to the caller.
    std::vector<InputLabel> section_;
    bool is_wanted_ = false, is_stopping_ = false;
    bool is_end_ = false;  // no section follows: the last one was read, or reading failed
    std::exception_ptr failure_;
};

}  // namespace regionmesh
