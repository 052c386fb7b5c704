// What the kernel and the build have for the sandbox.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include "regionmesh/sandbox.h"

namespace regionmesh::test {

/// Enters the sandbox in a child process, which ends: this one stays free.
inline SandboxState sandbox_state() {
    const pid_t child = ::fork();
    if (child == 0) {
        const SandboxState state = enter_sandbox({});
        ::_exit((state.files ? 1 : 0) + (state.calls ? 2 : 0));
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    return {.files = (code & 1) != 0, .calls = (code & 2) != 0};
}

}  // namespace regionmesh::test

#define SKIP_WITHOUT(feature, name) \
    if (!regionmesh::test::sandbox_state().feature) GTEST_SKIP() << "this kernel, or this build, has no " name
