// Loaded in front of the C library (LD_PRELOAD): counts the calls that can fail and lets the n-th one fail.
//
//   REGIONMESH_FAULT        call, memory, kill or term: what happens at the n-th call (kill and term: the signal)
//   REGIONMESH_FAULT_AT     n, from 1; 0: nothing fails
//   REGIONMESH_FAULT_COUNT  file that gets the number of calls and of allocations, one line
//
// Counts from the start of main() to its end.
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

enum class Mode { kNone, kCall, kMemory, kKill, kTerm };

std::atomic<bool> is_armed{false};
std::atomic<std::uint64_t> calls{0}, allocations{0};
Mode mode = Mode::kNone;
std::uint64_t fault_at = 0;

int counts = -1;  // descriptor: opened before the program confines itself

void arm() {
    if (const char* name = std::getenv("REGIONMESH_FAULT_COUNT"))
        counts = ::open(name, O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    const char* word = std::getenv("REGIONMESH_FAULT");
    const char* at = std::getenv("REGIONMESH_FAULT_AT");
    if (word && at) {
        fault_at = std::strtoull(at, nullptr, 10);
        mode = !std::strcmp(word, "call")     ? Mode::kCall
               : !std::strcmp(word, "memory") ? Mode::kMemory
               : !std::strcmp(word, "kill")   ? Mode::kKill
               : !std::strcmp(word, "term")   ? Mode::kTerm
                                              : Mode::kNone;
    }
    is_armed = true;
}

void disarm() {
    if (!is_armed.exchange(false)) return;
    if (counts < 0) return;
    char text[64];
    const int size = std::snprintf(text, sizeof(text), "%llu %llu\n", static_cast<unsigned long long>(calls),
                                   static_cast<unsigned long long>(allocations));
    if (::ftruncate(counts, 0) == 0) (void)!::pwrite(counts, text, static_cast<std::size_t>(size), 0);
}

/// Whether this call is the one that fails; then errno is `error`.
bool fails(int error) {
    if (!is_armed) return false;
    if (++calls != fault_at) return false;
    if (mode == Mode::kKill) ::kill(::getpid(), SIGKILL);
    if (mode == Mode::kTerm) ::kill(::getpid(), SIGTERM);
    if (mode != Mode::kCall) return false;
    errno = error;
    return true;
}

bool allocation_fails() {
    if (!is_armed) return false;
    if (++allocations != fault_at || mode != Mode::kMemory) return false;
    errno = ENOMEM;
    return true;
}

template <class Function>
Function real(Function, const char* name) {
    return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

int (*program_main)(int, char**, char**) = nullptr;

int armed_main(int count, char** words, char** environment) {
    std::atexit(disarm);
    arm();
    const int code = program_main(count, words, environment);
    disarm();
    return code;
}

}  // namespace

/// A function that returns `bad` when it fails.
#define FAULT(type, name, parameters, arguments, bad, error)                            \
    extern "C" type name parameters {                                                   \
        static const auto next = real(static_cast<type(*) parameters>(nullptr), #name); \
        return fails(error) ? (bad) : next arguments;                                   \
    }

FAULT(ssize_t, read, (int file, void* to, size_t size), (file, to, size), -1, EIO)
FAULT(ssize_t, write, (int file, const void* from, size_t size), (file, from, size), -1, ENOSPC)
FAULT(ssize_t, pread, (int file, void* to, size_t size, off_t at), (file, to, size, at), -1, EIO)
FAULT(ssize_t, pread64, (int file, void* to, size_t size, off64_t at), (file, to, size, at), -1, EIO)
FAULT(ssize_t, pwrite, (int file, const void* from, size_t size, off_t at), (file, from, size, at), -1, ENOSPC)
FAULT(ssize_t, pwrite64, (int file, const void* from, size_t size, off64_t at), (file, from, size, at), -1, ENOSPC)
FAULT(ssize_t, send, (int file, const void* from, size_t size, int flags), (file, from, size, flags), -1, EPIPE)
FAULT(ssize_t, recv, (int file, void* to, size_t size, int flags), (file, to, size, flags), -1, ECONNRESET)
FAULT(int, socketpair, (int domain, int type, int protocol, int* pair), (domain, type, protocol, pair), -1, EMFILE)
FAULT(int, pipe2, (int* pair, int flags), (pair, flags), -1, EMFILE)
FAULT(int, fsync, (int file), (file), -1, EIO)
FAULT(int, fchmod, (int file, mode_t bits), (file, bits), -1, EIO)
FAULT(int, rename, (const char* from, const char* to), (from, to), -1, EACCES)
FAULT(int, renameat2, (int a, const char* from, int b, const char* to, unsigned flags), (a, from, b, to, flags), -1,
      EACCES)
FAULT(FILE*, fdopen, (int file, const char* how), (file, how), nullptr, ENOMEM)
FAULT(FILE*, fopen, (const char* name, const char* how), (name, how), nullptr, EMFILE)
FAULT(FILE*, fopen64, (const char* name, const char* how), (name, how), nullptr, EMFILE)
FAULT(size_t, fwrite, (const void* from, size_t size, size_t count, FILE* file), (from, size, count, file), 0, ENOSPC)
FAULT(int, fflush, (FILE * file), (file), EOF, ENOSPC)
FAULT(int, fseeko, (FILE * file, off_t at, int from), (file, at, from), -1, EIO)
FAULT(int, fseeko64, (FILE * file, off64_t at, int from), (file, at, from), -1, EIO)

// These return the error itself.
FAULT(int, pthread_create, (pthread_t * thread, const pthread_attr_t* how, void* (*run)(void*), void* data),
      (thread, how, run, data), EAGAIN, EAGAIN)
FAULT(int, posix_spawn,
      (pid_t * process, const char* program, const posix_spawn_file_actions_t* files, const posix_spawnattr_t* how,
       char* const* words, char* const* environment),
      (process, program, files, how, words, environment), EAGAIN, EAGAIN)

#define FAULTY_OPEN(name)                                                                           \
    extern "C" int name(const char* path, int flags, ...) {                                         \
        static const auto next = real(static_cast<int (*)(const char*, int, ...)>(nullptr), #name); \
        std::va_list list;                                                                          \
        va_start(list, flags);                                                                      \
        const mode_t bits = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(list, mode_t) : 0;        \
        va_end(list);                                                                               \
        return fails(EMFILE) ? -1 : next(path, flags, bits);                                        \
    }

FAULTY_OPEN(open)
FAULTY_OPEN(open64)

extern "C" {

/// Closes the file, as the system does, and reports an error.
int fclose(FILE* file) {
    static const auto next = real(static_cast<int (*)(FILE*)>(nullptr), "fclose");
    const bool is_bad = fails(EIO);
    const int done = next(file);
    if (is_bad) errno = EIO;
    return is_bad ? EOF : done;
}

void* malloc(std::size_t size) { return allocation_fails() ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) { return allocation_fails() ? nullptr : __libc_calloc(count, size); }
void* realloc(void* old, std::size_t size) { return allocation_fails() ? nullptr : __libc_realloc(old, size); }
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    return allocation_fails() ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** to, std::size_t alignment, std::size_t size) {
    if (allocation_fails()) return ENOMEM;
    *to = __libc_memalign(alignment, size);
    return *to ? 0 : ENOMEM;
}

int __libc_start_main(int (*main)(int, char**, char**), int count, char** words, void (*first)(), void (*last)(),
                      void (*linker)(), void* stack) {
    const auto next = real(&__libc_start_main, "__libc_start_main");
    program_main = main;
    return next(armed_main, count, words, first, last, linker, stack);
}

}  // extern "C"
