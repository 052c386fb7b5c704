// regionmesh-mpi: `regionmesh reconstruct` with the blocks of a folder shared among the ranks of MPI.
#include <mpi.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "blocks.h"
#include "program.h"

namespace {

using namespace std::chrono_literals;

constexpr int kAsk = 1, kAnswer = 2;  // tags

/// Hands out tasks from rank 0. Ranks that wait sleep, where MPI would keep their cores busy: on machines with more
/// ranks than cores the others need these.
class MpiTasks final : public regionmesh::BlockTasks {
public:
    MpiTasks() {
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &size_);
        if (rank_ == 0 && size_ > 1) server_ = std::thread([this] { serve(); });
    }
    ~MpiTasks() override {
        is_done_ = true;
        if (server_.joinable()) server_.join();
    }
    MpiTasks(const MpiTasks&) = delete;
    MpiTasks& operator=(const MpiTasks&) = delete;

    int rank() const { return rank_; }
    bool is_first() const override { return rank_ == 0; }
    std::uint32_t processes() const override { return static_cast<std::uint32_t>(size_); }

    std::optional<std::uint32_t> next(std::uint32_t count) override {
        std::uint32_t task = 0;
        if (rank_ == 0) {
            task = next_++;
        } else {
            MPI_Send(nullptr, 0, MPI_BYTE, 0, kAsk, MPI_COMM_WORLD);
            MPI_Recv(&task, 1, MPI_UINT32_T, 0, kAnswer, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        }
        return task < count ? std::optional(task) : std::nullopt;
    }

    void end_phase() override {
        wait_for_all();
        next_ = 0;
        wait_for_all();
    }

private:
    static void wait_for_all() {
        MPI_Request request;
        MPI_Ibarrier(MPI_COMM_WORLD, &request);
        for (int is_there = 0;;) {
            MPI_Test(&request, &is_there, MPI_STATUS_IGNORE);
            if (is_there) return;
            std::this_thread::sleep_for(2ms);
        }
    }

    void serve() {
        while (!is_done_) {
            int is_asked = 0;
            MPI_Status status;
            MPI_Iprobe(MPI_ANY_SOURCE, kAsk, MPI_COMM_WORLD, &is_asked, &status);
            if (!is_asked) {
                std::this_thread::sleep_for(1ms);
                continue;
            }
            MPI_Recv(nullptr, 0, MPI_BYTE, status.MPI_SOURCE, kAsk, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
            const std::uint32_t task = next_++;
            MPI_Send(&task, 1, MPI_UINT32_T, status.MPI_SOURCE, kAnswer, MPI_COMM_WORLD);
        }
    }

    int rank_ = 0, size_ = 1;
    std::atomic<std::uint32_t> next_ = 0;
    std::atomic<bool> is_done_ = false;
    std::thread server_;
};

bool has(const std::vector<std::string>& arguments, const std::string& flag) {
    return std::ranges::any_of(arguments,
                               [&](const std::string& text) { return text == flag || text.starts_with(flag + '='); });
}

/// The command line of a rank: one thread unless the user says otherwise; no confinement, which would cut the rank off
/// from the others.
std::vector<std::string> arguments_of(int argc, char** argv) {
    std::vector<std::string> arguments(argv, argv + argc);
    if (argc < 2 || arguments[1] != "reconstruct") return arguments;
    if (!has(arguments, "--threads")) arguments.emplace_back("--threads=1");
    if (!has(arguments, "--no-sandbox")) arguments.emplace_back("--no-sandbox");
    return arguments;
}

int run(std::vector<std::string> arguments) {
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    return regionmesh::cli::run_program(static_cast<int>(arguments.size()), pointers.data());
}

}  // namespace

int main(int argc, char** argv) {
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_MULTIPLE, &provided);
    int code = EXIT_FAILURE, rank = 0;
    {
        MpiTasks tasks;
        rank = tasks.rank();
        regionmesh::cli::name_process("regionmesh-mpi: " + (rank > 0 ? "rank " + std::to_string(rank) + ": " : ""),
                                      rank == 0);
        const std::vector<std::string> arguments = arguments_of(argc, argv);
        if (provided < MPI_THREAD_MULTIPLE) {
            if (rank == 0) std::fputs("regionmesh-mpi: this MPI library has no MPI_THREAD_MULTIPLE\n", stderr);
        } else if (argc >= 2 && arguments[1] != "reconstruct" && arguments[1][0] != '-') {
            if (rank == 0)
                std::fputs("regionmesh-mpi: reconstruct is the command that ranks share; take regionmesh for others\n",
                           stderr);
            code = 2;
        } else {
            regionmesh::cli::share_blocks(tasks);
            code = run(arguments);
        }
        // The others wait for this rank: they have to end, too. Rank 0 says what all ranks find.
        if (code != EXIT_SUCCESS) {
            std::fflush(nullptr);
            if (rank > 0) std::this_thread::sleep_for(1s);
            MPI_Abort(MPI_COMM_WORLD, code);
        }
    }
    MPI_Finalize();
    return code;
}
