// The arrays of a model as numpy sees them.
#include <memory>
#include <type_traits>
#include <utility>

#include "model.h"
#include "regionmesh/mesh_arrays.h"

namespace regionmesh::python {
namespace {

/// A read-only array of `columns` columns on the memory of a vector; no copy. The vector lives as long as the array.
template <class T, class Row>
py::array view_of(std::vector<Row> rows, py::ssize_t columns) {
    static_assert(std::is_trivially_copyable_v<Row>);
    auto held = std::make_unique<std::vector<Row>>(std::move(rows));
    const auto count = static_cast<py::ssize_t>(held->size());
    const T* data = reinterpret_cast<const T*>(held->data());
    const py::capsule owner(held.get(), [](void* pointer) { delete static_cast<std::vector<Row>*>(pointer); });
    held.release();
    std::vector<py::ssize_t> shape{count};
    if (columns > 1) shape.push_back(columns);
    py::array_t<T> array(shape, data, owner);
    array.attr("flags").attr("writeable") = false;
    return array;
}

}  // namespace

py::tuple arrays_of(const Model& model) {
    MeshArrays arrays;
    {
        const py::gil_scoped_release release;
        arrays = export_arrays(model.mesh, model.labels, model.background);
    }
    py::array labels = model.labels.is_unsigned() ? view_of<std::uint64_t>(std::move(arrays.labels), 2)
                                                  : view_of<std::int64_t>(std::move(arrays.labels), 2);
    return py::make_tuple(view_of<double>(std::move(arrays.points), 3),
                          view_of<std::uint32_t>(std::move(arrays.faces), 3), std::move(labels),
                          view_of<std::uint8_t>(std::move(arrays.node_types), 1));
}

}  // namespace regionmesh::python
