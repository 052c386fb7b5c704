#include "cli/program.h"

namespace regionmesh {
namespace {

/// Starts twenty processes at once, in one folder. `$n` in the arguments is the number of each.
class Twenty : public Program {
protected:
    int run_twenty(const std::string& arguments) const {
        const std::string command = "cd '" + path("out").string() + "'; codes=0; ids=; for n in $(seq 20); do '" +
                                    test::program() + "' " + arguments +
                                    " >/dev/null 2>>../errors & ids=\"$ids $!\"; done; for id in $ids; do wait $id || "
                                    "codes=$((codes + 1)); done; exit $codes";
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
};

const std::string kModel = "reconstruct ../ball.raw --size 9,9,9 --type uint8 --reduce 50% ";

TEST_F(Twenty, processes_at_once_give_the_bytes_of_one_alone) {
    put_ball("ball.raw");
    ASSERT_EQ(run("reconstruct " + ball("ball.raw") + "--reduce 50% -o " + path("alone.vtp").string()).code, 0);
    EXPECT_EQ(run_twenty(kModel + "-o m$n.vtp"), 0) << text_of(path("errors"));
    EXPECT_EQ(files_left(), 20);
    for (int n = 1; n <= 20; ++n)
        EXPECT_TRUE(text_of(out("m" + std::to_string(n) + ".vtp")) == text_of(path("alone.vtp"))) << n;
}

/// They also look for what earlier runs have left.
TEST_F(Twenty, processes_that_write_one_file_leave_it_whole) {
    put_ball("ball.raw");
    ASSERT_EQ(run("reconstruct " + ball("ball.raw") + "--reduce 50% -o " + path("alone.vtp").string()).code, 0);
    EXPECT_EQ(run_twenty(kModel + "-o m.vtp"), 0) << text_of(path("errors"));
    EXPECT_EQ(files_left(), 1);
    EXPECT_TRUE(text_of(out("m.vtp")) == text_of(path("alone.vtp")));
}

}  // namespace
}  // namespace regionmesh
