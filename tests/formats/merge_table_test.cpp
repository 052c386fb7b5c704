#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/temporary_folder.h"
#include "regionmesh/error.h"
#include "regionmesh/read_sections.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

class MergeTable : public TemporaryFolder {
protected:
    Selection selection_of(const std::string& text) {
        put_text(path("merge.csv"), text);
        Selection selection;
        read_merge_table(path("merge.csv"), selection);
        return selection;
    }
    std::string failure_of(const std::string& text) {
        try {
            selection_of(text);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kInput);
            return error.what();
        }
        return "nothing thrown";
    }
};

TEST_F(MergeTable, labels_ranges_and_names_are_read) {
    const Selection selection = selection_of("old,new,name\n# comment\n1,7,grey matter\n2-4,7\n-3,0\n9,8,\"a, b\"\n");
    EXPECT_THAT(selection.merge, ElementsAre(Pair(-3, 0), Pair(1, 7), Pair(2, 7), Pair(3, 7), Pair(4, 7), Pair(9, 8)));
    EXPECT_THAT(selection.names, ElementsAre(Pair(7, "grey matter"), Pair(8, "a, b")));
    EXPECT_THAT(selection_of("5\t6\n").merge, ElementsAre(Pair(5, 6)));
}

TEST_F(MergeTable, rows_that_contradict_or_hold_no_labels_are_refused) {
    EXPECT_THAT(failure_of("1,2\n1,3\n"), HasSubstr("merge.csv: row 2: label 1 becomes 2 and 3"));
    EXPECT_THAT(failure_of("1,2,a\n3,2,b\n"), HasSubstr("row 2: label 2 is called 'a' and 'b'"));
    EXPECT_THAT(failure_of("1,2\nx,3\n"), HasSubstr("row 2: 'x' is no label"));
    EXPECT_THAT(failure_of("1,2\n3,y\n"), HasSubstr("row 2: 'y' is no label"));
    EXPECT_THAT(failure_of("1\n"), HasSubstr("row 1: has 1 columns"));
    EXPECT_THAT(failure_of("0-99999999999,1\n"), HasSubstr("more than a million labels"));
    EXPECT_THAT(failure_of("old,new\n"), HasSubstr("holds no labels"));
}

}  // namespace
}  // namespace regionmesh
