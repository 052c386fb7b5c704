#include "regionmesh/read_layers.h"

#include "formats/input_file.h"
#include "formats/registry.h"

namespace regionmesh {

std::unique_ptr<SectionReader> open_layers(const std::filesystem::path& path, const TetrahedraOptions& table,
                                           const LayerOptions& layers, LayerSummary* summary) {
    const formats::Format* format = formats::find_format(path);
    if (!format || !format->is_table) formats::fail(path, "is no table; --layers is for tables of drill holes");
    formats::require_readable(path, format);
    return format->open_layers(path, table, layers, summary);
}

}  // namespace regionmesh
