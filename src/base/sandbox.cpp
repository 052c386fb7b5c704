#include "regionmesh/sandbox.h"

// A build that counts lines writes its counts where the sandbox forbids it.
#if defined(__linux__) && !defined(REGIONMESH_NO_SANDBOX)
#include <fcntl.h>
#include <link.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

// Rights that headers of older kernels lack; the kernel says whether it knows them.
constexpr std::uint64_t kRefer = 1ULL << 13, kTruncate = 1ULL << 14, kIoctl = 1ULL << 15;

constexpr std::uint64_t kReadRights = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t kFileRights = LANDLOCK_ACCESS_FS_WRITE_FILE | kTruncate;
constexpr std::uint64_t kFolderRights = kFileRights | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_REMOVE_FILE;
constexpr std::uint64_t kOtherRights = LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_MAKE_CHAR |
                                       LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_SOCK |
                                       LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK |
                                       LANDLOCK_ACCESS_FS_MAKE_SYM | kRefer | kIoctl;

/// The rights that a kernel with this version of Landlock can take away.
std::uint64_t known_rights(long version) {
    std::uint64_t rights = LANDLOCK_ACCESS_FS_EXECUTE | kReadRights | kFolderRights | kOtherRights;
    if (version < 2) rights &= ~kRefer;
    if (version < 3) rights &= ~kTruncate;
    if (version < 5) rights &= ~kIoctl;
    return rights;
}

class Ruleset {
public:
    explicit Ruleset(std::uint64_t handled) : handled_(handled) {
        const landlock_ruleset_attr attributes{.handled_access_fs = handled};
        file_ = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &attributes, sizeof(attributes), 0));
    }
    ~Ruleset() {
        if (file_ >= 0) ::close(file_);
    }
    Ruleset(const Ruleset&) = delete;
    Ruleset& operator=(const Ruleset&) = delete;

    /// A path that does not exist needs no right.
    void allow(const char* path, std::uint64_t rights) const {
        const int at = ::open(path, O_PATH | O_CLOEXEC);
        if (at < 0) return;
        struct stat status {};
        const bool is_folder = ::fstat(at, &status) == 0 && S_ISDIR(status.st_mode);
        if (!is_folder) rights &= kFileRights | LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_EXECUTE | kIoctl;
        const landlock_path_beneath_attr rule{.allowed_access = rights & handled_, .parent_fd = at};
        if (rule.allowed_access != 0) ::syscall(SYS_landlock_add_rule, file_, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
        ::close(at);
    }
    bool enter() const { return file_ >= 0 && ::syscall(SYS_landlock_restrict_self, file_, 0) == 0; }

private:
    std::uint64_t handled_;
    int file_ = -1;
};

/// The program that loads shared libraries: the kernel starts it with every program. Programs of one build share it.
void allow_loader(const Ruleset& ruleset) {
    ::dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* data) {
            for (int n = 0; n < info->dlpi_phnum; ++n)
                if (info->dlpi_phdr[n].p_type == PT_INTERP)
                    static_cast<const Ruleset*>(data)->allow(
                        reinterpret_cast<const char*>(info->dlpi_addr + info->dlpi_phdr[n].p_vaddr),
                        LANDLOCK_ACCESS_FS_EXECUTE);
            return 1;  // the first is the program itself
        },
        const_cast<Ruleset*>(&ruleset));
}

bool confine_files(const SandboxRules& rules) {
    const long version =
        ::syscall(SYS_landlock_create_ruleset, nullptr, std::size_t{0}, LANDLOCK_CREATE_RULESET_VERSION);
    if (version < 1) return false;
    std::uint64_t handled = known_rights(version);
    if (rules.reads_anything) handled &= ~kReadRights;
    const Ruleset ruleset(handled);
    for (const fs::path& path : rules.readable) ruleset.allow(path.c_str(), kReadRights);
    for (const fs::path& path : rules.writable) ruleset.allow(path.c_str(), kFolderRights);
    for (const fs::path& path : rules.emptied) ruleset.allow(path.c_str(), LANDLOCK_ACCESS_FS_REMOVE_DIR);
    for (const fs::path& path : rules.runnable) ruleset.allow(path.c_str(), LANDLOCK_ACCESS_FS_EXECUTE);
    if (!rules.runnable.empty()) allow_loader(ruleset);
    return ruleset.enter();
}

#if defined(__x86_64__)
constexpr std::uint32_t kMachine = AUDIT_ARCH_X86_64, kForeignCall = 0x40000000;  // flag of the x32 interface
#elif defined(__aarch64__)
constexpr std::uint32_t kMachine = AUDIT_ARCH_AARCH64, kForeignCall = 0xFFFFFFFF;
#else
constexpr std::uint32_t kMachine = 0, kForeignCall = 0;
#endif

// socketpair() stays: the helper programs are spoken to over one. io_uring makes sockets without socket().
constexpr std::array kRefused {
    SYS_socket, SYS_connect, SYS_bind, SYS_listen, SYS_io_uring_setup, SYS_io_uring_enter,
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // sanitizers look into their own process with it
        SYS_ptrace,
#endif
        SYS_bpf, SYS_process_vm_readv, SYS_process_vm_writev, SYS_pidfd_getfd, SYS_perf_event_open, SYS_userfaultfd,
        SYS_add_key, SYS_request_key, SYS_keyctl, SYS_mount, SYS_umount2, SYS_pivot_root, SYS_chroot, SYS_unshare,
        SYS_setns, SYS_init_module, SYS_finit_module, SYS_kexec_load, SYS_open_by_handle_at
};
constexpr std::array kProgramCalls{SYS_execve, SYS_execveat};
constexpr std::size_t kMostSteps = 8 + 2 * (kRefused.size() + kProgramCalls.size());

/// Steps of the filter, which the kernel runs before every call.
class Filter {
public:
    void add(std::uint16_t code, std::uint32_t value, std::uint8_t if_true = 0, std::uint8_t if_false = 0) {
        steps_[count_++] = {code, if_true, if_false, value};
    }
    void load(std::size_t offset) { add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)); }
    void refuse() { add(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM); }
    void refuse(long call) {
        add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1);
        refuse();
    }
    /// Applies to all threads.
    bool enter() {
        const sock_fprog program{static_cast<unsigned short>(count_), steps_.data()};
        return ::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &program) == 0;
    }

private:
    std::array<sock_filter, kMostSteps> steps_{};
    std::size_t count_ = 0;
};

bool confine_calls(bool starts_programs) {
    if (kMachine == 0) return false;
    Filter filter;
    filter.load(offsetof(seccomp_data, arch));
    filter.add(BPF_JMP | BPF_JEQ | BPF_K, kMachine, 1, 0);
    filter.refuse();
    filter.load(offsetof(seccomp_data, nr));
    filter.add(BPF_JMP | BPF_JGE | BPF_K, kForeignCall, 0, 1);
    filter.refuse();
    for (const long call : kRefused) filter.refuse(call);
    if (!starts_programs)
        for (const long call : kProgramCalls) filter.refuse(call);
    filter.add(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
    return filter.enter();
}

}  // namespace

SandboxState enter_sandbox(const SandboxRules& rules) noexcept {
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return {};
    SandboxState state;
    state.files = confine_files(rules);
    state.calls = confine_calls(rules.starts_programs);
    return state;
}

}  // namespace regionmesh

#else

namespace regionmesh {

SandboxState enter_sandbox(const SandboxRules&) noexcept { return {}; }

}  // namespace regionmesh

#endif
