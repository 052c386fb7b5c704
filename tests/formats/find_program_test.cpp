#include "formats/find_program.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <string>

#include "formats/fake_program.h"
#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr HelperProgram kDelaunay{.name = "regionmesh-delaunay", .variable = "REGIONMESH_DELAUNAY"};

/// With an environment of its own.
class FindProgram : public FakePrograms {
protected:
    FindProgram() : search_(std::getenv("PATH")) {
        ::unsetenv("REGIONMESH_DELAUNAY");
        ::setenv("PATH", path("").c_str(), 1);
    }
    ~FindProgram() override {
        ::unsetenv("REGIONMESH_DELAUNAY");
        ::setenv("PATH", search_.c_str(), 1);
    }

    std::string problem(const std::filesystem::path& given) {
        try {
            return "found: " + find_program(kDelaunay, given).string();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kInput);
            return error.what();
        }
    }

private:
    std::string search_;
};

TEST_F(FindProgram, option_comes_before_variable_before_search) {
    const auto named = program("");
    const auto on_path = path("regionmesh-delaunay");
    std::filesystem::copy_file(named, on_path);
    EXPECT_EQ(find_program(kDelaunay), on_path);
    ::setenv("REGIONMESH_DELAUNAY", named.c_str(), 1);
    EXPECT_EQ(find_program(kDelaunay), named);
    EXPECT_EQ(find_program(kDelaunay, on_path), on_path);
}

TEST_F(FindProgram, if_there_is_none_the_error_says_where_it_was_looked_for) {
    EXPECT_THAT(problem({}),
                AllOf(HasSubstr("regionmesh-delaunay: not found beside /"), HasSubstr(", in the install prefix /"),
                      HasSubstr(" or on PATH; set REGIONMESH_DELAUNAY")));
}

TEST_F(FindProgram, what_is_given_and_no_program_is_refused) {
    put_text(path("text"), "no program");
    EXPECT_THAT(problem(path("text")), HasSubstr("text: is no program that can be run; the option gives it"));
    EXPECT_THAT(problem(path("")), HasSubstr("is no program"));
    ::setenv("REGIONMESH_DELAUNAY", path("nothing").c_str(), 1);
    EXPECT_THAT(problem({}), HasSubstr("nothing: is no program that can be run; REGIONMESH_DELAUNAY gives it"));
}

}  // namespace
}  // namespace regionmesh::formats
