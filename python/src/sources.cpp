#include "sources.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "regionmesh/error.h"
#include "regionmesh/read_sections.h"
#include "regionmesh/select_sections.h"
#include "settings.h"

namespace regionmesh::python {
namespace {

/// Samples of numpy's bool are bytes of 0 and 1.
SampleType sample_type(const py::dtype& type, const std::string& name) {
    const bool is_signed = type.kind() == 'i';
    const bool is_integer = is_signed || type.kind() == 'u' || type.kind() == 'b';
    const std::string text = py::str(static_cast<const py::object&>(type));
    if (!is_integer) throw py::type_error(name + ": labels are " + text + "; give integers");
    if (!type.attr("isnative").cast<bool>())
        throw py::type_error(name + ": labels are " + text +
                             " in another byte order; give them in that of the machine");
    switch (type.itemsize()) {
        case 1:
            return is_signed ? SampleType::kI8 : SampleType::kU8;
        case 2:
            return is_signed ? SampleType::kI16 : SampleType::kU16;
        case 4:
            return is_signed ? SampleType::kI32 : SampleType::kU32;
        default:
            return is_signed ? SampleType::kI64 : SampleType::kU64;
    }
}

std::uint32_t samples_along(py::ssize_t samples, const std::string& name) {
    if (samples > std::numeric_limits<std::int32_t>::max())
        throw py::value_error(name + ": " + std::to_string(samples) + " samples along an axis; cut the volume");
    return static_cast<std::uint32_t>(samples);
}

ArrayOptions placed(const Frame& frame, ArrayOptions rest) {
    const Lattice lattice = lattice_of(frame, {});
    rest.spacing = lattice.spacing;
    rest.origin = lattice.origin;
    rest.direction = lattice.direction;
    rest.metres = frame.metres;
    rest.space = space_named(frame.space);
    return rest;
}

/// Sections that a Python function returns.
class CalledSections : public SectionReader {
public:
    CalledSections(SectionCalls calls, VolumeInfo info) : calls_(std::move(calls)), info_(std::move(info)) {}
    ~CalledSections() override {
        const py::gil_scoped_acquire acquire;  // an error may end a reader without it
        calls_ = {};
    }

    const VolumeInfo& info() const override { return info_; }

    bool next(std::span<InputLabel> section) override {
        if (section_ == section_count()) return false;
        const py::gil_scoped_acquire acquire;
        const py::object given = calls_.next();
        const std::string place = info_.source + " section " + std::to_string(section_);
        if (given.is_none())
            throw Error(ErrorCode::kInput, place + ": missing; " + std::to_string(section_count()) +
                                               " sections were announced; give as many");
        copy(py::array::ensure(given), place, section);
        ++section_;
        return true;
    }

    void rewind() override {
        const py::gil_scoped_acquire acquire;
        calls_.rewind();
        section_ = 0;
    }

private:
    void copy(const py::array& given, const std::string& place, std::span<InputLabel> section) {
        if (!given || given.ndim() != 2)
            throw Error(ErrorCode::kInput, place + ": not an array with two axes; give sections [y, x]");
        if (given.shape(0) != section_height() || given.shape(1) != section_width())
            throw Error(ErrorCode::kInput, place + ": " + std::to_string(given.shape(1)) + " x " +
                                               std::to_string(given.shape(0)) + " samples, the first has " +
                                               std::to_string(section_width()) + " x " +
                                               std::to_string(section_height()) + "; give sections of one size");
        const LabelArray view{given.data(),
                              sample_type(given.dtype(), place),
                              {section_width(), section_height(), 1},
                              {given.strides(1), given.strides(0), 0}};
        open_array(view, {.sweep = SweepChoice::kZ})->next(section);
    }

    SectionCalls calls_;
    VolumeInfo info_;
    std::uint32_t section_ = 0;
};

/// Sections of a reader that lives longer.
class BorrowedSections : public SectionReader {
public:
    explicit BorrowedSections(SectionReader& reader) : reader_(reader) {}
    const VolumeInfo& info() const override { return reader_.info(); }
    bool next(std::span<InputLabel> section) override { return reader_.next(section); }
    void rewind() override { reader_.rewind(); }

private:
    SectionReader& reader_;
};

/// With only these labels kept.
Selection keeping(Selection selection, const KeptLabels& kept) {
    if (!kept) return selection;
    if (kept->empty()) throw py::value_error("labels_to_keep: no label; name one or more");
    for (const InputLabel label : *kept) selection.labels.push_back({label, label});
    return selection;
}

}  // namespace

Lattice lattice_of(const Frame& frame, const ArraySize& size) {
    const auto& [s, o] = std::pair(frame.spacing, frame.origin);
    return {size, {s[0], s[1], s[2]}, {o[0], o[1], o[2]}, frame.direction};
}

Source array_source(const py::array& array, const Frame& frame, const ArrayOptions& rest) {
    if (array.ndim() != 3)
        throw py::value_error(rest.name + ": " + std::to_string(array.ndim()) + " axes; give a volume [z, y, x]");
    const LabelArray view{array.data(),
                          sample_type(array.dtype(), rest.name),
                          {samples_along(array.shape(2), rest.name), samples_along(array.shape(1), rest.name),
                           samples_along(array.shape(0), rest.name)},
                          {array.strides(2), array.strides(1), array.strides(0)}};
    const auto open = [view, options = placed(frame, rest)](SweepChoice sweep) {
        ArrayOptions own = options;
        own.sweep = sweep;
        return open_array(view, own);
    };
    return {array, open(rest.sweep), open, rest.sweep};
}

Source call_source(SectionCalls calls, const Frame& frame, const ArrayOptions& rest) {
    VolumeInfo info{.source = rest.name, .format = "array", .can_rewind = !calls.rewind.is_none(), .names = rest.names};
    const auto type = parse_sample_type(calls.type);
    if (!type) throw py::type_error(rest.name + ": labels are " + calls.type + "; give integers");
    info.type = *type;
    // An array of one sample that stands for the volume: the same tests of size and place as for arrays.
    const std::int64_t stand_in = 0;
    open_array({&stand_in, SampleType::kI64, calls.size, {0, 0, 0}}, placed(frame, rest));
    info.lattice = lattice_of(frame, calls.size);
    info.metres = frame.metres;
    info.space = space_named(frame.space);
    info.sweep = kSweepZ;
    return {py::none(), std::make_unique<CalledSections>(std::move(calls), std::move(info))};
}

void warn_of(const std::string& source, const std::string& warning) {
    if (!warning.empty() && PyErr_WarnEx(PyExc_UserWarning, (source + ": " + warning).c_str(), 1) != 0)
        throw py::error_already_set();
}

Source file_source(const std::vector<std::string>& paths, const OptionValues& options, const KeptLabels& kept) {
    Settings settings = settings_from(options, paths);
    settings.volume.select = keeping(settings.volume.select, kept);
    Source source;
    {
        const py::gil_scoped_release release;
        source.sweep = settings.volume.sweep;
        source.open = [paths, settings](SweepChoice sweep) {
            Settings own = settings;
            own.volume.sweep = sweep;
            return own.tetrahedra.array.empty() ? open_sections({paths.begin(), paths.end()}, own.volume)
                                                : open_lattice(own, paths);
        };
        source.reader = source.open(source.sweep);
    }
    warn_of(source.reader->info().source, source.reader->info().warning);
    return source;
}

Source select(Source source, const OptionValues& options, const KeptLabels& kept) {
    const Settings settings = settings_from(options);
    Selection selection = keeping(settings.volume.select, kept);
    const py::gil_scoped_release release;
    if (!settings.volume.merge_table.empty()) read_merge_table(settings.volume.merge_table, selection);
    source.reader = select_sections(std::move(source.reader), selection);
    if (source.open)
        source.open = [open = std::move(source.open), selection](SweepChoice sweep) {
            return select_sections(open(sweep), selection);
        };
    return source;
}

PreparedSections prepared(Source& source, const PrepareOptions& options) {
    const bool is_asked = options.between != 0u || options.align != AlignKind::kOff;
    if (source.open && is_asked) return prepare_sections(source.open, source.sweep, options);
    return prepare_sections([&](SweepChoice) { return std::make_unique<BorrowedSections>(*source.reader); },
                            source.sweep, options);
}

}  // namespace regionmesh::python
