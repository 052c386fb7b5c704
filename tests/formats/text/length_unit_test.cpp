#include "formats/text/length_unit.h"

#include <gtest/gtest.h>

#include "regionmesh/write_report.h"

namespace regionmesh {
namespace {

TEST(LengthUnit, names_in_use_are_known) {
    for (const char* name :
         {"um", "\u00b5m", "\u03bcm", "micron", "microns", "Micrometer", "micrometre", "micrometres"})
        EXPECT_EQ(formats::metres_in(name), 1e-6) << name;
    EXPECT_EQ(formats::metres_in("mm"), 1e-3);
    EXPECT_EQ(formats::metres_in("metre"), 1);
    EXPECT_EQ(formats::metres_in("angstrom"), 1e-10);
    for (const char* name : {"feet", "foot", "ft"}) EXPECT_EQ(formats::metres_in(name), 0.3048);
    for (const char* name : {"inch", "inches", "in"}) EXPECT_EQ(formats::metres_in(name), 0.0254);
    for (const char* name : {"", "pixel", "MM", "s", "meterss"})
        EXPECT_EQ(formats::metres_in(name), std::nullopt) << name;
    EXPECT_EQ(*formats::femtometres_in("millimeter") / *formats::femtometres_in("nanometer"), 1e6);
}

TEST(LengthUnit, symbols_lead_back_to_it) {
    for (const char* symbol : {"fm", "pm", "A", "nm", "um", "mm", "cm", "dm", "m", "km", "in", "ft"})
        EXPECT_EQ(length_symbol(*formats::metres_in(symbol)), symbol);
    EXPECT_EQ(length_symbol(0.0252), "0.0252 m");
}

}  // namespace
}  // namespace regionmesh
