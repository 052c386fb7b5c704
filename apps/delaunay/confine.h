// SPDX-License-Identifier: GPL-3.0-or-later
//
// Takes from this process all rights that it does not need, where the kernel can: it reads standard input and writes
// standard output, which are open already.
#pragma once

#ifdef __linux__
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>

/// No file can be opened or made, no program started, no socket made.
inline void confine() {
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return;
    const landlock_ruleset_attr all{.handled_access_fs = LANDLOCK_ACCESS_FS_MAKE_SYM * 2 - 1};
    const long rules = ::syscall(SYS_landlock_create_ruleset, &all, sizeof(all), 0);
    if (rules >= 0) {
        ::syscall(SYS_landlock_restrict_self, rules, 0);
        ::close(static_cast<int>(rules));
    }
#if defined(__x86_64__) || defined(__aarch64__)
#ifdef __x86_64__
    constexpr std::uint32_t kMachine = AUDIT_ARCH_X86_64, kForeignCall = 0x40000000;
#else
    constexpr std::uint32_t kMachine = AUDIT_ARCH_AARCH64, kForeignCall = 0xFFFFFFFF;
#endif
    constexpr std::uint32_t kRefuse = SECCOMP_RET_ERRNO | EPERM;
    const auto is = [](long call, std::uint8_t steps) {
        return sock_filter{BPF_JMP | BPF_JEQ | BPF_K, steps, 0, static_cast<std::uint32_t>(call)};
    };
    sock_filter steps[] = {
        {BPF_LD | BPF_W | BPF_ABS, 0, 0, offsetof(seccomp_data, arch)},
        {BPF_JMP | BPF_JEQ | BPF_K, 0, 9, kMachine},
        {BPF_LD | BPF_W | BPF_ABS, 0, 0, offsetof(seccomp_data, nr)},
        {BPF_JMP | BPF_JGE | BPF_K, 7, 0, kForeignCall},
        is(SYS_socket, 6),
        is(SYS_connect, 5),
        is(SYS_execve, 4),
        is(SYS_execveat, 3),
        is(SYS_io_uring_setup, 2),
        is(SYS_process_vm_writev, 1),
        {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ALLOW},
        {BPF_RET | BPF_K, 0, 0, kRefuse},
    };
    const sock_fprog filter{sizeof(steps) / sizeof(steps[0]), steps};
    ::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &filter);
#endif
}
#else
inline void confine() {}
#endif
