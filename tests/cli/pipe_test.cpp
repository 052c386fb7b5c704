// Sections from standard input.
#include "cli/program.h"
#include "regionmesh/formats.h"
#include "regionmesh/regionmesh.h"
#include "support/runs.h"
#include "support/volumes.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

class Pipe : public Program {
protected:
    void SetUp() override {
        Program::SetUp();
        const test::ArrayVolume grains = test::grain_volume({12, 11, 10}, 5, 20260720);
        labels_.assign(grains.labels().begin(), grains.labels().end());
    }

    /// Runs the program with `bytes` on standard input, through a pipe.
    Ran run_with(const std::string& bytes, const std::string& arguments) const {
        put_text(path("sent"), bytes);
        const std::string command = "cat '" + path("sent").string() + "' | '" + test::program() + "' " + arguments +
                                    " >'" + path("stdout").string() + "' 2>'" + path("stderr").string() + "'";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(path("stdout")), text_of(path("stderr"))};
    }
    std::string npy(const std::string& order = "False") const {
        std::string header = "{'descr': '|u1', 'fortran_order': " + order + ", 'shape': (10, 11, 12), }";
        header.resize(117, ' ');
        return std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + '\n' + labels_;
    }

    const std::string raw_ = "- --size 12,11,10 --type uint8 ";
    std::string labels_;
};

TEST_F(Pipe, makes_sound_models_in_one_pass) {
    for (const std::string target : {"--target-faces 900", "--max-error 0.1", "--reduce 50%", "--no-decimate"}) {
        const std::string rest = target + " --no-background -o " + out("m.vtp");
        const Ran raw = run_with(labels_, "reconstruct " + raw_ + rest);
        ASSERT_EQ(raw.code, 0) << raw.error;
        const std::string model = text_of(path("out/m.vtp"));
        MeshFile file = read_mesh(out("m.vtp"));
        test::expect_sound(check(file.mesh));
        const Ran sent = run_with(npy(), "reconstruct - " + rest);
        ASSERT_EQ(sent.code, 0) << sent.error;
        EXPECT_TRUE(text_of(path("out/m.vtp")) == model);
    }
    EXPECT_LE(read_mesh(out("m.vtp")).mesh.vertex_count(), 12u * 11 * 10 * 12);
}

TEST_F(Pipe, a_folder_of_pieces_goes_on_with_the_same_samples_only) {
    const std::string arguments = "reconstruct - --no-background --block-size 6 -o " + out("model");
    ASSERT_EQ(run_with(npy(), arguments).code, 0) << "the folder is made";
    std::string other = npy();
    other.back() ^= 1;
    const Ran refused = run_with(other, arguments);
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.error, HasSubstr("was begun with other samples than those of standard input"));
    EXPECT_EQ(run_with(npy(), arguments).code, 0);
}

TEST_F(Pipe, without_decimation_gives_the_bytes_that_the_file_gives) {
    put_text(path("v.raw"), labels_);
    const std::string rest = " --no-decimate --sweep z -o ";
    ASSERT_EQ(run("reconstruct " + path("v.raw").string() + raw_.substr(1) + rest + out("a.vtp")).code, 0);
    ASSERT_EQ(run_with(labels_, "reconstruct " + raw_ + rest + out("b.vtp")).code, 0);
    EXPECT_TRUE(text_of(path("out/a.vtp")) == text_of(path("out/b.vtp")));
}

TEST_F(Pipe, that_is_too_short_or_too_long_or_no_array_is_refused) {
    const std::string rest = " -o " + out("m.vtp");
    const auto said = [&](const std::string& bytes, const std::string& input) {
        const Ran ran = run_with(bytes, "reconstruct " + input + rest);
        EXPECT_EQ(ran.code, 1);
        EXPECT_EQ(files_left(), 0);
        return ran.error;
    };
    EXPECT_THAT(said(labels_.substr(1), raw_), HasSubstr("standard input: section 9: ends before the last sample"));
    EXPECT_THAT(said(labels_ + "x", raw_), HasSubstr("goes on after the last sample"));
    EXPECT_THAT(said("", raw_), HasSubstr("standard input: section 0: ends before"));
    EXPECT_THAT(said("", "-"), HasSubstr("standard input: not an npy file"));
    EXPECT_THAT(said(npy().substr(0, 50), "-"), HasSubstr("ends before"));
    EXPECT_THAT(said(npy("True"), "-"), HasSubstr("is in Fortran order"));
    EXPECT_THAT(said(labels_, raw_ + "--sweep x"), HasSubstr("cannot be read along x"));
    expect_refusal("reconstruct - -" + rest, 2, "standard input: is one of several inputs");
}

}  // namespace
}  // namespace regionmesh
