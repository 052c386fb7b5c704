#include "formats/surface/zip_file_3mf.h"

#include <minizip/zip.h>

#include <algorithm>
#include <new>
#include <utility>

#include "regionmesh/error.h"

namespace regionmesh {
namespace {

constexpr std::size_t kMostAtOnce = std::size_t{1} << 30;
constexpr std::uint64_t kMostPlain = 0xF0000000;  // larger entries need the fields of ZIP64

}  // namespace

/// The functions through which minizip writes: they are called from C and must not throw.
struct ZipFile::Target {
    static ZipFile& zip(void* self) { return *static_cast<ZipFile*>(self); }

    static void* open(void* self, const void*, int) { return self; }
    static uLong read(void*, void*, void*, uLong) { return 0; }

    static uLong write(void* self, void*, const void* bytes, uLong count) {
        ZipFile& to = zip(self);
        const std::string_view text(static_cast<const char*>(bytes), count);
        try {
            const std::uint64_t end = to.file_.size();
            const auto inside = std::min<std::uint64_t>(count, end - std::min(end, to.place_));
            if (inside > 0) to.file_.overwrite(to.place_, text.substr(0, inside));
            if (inside < count) to.file_.write(text.substr(inside));
        } catch (...) {
            to.failure_ = std::current_exception();
            return 0;
        }
        to.place_ += count;
        return count;
    }

    static ZPOS64_T tell(void* self, void*) { return zip(self).place_; }

    static long seek(void* self, void*, ZPOS64_T offset, int origin) {
        ZipFile& to = zip(self);
        const std::uint64_t from = origin == ZLIB_FILEFUNC_SEEK_SET   ? 0
                                   : origin == ZLIB_FILEFUNC_SEEK_CUR ? to.place_
                                                                      : to.file_.size();
        to.place_ = from + offset;
        return to.place_ <= to.file_.size() ? 0 : -1;
    }

    static int close(void*, void*) { return 0; }
    static int error(void* self, void*) { return zip(self).failure_ ? 1 : 0; }
};

ZipFile::ZipFile(OutputFile& file) : file_(file) {
    zlib_filefunc64_def functions{Target::open, Target::read,  Target::write, Target::tell,
                                  Target::seek, Target::close, Target::error, this};
    archive_ = zipOpen2_64("", APPEND_STATUS_CREATE, nullptr, &functions);
    if (!archive_) throw std::bad_alloc();
}

ZipFile::~ZipFile() {
    if (archive_) zipClose(archive_, nullptr);
}

void ZipFile::check(int result) {
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    if (result == ZIP_INTERNALERROR || result == Z_MEM_ERROR) throw std::bad_alloc();
    if (result != ZIP_OK)
        throw Error(ErrorCode::kOutput, "the archive cannot be written, error " + std::to_string(result));
}

void ZipFile::begin_entry(const char* name, std::uint64_t most_bytes) {
    end_entry();
    zip_fileinfo info{};
    info.tmz_date.tm_mday = 1;
    info.tmz_date.tm_year = 1980;  // the least
    check(zipOpenNewFileInZip64(archive_, name, &info, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED,
                                Z_DEFAULT_COMPRESSION, most_bytes >= kMostPlain));
    has_entry_ = true;
}

void ZipFile::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const std::string_view part = bytes.substr(0, kMostAtOnce);
        check(zipWriteInFileInZip(archive_, part.data(), static_cast<unsigned>(part.size())));
        bytes.remove_prefix(part.size());
    }
}

void ZipFile::end_entry() {
    if (std::exchange(has_entry_, false)) check(zipCloseFileInZip(archive_));
}

void ZipFile::finish() {
    end_entry();
    check(zipClose(std::exchange(archive_, nullptr), nullptr));
}

}  // namespace regionmesh
