#include "formats/part_files.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstddef>
#include <map>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>
#include <thread>

#include "base/fingerprint.h"
#include "regionmesh/output_file.h"

namespace regionmesh {
namespace formats {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = ".part-";
/// Of the 255 bytes of a file name: leaves room for a hash, by which longer names that begin alike are told apart, and
/// for the rest of a temporary name.
constexpr std::size_t kLongestName = 180;

struct Parts {
    std::mutex mutex;
    std::map<const OutputFile*, fs::path> paths;
};

/// Never destroyed: the thread that waits for signals may outlive main(). Takes no memory, so that a program without
/// any can remove its outputs.
Parts& parts() {
    alignas(Parts) static std::byte place[sizeof(Parts)];
    static Parts* const all = new (place) Parts;
    return *all;
}

struct CloseFolder {
    void operator()(DIR* folder) const { ::closedir(folder); }
};

/// Whether a process with the id that the name ends with is alive; true for a name that is none of ours.
bool has_living_writer(std::string_view name) {
    const std::size_t mark = name.rfind(kMark);
    if (mark == std::string_view::npos) return true;
    name.remove_prefix(mark + kMark.size());
    pid_t process = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), process);
    const bool is_id = error == std::errc{} && process > 0 && (end == name.data() + name.size() || *end == '-');
    return !is_id || ::kill(process, 0) == 0 || errno != ESRCH;
}

/// A writer on another machine, or in another container, holds the lock of its file.
bool is_locked(const fs::path& part) {
    const int file = ::open(part.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (file < 0) return true;
    const bool is_held = ::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    ::close(file);
    return is_held;
}

}  // namespace

std::string part_prefix(const fs::path& target) {
    std::string name = target.filename().string();
    if (name.size() > kLongestName)
        name = fmt::format("{}~{:016x}", name.substr(0, kLongestName), Fingerprint().add(name).value());
    return "." + name + std::string(kMark);
}

std::string part_name(const fs::path& target, int attempt) {
    std::string name = part_prefix(target) + std::to_string(::getpid());
    if (attempt > 0) name += "-" + std::to_string(attempt);
    return name;
}

int create_part(const OutputFile* output, const fs::path& part, unsigned mode) {
    const std::lock_guard lock(parts().mutex);
    parts().paths[output] = fs::absolute(part);
    return ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, static_cast<mode_t>(mode));
}

void forget_part(const OutputFile* output) noexcept {
    const std::lock_guard lock(parts().mutex);
    parts().paths.erase(output);
}

PartsHeld::PartsHeld() : lock_(parts().mutex) {}

void remove_stale_parts(const fs::path& target, bool per_region) {
    const std::string whole = part_prefix(target);
    const std::string region = "." + target.stem().string() + "-",
                      has = target.extension().string() + std::string(kMark);
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    // fs::directory_iterator would end the process where memory is short.
    const std::unique_ptr<DIR, CloseFolder> opened(::opendir(folder.c_str()));
    while (const dirent* entry = opened ? ::readdir(opened.get()) : nullptr) {
        const std::string name = entry->d_name;
        const bool is_ours =
            name.starts_with(whole) || (per_region && name.starts_with(region) && name.find(has) != std::string::npos);
        if (!is_ours || has_living_writer(name)) continue;
        const fs::path part = folder / name;
        std::error_code unknown;
        if (fs::is_regular_file(part, unknown) && !is_locked(part)) fs::remove(part, unknown);
    }
}

}  // namespace formats

void remove_outputs() noexcept {
    const std::unique_lock lock(formats::parts().mutex, std::try_to_lock);  // a commit in this thread may hold it
    if (!lock) return;
    for (const auto& [output, part] : formats::parts().paths) ::unlink(part.c_str());
}

void end_without_outputs(int exit_code) noexcept {
    formats::parts().mutex.lock();  // for good: no file is made or renamed any more
    for (const auto& [output, part] : formats::parts().paths) ::unlink(part.c_str());
    ::_exit(exit_code);
}

void remove_outputs_on_signals() {
    sigset_t waited;
    ::sigemptyset(&waited);
    bool is_any = false;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
        struct sigaction now {};
        if (::sigaction(signal, nullptr, &now) != 0 || now.sa_handler == SIG_IGN) continue;
        ::sigaddset(&waited, signal);
        is_any = true;
    }
    if (!is_any) return;
    formats::parts();
    // All threads that start later inherit the mask; so only the thread below gets these signals.
    ::pthread_sigmask(SIG_BLOCK, &waited, nullptr);
    const auto wait_and_remove = [waited] {
        int signal = 0;
        while (::sigwait(&waited, &signal) != 0) {
        }
        const std::lock_guard lock(formats::parts().mutex);  // kept to the end: no file is made or renamed any more
        for (const auto& [output, part] : formats::parts().paths) ::unlink(part.c_str());
        ::signal(signal, SIG_DFL);
        sigset_t one;
        ::sigemptyset(&one);
        ::sigaddset(&one, signal);
        ::pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
        ::raise(signal);
        ::_exit(128 + signal);
    };
    try {
        std::thread(wait_and_remove).detach();
    } catch (const std::system_error&) {  // no room for a thread: signals end the process as they do by default
        ::pthread_sigmask(SIG_UNBLOCK, &waited, nullptr);
    }
}

}  // namespace regionmesh
