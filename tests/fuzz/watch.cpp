#include "fuzz/watch.h"

#include <malloc.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <new>

#if defined(__SANITIZE_ADDRESS__)
extern "C" {
int __sanitizer_install_malloc_and_free_hooks(void (*)(const volatile void*, std::size_t),
                                              void (*)(const volatile void*));
std::size_t __sanitizer_get_allocated_size(const volatile void*);
void __sanitizer_set_death_callback(void (*)());
const char* __ubsan_default_options() { return "abort_on_error=1:print_stacktrace=1"; }
}
#endif

namespace regionmesh::fuzz {
namespace {

constexpr int kMostSeconds = 10;  // of processor time: the machine may have other things to do
constexpr int kMostWaiting = 600;

char watched[4096];
std::atomic<std::int64_t> held{0}, peak{0}, limit{INT64_MAX};

void say(const char* text) {
    if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) std::_Exit(3);
}

void say_watched() {
    say("\nfound while reading ");
    say(watched);
    say("\n");
}

[[noreturn]] void give_up(const char* what) {
    say(what);
    say_watched();
    std::_Exit(1);
}

void on_signal(int number) { give_up(number == SIGPROF || number == SIGALRM ? "a reader hangs" : "a reader crashed"); }

void note_taken(std::size_t bytes) {
    const std::int64_t now = held += static_cast<std::int64_t>(bytes);
    if (now > peak) peak = now;
    if (now > limit) {
        limit = INT64_MAX;  // what is said may take memory, too
        give_up("a reader takes too much memory");
    }
}

void note_given_back(std::size_t bytes) { held -= static_cast<std::int64_t>(bytes); }

#if defined(__SANITIZE_ADDRESS__)
void watch_memory() {
    __sanitizer_install_malloc_and_free_hooks([](const volatile void*, std::size_t bytes) { note_taken(bytes); },
                                              [](const volatile void* place) {
                                                  if (place) note_given_back(__sanitizer_get_allocated_size(place));
                                              });
    __sanitizer_set_death_callback(say_watched);
    std::signal(SIGABRT, on_signal);  // of undefined behaviour
}
#else
void watch_memory() {
    for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(number, on_signal);
}
#endif

void set_timers(int seconds, int waiting) {
    itimerval timer{};
    timer.it_value.tv_sec = seconds;
    ::setitimer(ITIMER_PROF, &timer, nullptr);
    ::alarm(static_cast<unsigned>(waiting));
}

}  // namespace

void start_watching() {
    std::signal(SIGPROF, on_signal);
    std::signal(SIGALRM, on_signal);
    watch_memory();
}

void begin_watch(const std::string& text, std::uint64_t most_bytes) {
    const std::size_t count = std::min(text.size(), sizeof watched - 1);
    std::memcpy(watched, text.data(), count);
    watched[count] = '\0';
    held = peak = 0;
    limit = static_cast<std::int64_t>(most_bytes);
    set_timers(kMostSeconds, kMostWaiting);
}

std::uint64_t end_watch() {
    set_timers(0, 0);
    limit = INT64_MAX;
    return static_cast<std::uint64_t>(std::max<std::int64_t>(peak, 0));
}

}  // namespace regionmesh::fuzz

#if !defined(__SANITIZE_ADDRESS__)
// Without a sanitizer only what C++ takes is counted.
void* operator new(std::size_t bytes) {
    void* const place = std::malloc(std::max<std::size_t>(bytes, 1));
    if (!place) throw std::bad_alloc();
    regionmesh::fuzz::note_taken(::malloc_usable_size(place));
    return place;
}
void operator delete(void* place) noexcept {
    if (place) regionmesh::fuzz::note_given_back(::malloc_usable_size(place));
    std::free(place);
}
void operator delete(void* place, std::size_t) noexcept { operator delete(place); }
#endif
