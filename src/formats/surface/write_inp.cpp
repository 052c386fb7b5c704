// Input files for Abaqus and CalculiX.
#include <charconv>
#include <string>

#include "formats/surface/file_regions.h"
#include "formats/surface/mesh_formats.h"
#include "formats/text/text_writer.h"

namespace regionmesh {
namespace {

/// CalculiX reads no more characters of a real number; the rest, even an exponent, would be lost.
constexpr std::ptrdiff_t kMostLetters = 20;
constexpr int kPerLine = 10;  // of at most 16

/// The fewest digits that give the same double when read; fewer where these do not fit.
std::string real(double number) {
    char digits[32];
    auto end = std::to_chars(digits, digits + sizeof(digits), number).ptr;
    for (int precision = 17; end - digits > kMostLetters; --precision)
        end = std::to_chars(digits, digits + sizeof(digits), number, std::chars_format::general, precision).ptr;
    return {digits, end};
}

class InpWriter {
public:
    InpWriter(const FileView& view, OutputFile& file) : view_(view), regions_(view), text_(file) {}

    void write() {
        text_.line("*HEADING");
        text_.line("A surface for each interface of two regions");
        write_nodes();
        write_elements();
        write_regions();
        write_sides();
        text_.flush();
    }

private:
    void write_nodes() {
        text_.line("*NODE");
        view_.for_vertices([&](VertexId v) {
            const Vec3 p = view_.mesh().position(v);
            text_.add(view_.number(v) + 1, ", ", real(p.x), ", ", real(p.y), ", ", real(p.z));
            text_.end_line();
        });
    }

    void write_elements() {
        const auto& interfaces = regions_.interfaces();
        const GroupedFaces faces(view_, interfaces.size(), [&](FaceId f, auto&& add) {
            add(regions_.interface_number(f) - 1, view_.is_turned(f));
        });
        std::size_t number = 0;
        for (std::size_t n = 0; n < interfaces.size(); ++n) {
            text_.line("*ELEMENT, TYPE=S3, ELSET=" + interfaces[n].name);
            faces.for_group(n, [&](FaceId f, std::uint32_t side) {
                text_.add(++number);
                for (const VertexId v : turned_vertices(view_.mesh(), f, side)) text_.add(", ", view_.number(v) + 1);
                text_.end_line();
            });
        }
    }

    /// A set of all elements of each region, and its surface: their outward sides.
    void write_regions() {
        for (const FileRegion& region : regions_.all()) {
            text_.line("** " + region.title);
            text_.line("*ELSET, ELSET=" + region.word);
            for_interfaces(region.label, [&](const FileInterface& interface, int) { text_.line(interface.name); });
            text_.line("*SURFACE, TYPE=ELEMENT, NAME=" + region.word + "_surface");
            for_interfaces(region.label, [&](const FileInterface& interface, int side) {
                text_.line(interface.name + (side == 0 ? ", SPOS" : ", SNEG"));
            });
        }
    }

    template <class Visit>
    void for_interfaces(Label label, Visit&& visit) {
        for (const FileInterface& interface : regions_.interfaces())
            for (int side = 0; side < 2; ++side)
                if (interface.labels[side] == label) visit(interface, side);
    }

    void write_sides() {
        for (int side = 0; side < 6; ++side) {
            int count = 0;
            view_.for_vertices([&](VertexId v) {
                if (!(view_.mesh()[v].sides >> side & 1)) return;
                if (count == 0) text_.line(std::string("*NSET, NSET=") + kSideNames[side]);
                if (count > 0) text_.add(count % kPerLine == 0 ? ",\n" : ", ");
                text_.add(view_.number(v) + 1);
                ++count;
            });
            if (count > 0) text_.end_line();
        }
    }

    const FileView& view_;
    FileRegions regions_;
    TextWriter text_;
};

}  // namespace

void write_inp(const FileView& view, OutputFile& file) { InpWriter(view, file).write(); }

}  // namespace regionmesh
