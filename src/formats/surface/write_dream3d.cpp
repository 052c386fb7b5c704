// DREAM.3D files, which the program regionmesh-hdf5 makes: the HDF5 library crashes where memory runs out.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/find_program.h"
#include "formats/piped_program.h"
#include "formats/surface/mesh_formats.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

using namespace formats;

constexpr std::array<char, 8> kMesh{'R', 'M', 'H', '5', 'M', 'S', 'H', '1'};
constexpr std::size_t kPiece = 1 << 16;                       // numbers sent, or bytes received, at a time
constexpr int kWrongInput = 1, kUsage = 2, kNotLoaded = 127;  // exit codes; the last one is the loader's

/// The format has signed 32-bit labels; -1 is the exterior.
void require_labels(const LabelTable& labels) {
    for (Label label = 0; label < labels.size(); ++label) {
        const InputLabel input = labels.input(label);
        if (input < 0 || input > std::numeric_limits<std::int32_t>::max())
            throw Error(ErrorCode::kOutput, fmt::format("label {}: .dream3d holds labels from 0 to 2147483647: "
                                                        "write another format",
                                                        labels.text(input)));
    }
}

/// Sends a model as apps/hdf5/README.md describes it.
class Sender {
public:
    Sender(PipedProgram& program, const FileView& view) : program_(program), view_(view) {}

    /// False where the program has ended.
    bool send() {
        const std::array<std::uint64_t, 2> counts{view_.mesh().vertex_count(), view_.mesh().face_count()};
        put<char>(kMesh);
        put<std::uint64_t>(counts);
        send_numbers<float>([&](auto&& put) {
            view_.for_vertices([&](VertexId v) {
                for (int axis = 0; axis < 3; ++axis) put(static_cast<float>(view_.mesh().position(v)[axis]));
            });
        });
        send_numbers<std::uint32_t>([&](auto&& put) {
            view_.for_faces([&](FaceId f) {
                for (const std::uint32_t v : view_.face(f).vertices) put(v);
            });
        });
        send_numbers<std::int8_t>([&](auto&& put) {
            view_.for_vertices([&](VertexId v) { put(static_cast<std::int8_t>(view_.node_type(v))); });
        });
        send_numbers<std::int32_t>([&](auto&& put) {
            view_.for_faces([&](FaceId f) {
                for (const InputLabel label : view_.face(f).labels) put(static_cast<std::int32_t>(label));
            });
        });
        program_.end_input();
        return is_taken_;
    }

private:
    template <class T>
    void put(std::span<const T> numbers) {
        is_taken_ = is_taken_ && program_.send(std::as_bytes(numbers));
    }

    /// make(put) calls put() with all numbers in order.
    template <class T, class Make>
    void send_numbers(Make&& make) {
        std::vector<T> piece;
        piece.reserve(kPiece);
        make([&](T number) {
            piece.push_back(number);
            if (piece.size() < kPiece) return;
            put<T>(piece);
            piece.clear();
        });
        put<T>(piece);
    }

    PipedProgram& program_;
    const FileView& view_;
    bool is_taken_ = true;
};

[[noreturn]] void report_end(const std::filesystem::path& path, const PipedProgram::Ending& ending) {
    const int code = ending.exit_code.value_or(0);
    if (code == kWrongInput || code == kUsage)
        throw Error(ErrorCode::kOutput, fmt::format("{} failed with exit code {} ({}); is it of another version?",
                                                    path.string(), code, ending.last_words));
    if (code == kNotLoaded)
        throw Error(ErrorCode::kOutput, fmt::format("{} could not begin ({}): one of its libraries is missing, or the "
                                                    "HDF5 library needs more memory; write another format",
                                                    path.string(), ending.last_words));
    throw Error(ErrorCode::kOutput,
                fmt::format("{} ended before the .dream3d file was complete: the HDF5 library needs more memory; end "
                            "other programs, set a lower target, or write another format",
                            path.string()));
}

void write_model(const FileView& view, OutputFile& file) {
    const std::filesystem::path path = find_program(kHdf5Program);
    PipedProgram program(path, {"--write-dream3d"});
    std::uint64_t left = 0;
    // The size comes first: an end that is too early is no file, whatever the exit code.
    bool is_whole =
        Sender(program, view).send() && program.receive(std::as_writable_bytes(std::span(&left, 1))) == sizeof left;
    std::array<std::byte, kPiece> piece;
    while (is_whole && left > 0) {
        const std::size_t wanted = std::min<std::uint64_t>(left, piece.size());
        is_whole = program.receive(std::span(piece).first(wanted)) == wanted;
        if (is_whole) file.write({reinterpret_cast<const char*>(piece.data()), wanted});
        left -= wanted;
    }
    const PipedProgram::Ending ending = program.end();
    if (!is_whole || ending.exit_code != 0) report_end(path, ending);
}

/// A part of the .dream3d file for the .xdmf file.
struct XdmfItem {
    const char* array;
    std::string_view type;  // NumberType and Precision
    std::uint64_t rows;
    int columns;
};

/// XDMF 2: which arrays of the .dream3d file are points, faces and their values, for ParaView.
void write_xdmf(const FileView& view, const std::string& name, OutputFile& file) {
    const std::uint64_t vertices = view.mesh().vertex_count(), faces = view.mesh().face_count();
    const auto item = [&](const XdmfItem& part) {
        return fmt::format(
            "<DataItem Format=\"HDF\" {} Dimensions=\"{} {}\">{}:/DataStructure/TriangleDataContainer/{}</DataItem>\n",
            part.type, part.rows, part.columns, name, part.array);
    };
    file.write(fmt::format(
        "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.2\">\n<Domain>\n<Grid Name=\"TriangleDataContainer\" "
        "GridType=\"Uniform\">\n<Topology TopologyType=\"Triangle\" NumberOfElements=\"{}\">\n{}</Topology>\n"
        "<Geometry GeometryType=\"XYZ\">\n{}</Geometry>\n"
        "<Attribute Name=\"NodeType\" AttributeType=\"Scalar\" Center=\"Node\">\n{}</Attribute>\n"
        "<Attribute Name=\"FaceLabels\" AttributeType=\"Vector\" Center=\"Cell\">\n{}</Attribute>\n"
        "</Grid>\n</Domain>\n</Xdmf>\n",
        faces, item({"SharedTriList", "NumberType=\"UInt\" Precision=\"8\"", faces, 3}),
        item({"SharedVertexList", "NumberType=\"Float\" Precision=\"4\"", vertices, 3}),
        item({"Vertex Data/NodeType", "NumberType=\"Char\" Precision=\"1\"", vertices, 1}),
        item({"Face Data/FaceLabels", "NumberType=\"Int\" Precision=\"4\"", faces, 2})));
}

}  // namespace

void write_dream3d(const FileView& view, OutputFiles& files, const std::filesystem::path& path) {
    require_labels(view.labels());
    write_model(view, files.add(path));
    write_xdmf(view, path.filename().string(), files.add(std::filesystem::path(path).replace_extension(".xdmf")));
}

}  // namespace regionmesh
